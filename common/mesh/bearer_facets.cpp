#include "common/mesh/bearer_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ramify {
namespace {

/// Where a ray leaves the wood through a triangle, in lengths of `along`; infinite if it does not.
/// T. Moller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, J. Graphics Tools 2(1), 1997.
double exit_through(const Mesh& mesh, const Triangle& triangle, const Vec3& from, const Vec3& along) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const Vec3 a(mesh.positions[triangle[0]]);
  const Vec3 u = Vec3(mesh.positions[triangle[1]]) - a;
  const Vec3 v = Vec3(mesh.positions[triangle[2]]) - a;
  const double outwards = glm::dot(glm::cross(u, v), along);
  if (outwards <= 0.0) return none;
  const Vec3 apart = from - a;
  const Vec3 turned = glm::cross(apart, along);
  const double second = -glm::dot(v, turned) / outwards;
  const double third = glm::dot(u, turned) / outwards;
  if (second < 0.0 || third < 0.0 || second + third > 1.0) return none;
  const double length = -glm::dot(apart, glm::cross(u, v)) / outwards;
  return length >= 0.0 ? length : none;
}

}  // namespace

BearerFacets::BearerFacets(const Mesh& mesh, std::size_t first, std::size_t end, const Vec3& center,
                           double reach)
    : mesh_(mesh) {
  const Vec3f low(center - reach);
  const Vec3f high(center + reach);
  for (std::size_t t = first; t < end; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f& p = mesh.positions[a];
    const Vec3f& q = mesh.positions[b];
    const Vec3f& r = mesh.positions[c];
    const Vec3f least = glm::min(p, glm::min(q, r));
    const Vec3f most = glm::max(p, glm::max(q, r));
    if (glm::all(glm::lessThanEqual(least, high)) && glm::all(glm::lessThanEqual(low, most)))
      triangles_.push_back(static_cast<std::uint32_t>(t));
  }
  if (!triangles_.empty()) tree_.emplace(mesh, triangles_);
}

BearerFacets::Point BearerFacets::nearest(const Vec3& point) const {
  const NearestTriangle found = tree_->nearest(Vec3f(point));
  const auto& [a, b, c] = mesh_.triangles[found.triangle];
  // Between the facets' own normals, so that it tells inside from outside at their edges, too.
  const Vec3 normal(normalized_or(mesh_.normals[a] * found.shares.x + mesh_.normals[b] * found.shares.y +
                                      mesh_.normals[c] * found.shares.z,
                                  mesh_.normals[a]));
  const double distance = std::sqrt(double{found.distance2});
  const bool is_outside = glm::dot(point - Vec3(found.point), normal) > 0.0;
  return {Vec3(found.point), normal, is_outside ? distance : -distance};
}

double BearerFacets::greatest_height(std::span<const Vec3f> points) const {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Vec3f& point : points) greatest = std::max(greatest, nearest(Vec3(point)).height);
  return greatest;
}

double BearerFacets::exit_length(const Vec3& from, const Vec3& along) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : triangles_)
    least = std::min(least, exit_through(mesh_, mesh_.triangles[t], from, along));
  return std::isfinite(least) ? least : 0.0;
}

}  // namespace ramify
