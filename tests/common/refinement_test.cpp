// Triangles made smaller: they cover what they covered, meet edge to edge and are small enough in the end.

#include "common/mesh/refinement.h"

#include <cmath>
#include <map>

#include "common/base/rng.h"
#include "tests/catch.h"

using namespace ramify;

namespace {

/// Points of the plane z = 0, and triangles about them.
struct Sheet {
  std::vector<Vec3f> points;
  std::vector<Triangle> triangles;

  float length(const Edge& edge) const { return glm::distance(points[edge.first], points[edge.second]); }

  /// Twice its area, negative if it is turned over.
  float area(const Triangle& t) const {
    return glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]).z;
  }

  std::map<Edge, int> uses() const {
    std::map<Edge, int> uses;
    for (const auto& [a, b, c] : triangles) {
      ++uses[std::minmax(a, b)];
      ++uses[std::minmax(b, c)];
      ++uses[std::minmax(c, a)];
    }
    return uses;
  }

  /// Until edges that come within `reach` of the origin are no longer than `longest`. Returns how often.
  int refine_about_origin(float longest, float reach) {
    const EdgeRules rules{
        .is_coarse =
            [&](const Edge& edge) {
              const float near = std::min(glm::length(points[edge.first]), glm::length(points[edge.second]));
              return near < reach && length(edge) > longest;
            },
        .length = [&](const Edge& edge) { return length(edge); },
        .add_middle =
            [&](const Edge& edge) {
              points.push_back(0.5f * (points[edge.first] + points[edge.second]));
              return static_cast<std::uint32_t>(points.size() - 1);
            },
    };
    int times = 0;
    while (times < 40 && refine(triangles, rules)) ++times;
    return times;
  }
};

/// An uneven grid of n x n squares from -1 to 1, longer one way than the other.
Sheet grid(std::uint32_t n, std::uint64_t seed) {
  Rng rng = Rng::stream(seed, Stream::leaf, 0);
  Sheet sheet;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const bool is_inner = i % n != 0 && j % n != 0;
      const auto at = [&](std::uint32_t k) {
        return 2.0 * (k + (is_inner ? 0.6 * (rng.uniform() - 0.5) : 0.0)) / n - 1.0;
      };
      const double x = at(i);
      const double y = at(j);
      sheet.points.push_back(Vec3f(Vec3(5.0 * x, y, 0.0)));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      const std::uint32_t b = a + n + 1;
      sheet.triangles.push_back({a, b, b + 1});
      sheet.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return sheet;
}

}  // namespace

TEST_CASE("refinement: all edges that matter get short, and nothing gapes, overlaps or turns over") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    for (const float longest : {1.0f, 0.3f, 0.1f}) {
      Sheet sheet = grid(4, seed);
      const std::size_t before = sheet.triangles.size();
      CHECK(sheet.refine_about_origin(longest, 0.5f) < 30);
      CHECK(sheet.triangles.size() > before);
      float area = 0.0f;
      for (const Triangle& triangle : sheet.triangles) {
        CHECK(sheet.area(triangle) > 0.0f);
        area += 0.5f * sheet.area(triangle);
      }
      CHECK(area == Approx(20.0f).epsilon(1e-4));
      float rim = 0.0f;
      for (const auto& [edge, uses] : sheet.uses()) {
        CHECK(uses <= 2);
        if (uses == 1) rim += sheet.length(edge);
        const float near =
            std::min(glm::length(sheet.points[edge.first]), glm::length(sheet.points[edge.second]));
        if (near < 0.5f) CHECK(sheet.length(edge) <= longest);
      }
      CHECK(rim == Approx(24.0f));  // a gap would have a rim of its own
    }
  }
}

TEST_CASE("refinement: what is fine enough stays as it is") {
  Sheet sheet = grid(4, 1);
  const std::vector<Triangle> before = sheet.triangles;
  CHECK(sheet.refine_about_origin(10.0f, 0.5f) == 0);
  CHECK(sheet.triangles == before);
}
