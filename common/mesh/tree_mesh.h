// A whole tree as a mesh: its wood by the method asked for, dressed in bark and leaves.
#pragma once

#include <cstdint>

#include "common/mesh/bark.h"
#include "common/mesh/leaves.h"
#include "common/mesh/mesher.h"

namespace ramify {

/// What a tree looks like, beside its skeleton.
struct Looks {
  MesherOptions mesher;
  BarkOptions bark;
  LeafOptions leaves;
};

struct TreeMesh {
  Mesh mesh;
  std::size_t leaf_count = 0;
  double leaf_area = 0.0;  // of one side, square metres
};

/// Wood first, then leaves. Wood that shows an attribute has no bark over it. `seed` is the tree's: leaves
/// are as random as it. Throws InputError for images and leaf meshes that cannot be used and RunError for too
/// many leaves. `memory` as for build_mesh().
TreeMesh make_tree_mesh(const Skeleton& skeleton, const Looks& looks, std::uint64_t seed, Mesh memory = {});

}  // namespace ramify
