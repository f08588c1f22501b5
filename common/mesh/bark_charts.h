// Texture coordinates of a surface that was not made tube by tube: each axis has a chart of its own, u around
// it and v along it.
#pragma once

#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Sets mesh.uvs from positions and internodes. A triangle lies in the chart of one axis: where two meet it
/// is cut. There, and where a chart's ends meet behind, vertices are doubled, at the end of the arrays: the
/// surface stays closed by its positions. O(n), and a sort of what is doubled; on all threads, the same for
/// any number of them.
void lay_bark_charts(const Skeleton& skeleton, Mesh& mesh);

}  // namespace ramify
