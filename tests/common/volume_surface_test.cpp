#include "common/volume/volume_surface.h"

#include <map>

#include "tests/catch.h"
#include "tests/common/solids.h"

using namespace ramify;
using ramify::test::known_volumes;
using ramify::test::KnownVolume;

namespace {

double enclosed_volume(const VolumeSurface& surface) {
  double volume = 0.0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 first(surface.positions[a]);
    volume += glm::dot(first, glm::cross(Vec3(surface.positions[b]), Vec3(surface.positions[c]))) / 6.0;
  }
  return volume;
}

/// Edges that are not gone along once each way.
int open_edges(const VolumeSurface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& corners : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = corners[k];
      const std::uint32_t to = corners[(k + 1) % 3];
      balance[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  int open = 0;
  for (const auto& [edge, sum] : balance) open += sum != 0;
  return open;
}

}  // namespace

TEST_CASE("volume surface: of every shape it encloses the volume that is known, and looks outwards") {
  for (const KnownVolume& known : known_volumes()) {
    if (known.name == "frame") continue;  // its walls are thinner than the voxels
    INFO(known.name);
    const VolumeSurface surface = surface_of(known.volume, 64);
    CHECK(enclosed_volume(surface) == Approx(known.cubic_metres).epsilon(0.04));
    if (known.volume.shape != Shape::box) CHECK(open_edges(surface) == 0);
    for (std::size_t i = 0; i < surface.triangles.size(); i += 37) {
      const auto& [a, b, c] = surface.triangles[i];
      const Vec3f across = glm::cross(surface.positions[b] - surface.positions[a],
                                      surface.positions[c] - surface.positions[a]);
      CHECK(glm::dot(across, surface.normals[a] + surface.normals[b] + surface.normals[c]) >= -1e-9f);
    }
  }
}

TEST_CASE("volume surface: the vertices of a ball lie on it, their normals point away from its middle") {
  const Volume ball{.shape = Shape::sphere, .center = {1.0, 2.0, 3.0}, .radius = 2.0};
  const VolumeSurface surface = surface_of(ball, 64);
  REQUIRE(surface.normals.size() == surface.positions.size());
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    const Vec3 out = Vec3(surface.positions[i]) - ball.center;
    CHECK(glm::length(out) == Approx(2.0).margin(0.01));
    CHECK(glm::dot(out, Vec3(surface.normals[i])) == Approx(2.0).margin(0.02));
  }
}

TEST_CASE("volume surface: a wall much thinner than it is long is whole, and nothing has none") {
  const Volume wall{.shape = Shape::box, .center = {0.0, 2.0, 0.0}, .size = {0.1, 4.0, 12.0}};
  CHECK(enclosed_volume(surface_of(wall, 64)) == Approx(4.8).epsilon(0.03));
  CHECK(surface_of({.shape = Shape::union_of}, 64).triangles.empty());
}
