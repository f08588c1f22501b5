#include "common/mesh/detail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/errors.h"

namespace ramify {
namespace {

constexpr std::size_t kLessEachLevel = 3;

// Tolerances are looked for between these, in parts of the tree's size, until they are within a few percent.
constexpr double kFinest = 1e-5;
constexpr double kCoarsest = 1.0;
constexpr int kHalvings = 15;

/// How far the tree reaches beyond each node, along its internodes and with its width, metres.
std::vector<float> reaches(const Skeleton& skeleton) {
  std::vector<float> reach(skeleton.node_count());
  for (std::size_t node = reach.size(); node-- > 0;) {
    reach[node] = std::max(reach[node], static_cast<float>(0.5 * skeleton.diameter[node]));
    if (skeleton.is_root(node)) continue;
    float& parent = reach[skeleton.parent[node]];
    parent = std::max(parent, reach[node] + static_cast<float>(skeleton.length(node)));
  }
  return reach;
}

}  // namespace

std::size_t triangle_budget(std::size_t full, const MesherOptions& options) {
  std::size_t budget = full;
  for (int level = 0; level < options.lod; ++level) budget /= kLessEachLevel;
  if (options.max_triangles > 0) budget = std::min(budget, static_cast<std::size_t>(options.max_triangles));
  return budget;
}

double least_tolerance(const Skeleton& skeleton, std::size_t budget,
                       const std::function<std::size_t(double)>& count) {
  Box box;
  for (const Vec3& position : skeleton.position) box.include(position);
  const double size = glm::length(box.size());
  double fine = std::log(kFinest * size);
  double coarse = std::log(kCoarsest * size);
  const std::size_t least = count(std::exp(coarse));
  if (least > budget) {
    throw InputError(
        fmt::format("mesher: the tree's mesh has at least {} triangles; {} are allowed by lod and "
                    "max_triangles",
                    least, budget));
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (fine + coarse);
    (count(std::exp(middle)) > budget ? fine : coarse) = middle;
  }
  return std::exp(coarse);
}

std::vector<bool> kept_axes(const Skeleton& skeleton, double tolerance) {
  std::vector<bool> is_kept(skeleton.node_count(), true);
  if (tolerance <= 0.0) return is_kept;
  const std::vector<float> reach = reaches(skeleton);
  for (std::size_t node = skeleton.root_count(); node < is_kept.size(); ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    const bool goes_on = skeleton.axis[node] == skeleton.axis[parent];
    is_kept[node] = is_kept[parent] && (goes_on || reach[node] + skeleton.length(node) > tolerance);
  }
  return is_kept;
}

std::uint32_t sides_within(std::uint32_t sides, double radius, double tolerance) {
  if (tolerance <= 0.0) return sides;
  if (tolerance >= 0.5 * radius) return 3;
  // The middle of a side lies r (1 - cos(pi / n)) inside the circle.
  const double enough = std::ceil(std::numbers::pi / std::acos(1.0 - tolerance / radius));
  return std::min(sides, static_cast<std::uint32_t>(std::clamp(enough, 3.0, 64.0)));
}

}  // namespace ramify
