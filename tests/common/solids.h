// Solids with what is known of them: the family that the tests of volumes go through.
#pragma once

#include <string>
#include <vector>

#include "common/volume/volume.h"

namespace ramify::test {

/// A volume and its size in closed form, cubic metres.
struct KnownVolume {
  std::string name;
  Volume volume;
  double cubic_metres = 0.0;
};

/// Directions that an axis may have: along the world's axes and not, of any length.
const std::vector<Vec3>& tilts();

/// Each shape that needs no file, upright and tilted.
std::vector<KnownVolume> known_shapes();

/// The same shapes and others, scaled, turned, moved, cut off and put together.
std::vector<KnownVolume> known_compositions();

/// Both of them.
std::vector<KnownVolume> known_volumes();

/// Points all over a box that is somewhat larger than the volume's.
std::vector<Vec3> points_around(const Volume& volume, std::uint64_t count);

/// Looks at many segments, along which many points are asked: none is inside where the solid is not met, and
/// where it is, one of them is not known to be farther than `tolerance` from it, metres.
void check_meets(const Volume& volume, double tolerance);

/// Checks that two numbers are near each other, and says whether they are.
bool is_near(double value, double expected, double tolerance);

/// What check_volume() says of a volume with this key; empty if it is sound.
std::string problem_of(const std::string& key, const Volume& volume);

}  // namespace ramify::test
