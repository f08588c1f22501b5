#include "common/mesh/hollows.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace ramify {

void fill_hollows(const BulkVector<Vec3f>& positions, BulkVector<Triangle>& triangles) {
  std::vector<std::uint32_t> leader(positions.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  for (const auto& triangle : triangles) {
    const std::uint32_t first = find(triangle[0]);
    leader[find(triangle[1])] = first;
    leader[find(triangle[2])] = first;
  }
  std::vector<double> volume(positions.size(), 0.0);
  for (const auto& triangle : triangles) {
    const Vec3 a(positions[triangle[0]]);
    const Vec3 b(positions[triangle[1]]);
    const Vec3 c(positions[triangle[2]]);
    volume[find(triangle[0])] += glm::dot(a, glm::cross(b, c));
  }
  if (std::none_of(volume.begin(), volume.end(), [](double v) { return v < 0.0; })) return;
  const auto is_hollow = [&](const auto& triangle) { return volume[find(triangle[0])] < 0.0; };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_hollow), triangles.end());
}

}  // namespace ramify
