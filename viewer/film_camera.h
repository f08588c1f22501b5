// The camera of a film: it keeps its place, or its distance while it turns, so that only the tree changes.
#pragma once

#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "viewer/scene.h"

namespace ramify {

/// What must be in the picture all through a film: the finished tree, and wherever a branch ever was. `whole`
/// holds shed internodes too; `style` tells what is drawn of the finished tree. For RenderOptions::room_for.
std::vector<Vec3f> film_room(const Scene& finished, std::span<const Vec3> whole, RenderStyle style);

/// Room that looks the same from all sides: what the points sweep when they turn about the vertical through
/// the middle of their box. At most some tens of thousands of points.
std::vector<Vec3f> swept_room(std::span<const Vec3f> room);

}  // namespace ramify
