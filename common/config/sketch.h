// A drawn line in a plane.
#pragma once

#include <vector>

#include "common/base/geometry.h"

namespace ramify {

using Vec2 = glm::dvec2;

/// The corners of a polyline, in order; a config writes [[x, y], ...].
using Sketch = std::vector<Vec2>;

}  // namespace ramify
