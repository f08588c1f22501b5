// Leaves on young wood: where they stand, how they are turned, and their triangles.
#pragma once

#include <cstdint>
#include <filesystem>

#include "common/config/field.h"
#include "common/mesh/leaf_shapes.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Leaves stand in groups along each axis, where its wood is young enough by all of the three limits, and at
/// its tip.
struct LeafOptions {
  LeafShape shape = LeafShape::none;
  LeafForm form = LeafForm::card;
  std::filesystem::path mesh;  // a leaf or twig of one's own instead of the shape; empty: none

  double max_width = 0.015;  // metres; wood up to this diameter bears leaves
  int max_age = 0;           // steps since the internode grew; 0: whatever its age
  int min_order = 0;         // of the axis

  double spacing = 0.05;  // metres of twig from one group to the next
  int per_node = 1;       // leaves of a group
  double divergence_deg = 137.5;

  double length = 0.09;  // metres
  double length_jitter = 0.25;
  double angle_deg = 55;         // between twig and leaf
  double droop = 0.3;            // 0: as the angle says; 1: half way down
  double facing_up = 0.7;        // 0: the upper side faces along the twig; 1: as far up as it can
  Vec3 color{0.33, 0.45, 0.17};  // sRGB
  double color_jitter = 0.15;

  bool is_on() const { return shape != LeafShape::none || !mesh.empty(); }
  static const Table& fields();
};

/// A leaf's place: the columns of `frame` are its right, its direction and its upper side, times its length.
struct Leaf {
  Vec3 base;
  glm::dmat3 frame{1.0};
  std::uint32_t internode = 0;
  std::array<std::uint8_t, 3> tint{};  // sRGB
};

/// All leaves of a tree, axis by axis as the internodes come. The same for the same skeleton, options and
/// seed, whatever the number of threads. `lod` 1 to 3: half, a quarter, an eighth of the leaves, as much
/// larger that their area stays. Needs birth_step if max_age is set. O(n + leaves). Throws RunError if they
/// are more than a mesh can hold.
std::vector<Leaf> place_leaves(const Skeleton& skeleton, const LeafOptions& options, std::uint64_t seed,
                               int lod = 0);

/// The leaf that the options ask for. A file's leaf is scaled to length 1 along Y. Throws InputError if the
/// file cannot be used.
LeafModel leaf_model(const LeafOptions& options);

/// Appends a copy of the model at each place, with one material range for each of the model's.
void append_leaves(Mesh& mesh, const LeafModel& model, const std::vector<Leaf>& leaves);

/// Throws ConfigError, the key being "mesh", if that file cannot be used.
void check_leaves(const LeafOptions& options);

}  // namespace ramify
