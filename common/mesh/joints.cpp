#include "common/mesh/joints.h"

#include <algorithm>
#include <map>
#include <optional>

#include "common/mesh/axes.h"
#include "common/mesh/tube_plan.h"

namespace ramify {
namespace {

// In radii of both, by the sine of the angle between them: twice as far as their surfaces meet.
constexpr float kReach = 2.0f;
constexpr double kLeastSine = 0.35;

// In radii of both: laterals that leave an axis so near to one another meet.
constexpr double kBeside = 1.5;

// In those: so far an axis is followed that begins farther down.
constexpr double kAlong = 3.0;

class JointFinder {
 public:
  explicit JointFinder(const Skeleton& skeleton)
      : skeleton_(skeleton), first_(skeleton.node_count()), next_(skeleton.node_count(), kNoParent) {}

  std::vector<Joint> find() {
    const double thickest = *std::max_element(skeleton_.diameter.begin(), skeleton_.diameter.end());
    const Axes axes = find_axes(skeleton_);
    std::vector<std::uint32_t> laterals;
    for (const Axis& axis : axes.list) {
      if (axis.count == 0) continue;
      const std::uint32_t first = axes.points[axis.first + 1].node;
      for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point) {
        const std::uint32_t node = axes.points[point].node;
        first_[node] = first;
        if (point + 1 < axis.end()) next_[node] = axes.points[point + 1].node;
      }
      const bool is_lateral = !skeleton_.is_root(skeleton_.parent[first]);
      if (is_lateral && skeleton_.diameter[first] >= kLeastCollar * thickest) laterals.push_back(first);
    }
    for (const std::uint32_t lateral : laterals) add_lateral(lateral);
    for (Joint& joint : joints_) {
      joint.lateral_nodes = nodes_around(joint.lateral, joint.reach);
      joint.older_nodes = nodes_around(joint.older, joint.reach);
    }
    return std::move(joints_);
  }

 private:
  /// Its bearer, what leaves that beside it, and where the bearer itself has just begun, what bears that.
  void add_lateral(std::uint32_t lateral) {
    const std::uint32_t bearer = first_[skeleton_.parent[lateral]];
    std::uint32_t fork = skeleton_.parent[lateral];
    while (!skeleton_.is_root(fork)) {
      const std::uint32_t older = first_[fork];
      for (const std::uint32_t beside : laterals_[older]) {
        if (beside == bearer) continue;
        if (const auto node = node_near(lateral, beside)) add(lateral, *node);
      }
      add(lateral, fork);
      if (!is_near(lateral, older)) break;
      fork = skeleton_.parent[older];
    }
    laterals_[bearer].push_back(lateral);
  }

  /// Metres, from where a lateral begins to a node.
  double distance(std::uint32_t lateral, std::uint32_t node) const {
    return glm::distance(skeleton_.position[skeleton_.parent[lateral]], skeleton_.position[node]);
  }

  /// Within this many metres of where a lateral begins other wood meets it.
  double nearness(std::uint32_t lateral, std::uint32_t other) const {
    return kBeside * 0.5 * (skeleton_.diameter[lateral] + skeleton_.diameter[other]);
  }

  /// Whether two axes begin so near to one another that they meet.
  bool is_near(std::uint32_t lateral, std::uint32_t other) const {
    return distance(lateral, skeleton_.parent[other]) < nearness(lateral, other);
  }

  /// The first of an axis's nodes at which it is so near, if one is: it may begin farther down and run along
  /// the bearer.
  std::optional<std::uint32_t> node_near(std::uint32_t lateral, std::uint32_t beside) const {
    const double near = nearness(lateral, beside);
    const double apart = distance(lateral, skeleton_.parent[beside]);
    if (apart < near) return beside;
    double left = kAlong * near;
    if (apart > left + near) return std::nullopt;
    for (std::uint32_t node = beside; node != kNoParent && left >= 0.0; node = next_[node]) {
      if (distance(lateral, node) < near) return node;
      left -= skeleton_.length(node);
    }
    return std::nullopt;
  }

  void add(std::uint32_t lateral, std::uint32_t older) {
    Joint joint;
    joint.lateral = lateral;
    joint.older = older;
    joint.radius = static_cast<float>(0.5 * skeleton_.diameter[lateral]);
    joint.older_radius = static_cast<float>(0.5 * skeleton_.diameter[older]);
    const Vec3 along = normalized_or(skeleton_.along(lateral), kUp);
    const Vec3 older_along = normalized_or(skeleton_.along(older), kUp);
    const auto sine = static_cast<float>(std::max(glm::length(glm::cross(along, older_along)), kLeastSine));
    joint.reach = kReach * (joint.radius + joint.older_radius) / sine;
    joints_.push_back(std::move(joint));
  }

  /// Those whose internodes lie within `length` metres of the node's own, along the axis.
  std::vector<std::uint32_t> nodes_around(std::uint32_t node, double length) const {
    std::vector<std::uint32_t> nodes{node};
    double left = length;
    for (std::uint32_t i = next_[node]; i != kNoParent && left >= 0.0; i = next_[i]) {
      nodes.push_back(i);
      left -= skeleton_.length(i);
    }
    left = length;
    for (std::uint32_t i = node; first_[i] != i && left >= 0.0;) {
      i = skeleton_.parent[i];
      nodes.push_back(i);
      left -= skeleton_.length(i);
    }
    return nodes;
  }

  const Skeleton& skeleton_;
  std::vector<std::uint32_t> first_;                              // node of each node's axis
  std::vector<std::uint32_t> next_;                               // node on its axis
  std::map<std::uint32_t, std::vector<std::uint32_t>> laterals_;  // of an axis, by its first node
  std::vector<Joint> joints_;
};

}  // namespace

std::vector<Joint> find_joints(const Skeleton& skeleton) {
  return JointFinder(skeleton).find();
}

}  // namespace ramify
