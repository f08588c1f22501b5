// Small skeletons that tests know by heart.
#pragma once

#include "common/skeleton/skeleton.h"

namespace ramify::test {

/// Adds a node of living wood, a root if `parent` is kNoParent; assign_axes() when all are there.
void add_node(Skeleton& tree, const Vec3& position, std::uint32_t parent, double diameter);

/// A root at the origin and `internodes` of 1 m straight up, 0.2 m thick at the base, narrowing to 0.1 m.
Skeleton pole(int internodes);

/// A perfect binary tree: each internode bears two, left and right, `depth` times; the left one goes on the
/// axis.
Skeleton binary_tree(int depth);

/// A random tree whose nodes stand at random places, with every attribute set; the same for the same seed.
Skeleton random_tree(std::uint64_t seed, int internodes);

}  // namespace ramify::test
