// The foot of a trunk: it widens towards the ground and parts into lobes, from which its roots would go on.
#pragma once

#include <span>
#include <vector>

#include "common/mesh/centre_line.h"

namespace ramify {

struct RootFlare {
  double height = 0.0;  // along the trunk, metres; 0: none
  double amount = 0.0;  // of the radius, at the ground

  /// How many times its radius a trunk is wide, and how that changes, at a share of the height and an angle
  /// about the trunk.
  struct Widening {
    double factor = 1.0;
    double by_share = 0.0;
    double by_angle = 0.0;
  };
  Widening at(double share, double angle) const;
};

/// The flare of a trunk that starts on the ground with `radius` and is `length` long: low on a short one.
RootFlare flare_of(double radius, double length, double amount);

/// Puts points between those of a trunk's line where the flare bends its outline.
void add_flare_points(const RootFlare& flare, std::vector<LinePoint>& points);

}  // namespace ramify
