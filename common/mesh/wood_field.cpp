#include "common/mesh/wood_field.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace ramify {
namespace {

// The zone of a fork reaches so many times farther than parent and blend together: the crotch of a narrow
// fork is that far from its node.
constexpr double kZone = 2.5;

// Cosine of the angle to the vertical up to which a stem stands on the ground.
constexpr double kStanding = 0.5;

// Cosine of the angle to that up to which what starts at a root is cut off with it, if it does not leave the
// ground with its first internode: little of what lies would be left.
constexpr double kLying = 0.2;

// Cosine of the angle to its first cone up to which a part of an axis is straight.
constexpr double kStraight = 0.97;

/// Who follows whom on an axis, and the laterals of each node, among the internodes kept.
struct Branching {
  std::vector<std::uint32_t> continuation;
  std::vector<std::vector<std::uint32_t>> laterals;

  Branching(const Skeleton& skeleton, const std::vector<bool>& is_kept)
      : continuation(skeleton.node_count(), kNoParent), laterals(skeleton.node_count()) {
    for (std::uint32_t node = 0; node < skeleton.node_count(); ++node) {
      if (skeleton.is_root(node) || !is_kept[node]) continue;
      const std::uint32_t parent = skeleton.parent[node];
      if (skeleton.axis[node] == skeleton.axis[parent]) {
        continuation[parent] = node;
      } else {
        laterals[parent].push_back(node);
      }
    }
  }
};

/// What a tree's wood is cut off at below.
struct Ground {
  Vec3 at{0.0};
  Vec3 up{0.0};  // unit; 0: nothing is cut

  double height(const Vec3& point) const { return glm::dot(point - at, up); }
};

/// The plane through a root: level if the stem that goes on from it, or the only internode there, stands;
/// else square to that.
Ground ground_at(const Skeleton& skeleton, const Branching& branching, std::uint32_t root) {
  std::uint32_t stem = branching.continuation[root];
  if (stem == kNoParent && branching.laterals[root].size() == 1) stem = branching.laterals[root].front();
  if (stem == kNoParent) return {};
  const Vec3 along = normalized_or(skeleton.along(stem), Vec3(0.0), 1e-12);
  return {skeleton.position[root], glm::dot(along, kUp) > kStanding ? kUp : along};
}

/// Whether an internode stands on the ground at a root, or bulges into it from above. What lies or grows down
/// there, and roots, are not cut.
bool is_cut(const Skeleton& skeleton, const Ground& ground, std::uint32_t internode) {
  if (ground.up == Vec3(0.0) || skeleton.kind[internode] == Kind::root) return false;
  const std::uint32_t parent = skeleton.parent[internode];
  const double tip = ground.height(skeleton.position[internode]);
  const double tip_radius = 0.5 * skeleton.diameter[internode];
  if (skeleton.is_root(parent)) {
    const Vec3 along = normalized_or(skeleton.along(internode), Vec3(0.0), 1e-12);
    return tip > tip_radius || glm::dot(ground.up, along) > kLying;
  }
  const double base = ground.height(skeleton.position[parent]);
  return std::min(base, tip) > 0.0 && (base < skeleton.start_radius(internode) || tip < tip_radius);
}

/// Finds the forks of a field whose cones are made.
class ForkFinder {
 public:
  ForkFinder(const Skeleton& skeleton, const Branching& branching, const std::vector<std::uint32_t>& cone_of,
             const std::vector<RoundCone>& cones, double blend)
      : skeleton_(skeleton), branching_(branching), cone_of_(cone_of), cones_(cones), blend_(blend) {}

  /// Each lateral of `node` with the axis it leaves, and with the other laterals.
  void add_forks(std::uint32_t node, std::vector<ForkBlend>& forks) const {
    const std::vector<std::uint32_t>& laterals = branching_.laterals[node];
    for (std::size_t i = 0; i < laterals.size(); ++i) {
      const double radius = skeleton_.start_radius(laterals[i]);
      ForkBlend fork = empty_fork(node, radius, 0.5 * skeleton_.diameter[node]);
      add_parts(fork, cones_upwards(laterals[i], fork), cones_through(node, fork), forks);
      for (std::size_t j = 0; j < i; ++j) {
        ForkBlend sides = empty_fork(node, radius, skeleton_.start_radius(laterals[j]));
        add_parts(sides, cones_upwards(laterals[i], sides), cones_upwards(laterals[j], sides), forks);
      }
    }
  }

 private:
  ForkBlend empty_fork(std::uint32_t node, double radius, double other_radius) const {
    ForkBlend fork;
    fork.center = skeleton_.position[node];
    fork.width = blend_ * std::min(radius, other_radius);
    fork.zone = kZone * (std::max(radius, other_radius) + fork.width);
    return fork;
  }

  /// Each straight part of the one axis blends with each of the other. How far they do depends on the angle
  /// between their surfaces: if the nearest cones alone blended, it would jump on the inner side of a bend,
  /// where another cone becomes the nearest, and leave a step in the surface.
  void add_parts(ForkBlend fork, const std::vector<std::uint32_t>& cones,
                 const std::vector<std::uint32_t>& others, std::vector<ForkBlend>& forks) const {
    fork.cones = cones;
    fork.others = others;
    cut(fork);
    const std::vector<std::vector<std::uint32_t>> other_parts = straight_parts(others);
    for (const std::vector<std::uint32_t>& part : straight_parts(cones)) {
      for (const std::vector<std::uint32_t>& other : other_parts) {
        fork.cones = part;
        fork.others = other;
        forks.push_back(fork);
      }
    }
  }

  /// Of cones that follow one another.
  std::vector<std::vector<std::uint32_t>> straight_parts(const std::vector<std::uint32_t>& cones) const {
    std::vector<std::vector<std::uint32_t>> parts;
    for (const std::uint32_t index : cones) {
      if (parts.empty() || glm::dot(cones_[parts.back().front()].along, cones_[index].along) < kStraight)
        parts.emplace_back();
      parts.back().push_back(index);
    }
    return parts;
  }

  /// Where cones stand on the ground their blend does so too, unless real roots go on below.
  void cut(ForkBlend& fork) const {
    const RoundCone* standing = nullptr;
    for (const std::vector<std::uint32_t>& side : {fork.cones, fork.others}) {
      for (const std::uint32_t index : side) {
        const RoundCone& cone = cones_[index];
        if (skeleton_.kind[cone.internode] == Kind::root) return;
        if (cone.cut != Vec3(0.0)) standing = &cone;
      }
    }
    if (standing == nullptr) return;
    fork.cut = standing->cut;
    fork.cut_at = standing->cut_at;
  }

  bool is_near(std::uint32_t node, const ForkBlend& fork) const {
    return glm::length(skeleton_.position[node] - fork.center) < fork.zone + 0.5 * skeleton_.diameter[node];
  }

  std::vector<std::uint32_t> cones_upwards(std::uint32_t first, const ForkBlend& fork) const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t node = first; node != kNoParent; node = branching_.continuation[node]) {
      result.push_back(cone_of_[node]);
      if (!is_near(node, fork)) break;
    }
    return result;
  }

  /// From above downwards.
  std::vector<std::uint32_t> cones_through(std::uint32_t node, const ForkBlend& fork) const {
    std::vector<std::uint32_t> result = cones_upwards(branching_.continuation[node], fork);
    std::reverse(result.begin(), result.end());
    for (std::uint32_t below = node; !skeleton_.is_root(below); below = skeleton_.parent[below]) {
      result.push_back(cone_of_[below]);
      const bool is_same_axis = skeleton_.axis[skeleton_.parent[below]] == skeleton_.axis[below];
      if (!is_same_axis || !is_near(skeleton_.parent[below], fork)) break;
    }
    return result;
  }

  const Skeleton& skeleton_;
  const Branching& branching_;
  const std::vector<std::uint32_t>& cone_of_;
  const std::vector<RoundCone>& cones_;
  double blend_;
};

}  // namespace

RoundCone round_cone(const Vec3& base, double base_radius, const Vec3& tip, double tip_radius) {
  RoundCone cone{.base = base, .cut_at = base, .bounds = {}};
  cone.base_radius = base_radius;
  for (const double sign : {-1.0, 1.0}) {
    cone.bounds.include(base + sign * base_radius);
    cone.bounds.include(tip + sign * tip_radius);
  }
  const double length = glm::length(tip - base);
  const double narrowing = base_radius - tip_radius;
  if (length <= std::abs(narrowing) * (1.0 + 1e-9) || length == 0.0) {
    if (narrowing < 0.0) {
      cone.base = tip;
      cone.base_radius = tip_radius;
    }
    return cone;
  }
  cone.length = length;
  cone.along = (tip - base) / length;
  cone.sine = narrowing / length;
  cone.cosine = std::sqrt(1.0 - cone.sine * cone.sine);
  return cone;
}

double RoundCone::distance(const Vec3& point) const {
  const Vec3 apart = point - base;
  const double axial = glm::dot(apart, along);
  const double radial = glm::length(apart - along * axial);
  // Of the balls along the axis the one that is nearest: no steeper than the line that touches them all.
  const double at = std::clamp(axial - radial * sine / cosine, 0.0, length);
  const double value = std::hypot(radial, axial - at) - base_radius + at * sine;
  return cut == Vec3(0.0) ? value : std::max(value, glm::dot(cut_at - point, cut));
}

WoodField wood_field(const Skeleton& skeleton, const std::vector<bool>& is_kept, double blend) {
  const Branching branching(skeleton, is_kept);
  const std::size_t count = skeleton.node_count();
  WoodField field;
  field.cones.reserve(count);
  std::vector<std::uint32_t> cone_of(count, 0);
  std::vector<Ground> grounds;
  std::vector<std::uint32_t> root_of(count);
  for (std::uint32_t root = 0; root < skeleton.root_count(); ++root)
    grounds.push_back(ground_at(skeleton, branching, root));
  for (std::uint32_t node = 0; node < count; ++node) {
    if (skeleton.is_root(node)) {
      root_of[node] = node;
      continue;
    }
    const std::uint32_t parent = skeleton.parent[node];
    root_of[node] = root_of[parent];
    if (!is_kept[node]) continue;
    cone_of[node] = static_cast<std::uint32_t>(field.cones.size());
    RoundCone cone = round_cone(skeleton.position[parent], skeleton.start_radius(node),
                                skeleton.position[node], 0.5 * skeleton.diameter[node]);
    const Ground& ground = grounds[root_of[node]];
    if (is_cut(skeleton, ground, node)) {
      cone.cut = ground.up;
      cone.cut_at = ground.at;
    }
    cone.internode = node;
    field.cones.push_back(cone);
  }
  if (blend > 0.0) {
    const ForkFinder finder(skeleton, branching, cone_of, field.cones, blend);
    for (std::uint32_t node = 0; node < count; ++node) finder.add_forks(node, field.forks);
  }
  return field;
}

}  // namespace ramify
