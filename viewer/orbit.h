// A camera that circles a point, led by hand. Pure geometry, no OpenGL.
#pragma once

#include <span>

#include "viewer/camera.h"

namespace ramify {

/// Looks at `target` from `distance` metres; azimuth and elevation as in ViewDirection.
struct Orbit {
  Vec3 target{0.0};
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
  double distance = 10.0;
  bool is_parallel = false;

  bool operator==(const Orbit&) const = default;
};

/// Turned by a drag of so many pixels, to the right and down: half a turn over `height`, the picture's, in
/// pixels. Stops at straight down and straight up.
Orbit turned(Orbit orbit, const glm::dvec2& drag, double height);

/// Moved by a drag so that what is at the target's depth stays under the pointer. The picture measures `size`
/// pixels.
Orbit panned(Orbit orbit, const glm::dvec2& drag, const glm::dvec2& size);

/// Nearer by a fifth for each step, farther for each negative one; stays within a centimetre and 10 km.
Orbit zoomed(Orbit orbit, double steps);

/// With the distance, and the target, from which the points just fill a picture of this aspect.
Orbit framed(Orbit orbit, std::span<const Vec3> points, double aspect);

/// The camera of a picture of this aspect that keeps all of the box between its near and far planes, and the
/// ground up to `reach` metres around it. An empty box is a point at the target.
Camera camera_of(const Orbit& orbit, double aspect, const Box& box, double reach);

}  // namespace ramify
