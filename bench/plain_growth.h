// The growth model as one would first write it: nodes on the heap that own their children, recursion up and
// down the tree; the shadow field either a sparse one, made anew in each step, or a dense one, to which each
// step adds. It makes the same tree as growth/, which is measured against it. Palubicki et al. 2009, Section
// 4, with light, Borchert-Honda allocation, spiral phyllotaxis and shedding by light.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "bench/dense_shadow.h"
#include "bench/plain_shadow.h"
#include "common/skeleton/skeleton.h"
#include "growth/parameters.h"

namespace ramify::bench {

class PlainTree {
 public:
  /// Throws InputError for parameters that ask for more than the model above. max_internodes is not looked
  /// at.
  explicit PlainTree(const growth::Parameters& parameters);

  /// The same in a dense field, as the quickest public program has it: so many voxels each way, the root in
  /// the middle of the ground. Throws InputError also for shedding, and grow() where shadows leave the field.
  PlainTree(const growth::Parameters& parameters, int voxels);
  ~PlainTree();

  /// All steps, then light and resource for the youngest too, and the widths: what growth::Engine::run()
  /// does.
  void grow();

  /// Takes the next step.
  void advance();

  /// What advance() begins with: the light and resource of the buds in the step to come.
  void sense();

  // The parts of sense()
  void cast_shadows();
  void sense_light();
  void sum_light();
  void share_resource();

  void compute_diameters();

  std::size_t internode_count() const;

  /// Positions, parents and diameters, the nodes in the order of their creation.
  Skeleton skeleton() const;

 private:
  struct Bud;
  struct TerminalBud;
  struct Node;
  struct GrowingBud;
  class Shoots;
  using Field = std::variant<PlainShadow, DenseShadow>;

  PlainTree(const growth::Parameters& parameters, Field field);

  static void cast_shadows(const Node& node, PlainShadow& shadow);
  template <class AnyShadow>
  static void sense_light(Node& node, const AnyShadow& shadow, double full);
  static void sum_light(Node& node);
  static void share_resource(Node& node, double received, double lambda);
  static void mark_shaded(Node& node, double threshold);
  static void shed_marked(Node& node, const PipeModel& pipe);
  static void collect_growing(Node& node, std::vector<GrowingBud>& buds);
  static double compute_areas(Node& node, const PipeModel& pipe);
  static void collect(const Node& node, std::vector<const Node*>& nodes);
  PipeModel pipe() const;

  const growth::Parameters& parameters_;
  Field shadow_;
  std::unique_ptr<Node> root_;
  std::vector<const Node*> uncast_;  // nodes that the dense field has no shadows of yet
  int step_ = 0;
  std::uint32_t nodes_made_ = 0;    // ever
  std::uint32_t axes_founded_ = 1;  // ever; the trunk
};

}  // namespace ramify::bench
