// What stands beside a tree to show its size: a human figure and a bar with its length.
#pragma once

#include <string>
#include <vector>

#include "common/base/geometry.h"
#include "viewer/camera.h"

namespace ramify {

/// Height of the human figure, metres.
inline constexpr double kFigureHeight = 1.75;

/// Filled triangles, three corners each, in metres to the right of and above the tree's base, in the plane
/// through it that faces the viewer.
struct Annotations {
  std::vector<Vec2f> figure;  // stands on the ground, to the left of the tree
  std::vector<Vec2f> bar;     // with its label, below everything
};

/// Around a tree that reaches from `low` to `high` in that plane.
Annotations make_annotations(const glm::dvec2& low, const glm::dvec2& high);

/// Beside a box whose tree stands at `base`, upright and turned to a viewer at that azimuth.
Annotations annotations_beside(const Box& box, const Vec3& base, double azimuth_deg);

/// The greatest of 1, 2, 5 times a power of ten that is not above `length` (> 0).
double bar_length(double length);

/// "20 cm", "5 m", "1 km": a length that bar_length() gave.
std::string length_label(double length);

}  // namespace ramify
