#include "common/mesh/refinement.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace ramify {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// From the first corner to the second, and so on.
std::array<Edge, 3> edges_of(const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)};
}

/// Of a triangle whose edges have middles or not.
void append_parts(Triangle corners, Triangle middles, std::vector<Triangle>& parts) {
  const auto count = 3 - std::ranges::count(middles, kNoVertex);
  if (count == 0) return parts.push_back(corners);
  // With one middle it is on the first edge, with two the last edge has none.
  while ((count == 1 && middles[0] == kNoVertex) || (count == 2 && middles[2] != kNoVertex)) {
    std::ranges::rotate(corners, corners.begin() + 1);
    std::ranges::rotate(middles, middles.begin() + 1);
  }
  const auto& [a, b, c] = corners;
  const auto& [ab, bc, ca] = middles;
  if (count == 1) {
    parts.insert(parts.end(), {{a, ab, c}, {ab, b, c}});
  } else if (count == 2) {
    parts.insert(parts.end(), {{ab, b, bc}, {a, ab, bc}, {a, bc, c}});
  } else {
    parts.insert(parts.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
}

}  // namespace

bool refine(std::vector<Triangle>& triangles, const EdgeRules& rules) {
  std::map<Edge, std::uint32_t> middles;
  for (const Triangle& triangle : triangles) {
    const std::array<Edge, 3> edges = edges_of(triangle);
    if (std::ranges::none_of(edges, rules.is_coarse)) continue;
    const Edge longest = std::ranges::max(edges, {}, rules.length);
    const auto [middle, is_new] = middles.try_emplace(longest, kNoVertex);
    if (is_new) middle->second = rules.add_middle(longest);
  }
  if (middles.empty()) return false;
  std::vector<Triangle> parts;
  for (const Triangle& triangle : triangles) {
    Triangle middles_here{};
    std::ranges::transform(edges_of(triangle), middles_here.begin(), [&](const Edge& edge) {
      const auto middle = middles.find(edge);
      return middle == middles.end() ? kNoVertex : middle->second;
    });
    append_parts(triangle, middles_here, parts);
  }
  triangles = std::move(parts);
  return true;
}

}  // namespace ramify
