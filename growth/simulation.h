// Trees growing in one world, a step at a time. Palubicki et al. 2009, Section 4.
#pragma once

#include <optional>
#include <vector>

#include "common/base/stopwatch.h"
#include "growth/barriers.h"
#include "growth/environment_space.h"
#include "growth/growing_tree.h"
#include "growth/light_field.h"
#include "growth/markers.h"
#include "growth/shadow_grid.h"
#include "growth/shoot_building.h"

namespace ramify::growth {

class Simulation {
 public:
  /// `with_history` keeps what is shed.
  explicit Simulation(const Parameters& world, bool with_history = false);

  /// Takes the next step. Returns false, with nothing changed, if it would make more than max_internodes
  /// living ones.
  bool advance();

  /// The resource that the trees as they stand have to share, a bud: what the next step will grow by.
  void sense();

  int step() const { return step_; }
  std::size_t internode_count() const;  // living
  const std::vector<GrowingTree>& trees() const { return trees_; }
  const ShadowGrid& shadow() const { return shadow_; }
  const std::optional<Markers>& markers() const { return markers_; }
  const Stopwatch& stopwatch() const { return stopwatch_; }

  /// Gives the trees away: nothing but the shadow, the markers and the stopwatch may be asked for after that.
  std::vector<GrowingTree> take_trees() { return std::move(trees_); }

 private:
  bool has_room() const;
  void extend(GrowingTree& tree, int step);
  void drop_leaves(const GrowingTree& tree, int step);
  void shed_starved(int step);
  void lose(int step);
  void close_holes();
  void prune(int step);
  void cut(GrowingTree& tree, const std::vector<std::uint32_t>& nodes, int step);
  void lose_buds(Plant& plant);

  const Parameters& world_;
  ShadowGrid shadow_;
  LightField field_;
  Barriers barriers_;
  std::optional<Markers> markers_;
  SpaceSearch space_search_;
  std::vector<GrowingTree> trees_;
  CasterChanges changes_;
  int step_ = 0;
  Stopwatch stopwatch_;
};

}  // namespace ramify::growth
