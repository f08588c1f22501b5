#include "common/mesh/nearest_triangle.h"

#include <algorithm>

namespace ramify {
namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles

using Corners = std::array<Vec3f, 3>;

Corners corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

/// Shares of the corners in the point of a triangle's plane below `point`; negative ones outside.
Vec3f shares_in_plane(const Corners& corners, const Vec3f& point) {
  const Vec3f u = corners[1] - corners[0];
  const Vec3f v = corners[2] - corners[0];
  const Vec3f normal = glm::cross(u, v);
  const float area2 = glm::dot(normal, normal);
  if (area2 <= 0.0f) return Vec3f(-1.0f);
  const Vec3f from = point - corners[0];
  const float second = glm::dot(glm::cross(from, v), normal) / area2;
  const float third = glm::dot(glm::cross(u, from), normal) / area2;
  return {1.0f - second - third, second, third};
}

Vec3f nearest_shares(const Corners& corners, const Vec3f& point) {
  const Vec3f inside = shares_in_plane(corners, point);
  if (std::min({inside.x, inside.y, inside.z}) >= 0.0f) return inside;
  Vec3f best(0.0f);
  float least = std::numeric_limits<float>::infinity();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3f from = corners[static_cast<std::size_t>(i)];
    const Vec3f edge = corners[static_cast<std::size_t>(j)] - from;
    const float length2 = glm::dot(edge, edge);
    const float t = length2 > 0.0f ? std::clamp(glm::dot(point - from, edge) / length2, 0.0f, 1.0f) : 0.0f;
    const Vec3f apart = point - (from + edge * t);
    if (glm::dot(apart, apart) >= least) continue;
    least = glm::dot(apart, apart);
    best = Vec3f(0.0f);
    best[i] = 1.0f - t;
    best[j] = t;
  }
  return best;
}

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh, std::vector<std::uint32_t> triangles)
    : mesh_(mesh), triangles_(std::move(triangles)) {
  std::vector<Item> items;
  items.reserve(triangles_.size());
  for (const std::uint32_t triangle : triangles_) {
    const auto [a, b, c] = corners_of(mesh, triangle);
    items.push_back({triangle, a + b + c, glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
  }
  nodes_.reserve(items.size());
  add(items, 0, static_cast<std::uint32_t>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) triangles_[i] = items[i].triangle;
}

std::uint32_t TriangleTree::add(std::vector<Item>& items, std::uint32_t first, std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{.first = first, .count = count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    node.low = glm::min(node.low, items[i].low);
    node.high = glm::max(node.high, items[i].high);
  }
  nodes_.push_back(node);
  if (count <= kLeaf) return index;

  const Vec3f size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = items.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](const Item& a, const Item& b) { return a.place[axis] < b.place[axis]; });
  add(items, first, count / 2);
  const std::uint32_t second_half = add(items, first + count / 2, count - count / 2);
  nodes_[index].second_half = second_half;
  return index;
}

NearestTriangle TriangleTree::nearest(const Vec3f& point) const {
  NearestTriangle best;
  look(0, point, best);
  return best;
}

void TriangleTree::look(std::uint32_t index, const Vec3f& point, NearestTriangle& best) const {
  const Node& node = nodes_[index];
  if (node.second_half == 0) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners corners = corners_of(mesh_, triangles_[i]);
      const Vec3f shares = nearest_shares(corners, point);
      const Vec3f on = corners[0] * shares.x + corners[1] * shares.y + corners[2] * shares.z;
      const float distance2 = glm::dot(point - on, point - on);
      if (distance2 < best.distance2) best = {triangles_[i], shares, on, distance2};
    }
    return;
  }
  const auto distance2_to = [&](std::uint32_t half) {
    const Vec3f apart = point - glm::clamp(point, nodes_[half].low, nodes_[half].high);
    return glm::dot(apart, apart);
  };
  std::uint32_t near = index + 1;
  std::uint32_t far = node.second_half;
  if (distance2_to(far) < distance2_to(near)) std::swap(near, far);
  if (distance2_to(near) < best.distance2) look(near, point, best);
  if (distance2_to(far) < best.distance2) look(far, point, best);
}

}  // namespace ramify
