// Volumes to plan in: the family that the properties of nodes, graphs and trees are tried on.
#pragma once

#include <string>
#include <vector>

#include "common/volume/volume.h"
#include "pathplan/domain.h"

namespace ramify::test {

struct Place {
  std::string name;
  Volume volume;
  Vec3 root;  // in or on the volume
};

/// A volume in the world, without obstacles.
struct OpenDomain {
  explicit OpenDomain(const Volume& volume) : solid(volume), domain{solid, surroundings} {}

  Solid solid;
  pathplan::Surroundings surroundings;
  pathplan::Domain domain;
};

inline std::vector<Place> places() {
  const Volume trunk{.shape = Shape::cylinder, .radius = 0.6, .height = 3.0};
  const Volume crown{.shape = Shape::hemisphere, .center = {0.0, 2.5, 0.0}, .radius = 2.5};
  const Volume tilted{.shape = Shape::cylinder, .radius = 0.7, .height = 4.0, .direction = {1.0, 1.0, 0.5}};
  const Volume ball{.shape = Shape::sphere, .center = {2.5, 2.5, 1.25}, .radius = 1.5};
  return {
      {"sphere", {.shape = Shape::sphere, .radius = 2.0}, {0.0, 0.0, 0.0}},
      {"mushroom", {.shape = Shape::union_of, .parts = {trunk, crown}}, {0.0, 0.0, 0.0}},
      {"tilted trunk", {.shape = Shape::union_of, .parts = {tilted, ball}}, {0.0, 0.0, 0.0}},
      {"portion",
       {.shape = Shape::sphere_portion, .radius = 3.0, .angle_deg = 40.0, .direction = {-1.0, 0.2, 0.3}},
       {0.0, 0.0, 0.0}},
      {"bowl",  // not convex
       {.shape = Shape::sphere_portion, .radius = 2.0, .angle_deg = 150.0, .direction = {0.0, -1.0, 0.0}},
       {0.0, -1.0, 0.0}},
      {"cone", {.shape = Shape::cone, .radius = 1.5, .height = 4.0}, {0.0, 0.0, 0.0}},
      {"ellipsoid", {.shape = Shape::ellipsoid, .radii = {1.0, 2.0, 3.0}}, {0.0, -2.0, 0.0}},
  };
}

}  // namespace ramify::test
