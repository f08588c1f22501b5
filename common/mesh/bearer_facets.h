// The facets that a bearer's tube really has about a fork: where it turns sharply they lie deeper than the
// round wood of its skeleton, as its rings lean.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/base/geometry.h"
#include "common/mesh/mesh.h"
#include "common/mesh/nearest_triangle.h"

namespace ramify {

class BearerFacets {
 public:
  /// Of a mesh's triangles `first` to `end` those that come within `reach` of the center, metres. The mesh
  /// must outlive them. O(n).
  BearerFacets(const Mesh& mesh, std::size_t first, std::size_t end, const Vec3& center, double reach);

  struct Point {
    Vec3 position;
    Vec3 normal;          // unit, outwards
    double height = 0.0;  // of the point that it is nearest to; negative inside
  };

  /// The nearest point of the facets, of which there is at least one.
  Point nearest(const Vec3& point) const;

  /// How far the outermost of these points is outside; negative if all are inside.
  double greatest_height(std::span<const Vec3f> points) const;

  /// How far a ray goes until it first leaves the wood; 0 if it does not.
  double exit_length(const Vec3& from, const Vec3& along) const;

  bool is_empty() const { return triangles_.empty(); }

 private:
  const Mesh& mesh_;
  std::vector<std::uint32_t> triangles_;
  std::optional<TriangleTree> tree_;
};

}  // namespace ramify
