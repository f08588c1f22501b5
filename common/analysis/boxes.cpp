#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/analysis/measures.h"
#include "common/analysis/statistics.h"

namespace ramify {
namespace {

constexpr int kCoarsest = 2;  // boxes of height / 2^2
constexpr int kFinest = 7;    // to height / 2^7
// Three coordinates in one number. Trees more than 16,000 times as wide as high have no dimension.
constexpr int kBitsEach = 21;
constexpr std::uint64_t kMostBoxes = std::uint64_t{1} << kBitsEach;

using Boxes = std::vector<std::uint64_t>;

std::uint64_t packed(const glm::i64vec3& box) {
  return static_cast<std::uint64_t>(box.x) << (2 * kBitsEach) |
         static_cast<std::uint64_t>(box.y) << kBitsEach | static_cast<std::uint64_t>(box.z);
}

std::uint64_t halved(std::uint64_t box) {
  constexpr std::uint64_t kMask = kMostBoxes - 1;
  return ((box >> (2 * kBitsEach)) >> 1) << (2 * kBitsEach) |
         (((box >> kBitsEach) & kMask) >> 1) << kBitsEach | (box & kMask) >> 1;
}

void keep_different(Boxes& boxes) {
  std::sort(boxes.begin(), boxes.end());
  boxes.erase(std::unique(boxes.begin(), boxes.end()), boxes.end());
}

/// The boxes that a straight line passes, from wall to wall.
/// J. Amanatides, A. Woo, A fast voxel traversal algorithm for ray tracing, Eurographics 1987.
void pass(const Vec3& from, const Vec3& to, const glm::i64vec3& last, Boxes& boxes) {
  const auto box_at = [&](const Vec3& p) { return glm::min(glm::i64vec3(glm::floor(p)), last); };
  glm::i64vec3 box = box_at(from);
  const glm::i64vec3 end = box_at(to);
  const Vec3 along = to - from;
  glm::i64vec3 left = glm::abs(end - box);  // walls still to pass
  glm::i64vec3 step(0);
  Vec3 next(std::numeric_limits<double>::infinity());  // where the next wall is, as a part of the line
  for (int i = 0; i < 3; ++i) {
    if (left[i] == 0) continue;
    step[i] = end[i] > box[i] ? 1 : -1;
    next[i] = (static_cast<double>(box[i] + (step[i] > 0 ? 1 : 0)) - from[i]) / along[i];
  }
  boxes.push_back(packed(box));
  while (left.x + left.y + left.z > 0) {
    const int i = next.x <= next.y && next.x <= next.z ? 0 : (next.y <= next.z ? 1 : 2);
    box[i] += step[i];
    --left[i];
    next[i] = left[i] == 0 ? std::numeric_limits<double>::infinity()
                           : (static_cast<double>(box[i] + (step[i] > 0 ? 1 : 0)) - from[i]) / along[i];
    boxes.push_back(packed(box));
  }
}

/// Of the finest size. Nothing for trees that are too flat.
std::optional<Boxes> finest_boxes(const Skeleton& s, double height) {
  Box around;
  for (const Vec3& position : s.position) around.include(position);
  const double size = height / std::exp2(kFinest);
  const Vec3 counts = glm::ceil(around.size() / size);
  if (!(std::max({counts.x, counts.y, counts.z}) < static_cast<double>(kMostBoxes))) return std::nullopt;
  // What lies on the far walls belongs to the boxes before them.
  const glm::i64vec3 last = glm::max(glm::i64vec3(counts) - std::int64_t{1}, glm::i64vec3(0));
  Boxes boxes;
  boxes.reserve(2 * s.node_count());
  for (std::size_t node = s.root_count(); node < s.node_count(); ++node) {
    pass((s.position[s.parent[node]] - around.low) / size, (s.position[node] - around.low) / size, last,
         boxes);
  }
  keep_different(boxes);
  return boxes;
}

}  // namespace

void measure_dimension(const Anatomy& stem, Metrics& metrics) {
  const Skeleton& s = stem.skeleton();
  if (!(metrics.height.value_or(0.0) > 0.0)) return;
  std::optional<Boxes> boxes = finest_boxes(s, *metrics.height);
  if (!boxes) return;
  std::vector<double> fineness;
  std::vector<double> counts;
  for (int i = kFinest; i >= kCoarsest; --i) {
    fineness.push_back(i * std::numbers::ln2);
    counts.push_back(std::log(static_cast<double>(boxes->size())));
    std::transform(boxes->begin(), boxes->end(), boxes->begin(), halved);
    keep_different(*boxes);
  }
  metrics.fractal_dimension = regression_slope(fineness, counts);
}

}  // namespace ramify
