// A grown tree as a skeleton.
#pragma once

#include "common/skeleton/skeleton.h"
#include "growth/growing_tree.h"

namespace ramify::growth {

/// The tree with widths by the pipe model, light and vigour: what lives of it, or all it ever made where a
/// history was kept. Takes the tree's memory as it goes.
Skeleton skeleton_of(GrowingTree tree, const Parameters& world);

}  // namespace ramify::growth
