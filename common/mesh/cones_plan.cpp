#include "common/mesh/cones_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/mesh/axes.h"
#include "common/mesh/detail.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

// Cosine beyond which an axis bends at a node: the ends of both cones would stand out of a sphere of as few
// sides.
const double kStraight = std::cos(radians(8.0));

// Cosine down to which cones of a bend are cut: beyond, they would end in a spike.
const double kCut = std::cos(radians(60.0));

// Of the length of a cone: a cut reaches no farther from its end.
constexpr double kCutReach = 0.3;

// Half the angle between the sides of two cones that follow one another: beyond, what is between is a
// shoulder.
const double kShoulder = radians(20.0);

// Cosine below which an axis turns back: its bark starts anew there.
constexpr double kTurnsBack = -0.5;

// Circles of latitude of the sphere at a tip, of which half is seen: with fewer it would look pointed.
constexpr std::uint32_t kTipLatitudes = 5;

// Of a twig of less than so many sides.
constexpr std::uint32_t kTwigSides = 5;
constexpr std::uint32_t kTwigTipLatitudes = 3;

// Of an axis that winds: bark that lies by the place is not straight along the sides of its cones and
// spheres, and where these meet with too few of them it would jump, by a length that goes with its radius
// over their square.
constexpr std::uint32_t kWindingBands = 6;
constexpr double kWindingSides = 3.0;  // times as many on the thickest wood
constexpr double kLeastWindingSides = 2.0;

// A ring repeats its first vertex at the end, where u jumps from 1 to 0; a pole has a vertex a side.
std::size_t vertex_count(const NodePart& part) {
  const std::size_t of_cone = part.has_cone ? (part.bands + 1) * (part.sides + 1) : 0;
  if (!part.has_sphere) return of_cone;
  return of_cone + part.latitudes() * (part.sphere_sides + 1) + 2 * part.sphere_sides;
}

std::size_t triangle_count(const NodePart& part) {
  // Both caps of a sphere together have as many as one band.
  return (part.has_cone ? 2 * part.bands * part.sides : 0) +
         (part.has_sphere ? 2 * part.latitudes() * part.sphere_sides : 0);
}

/// Whether the bends at both ends of a cone leave too little bark between them on some side. What is seen of
/// it is then cut off by more than the cones next to it.
bool is_squeezed(const NodePart& part, double length) {
  const auto reach = [&](double radius, const Vec3& bend) {
    return radius * glm::length(glm::cross(part.along, bend)) / glm::dot(part.along, bend);
  };
  const double bends = reach(part.base_radius, part.base_bend) + reach(part.radius, part.bend);
  return bends > (1.0 - kLeastBark) * length;
}

/// Whether each node's axis goes on from its parent: also one that leaves another's end, see Axis.
std::vector<bool> find_going_on(const Skeleton& skeleton) {
  std::vector<bool> goes_on(skeleton.node_count(), false);
  const Axes axes = find_axes(skeleton);
  for (const Axis& axis : axes.list) {
    for (std::uint32_t point = axis.first + 1; point < axis.end(); ++point) {
      const std::uint32_t node = axes.points[point].node;
      goes_on[node] = point > axis.first + 1 || skeleton.axis[node] == skeleton.axis[skeleton.parent[node]];
    }
  }
  return goes_on;
}

/// Lets two cones that follow one another meet about the node between them.
void join_cones(NodePart& below, NodePart& above) {
  const double low = below.end_lean;
  const double high = above.base_lean;
  const double half_apart = 0.5 * (high - low);
  below.end_meeting = above.base_meeting = below.radius * std::sin(0.5 * (low + high)) / std::cos(half_apart);
  // At a bend the sphere is seen, unless both are cut; as a shoulder it is rounder than an edge.
  const bool shows_sphere = half_apart > kShoulder || glm::dot(below.along, above.along) < kStraight;
  if (shows_sphere) return;
  below.end_lean = above.base_lean = 0.5 * (low + high);
  if (half_apart <= 0.0) return;
  below.end_gap = below.radius * std::tan(half_apart) / std::cos(low);
  above.base_gap = below.radius * std::tan(half_apart) / std::cos(high);
}

/// Lets the cones of a bend end in its plane, but where that would be far from the node. `shorter`: of both
/// internodes, metres.
void cut_cones(NodePart& below, NodePart& above, double shorter) {
  const double cosine = glm::dot(below.along, above.along);
  const double reach = below.radius * std::sqrt((1.0 - cosine) / (1.0 + cosine));
  const bool is_steep = std::max(std::abs(below.sine), std::abs(above.sine)) > std::sin(kShoulder);
  if (cosine >= kStraight || cosine < kCut || is_steep || reach > kCutReach * shorter) return;
  below.end_is_cut = above.base_is_cut = true;
  below.sphere_sides = below.sides;
  // Within all facets.
  below.sphere_radius = below.radius * std::cos(std::numbers::pi / below.sides) * std::cos(kShoulder);
  below.end_meeting = above.base_meeting = 0.0;
  below.end_lean = above.base_lean = 0.5 * (below.end_lean + above.base_lean);
}

/// Lets an axis go on from one internode to the next: in one bark, but where it turns back.
void go_on(NodePart& below, NodePart& part, bool is_fine) {
  below.is_tip = false;
  part.v += below.v;
  const double cosine = glm::dot(below.along, part.along);
  if (is_fine && cosine < kStraight) below.sphere_sides = 2 * below.sides;
  if (cosine <= kTurnsBack) return;
  below.bend = part.base_bend = glm::normalize(below.along + part.along);
  if (below.has_cone && part.has_cone) join_cones(below, part);
}

/// Bark lies on these by the place alone.
void find_winding_axes(const Skeleton& skeleton, const std::vector<bool>& going_on, double tolerance,
                       ConesPlan& plan) {
  std::vector<std::uint32_t> first(plan.parts.size());  // node of each one's axis
  std::vector<bool> winds(plan.parts.size(), false);    // of those nodes
  for (std::uint32_t node = 0; node < first.size(); ++node) {
    const NodePart& part = plan.parts[node];
    first[node] = going_on[node] ? first[skeleton.parent[node]] : node;
    if (part.has_cone && is_squeezed(part, skeleton.length(node)))
      winds[first[node]] = plan.has_winding = true;
  }
  const double greatest = std::ranges::max(plan.parts, {}, &NodePart::radius).radius;
  for (std::size_t node = 0; node < first.size(); ++node) {
    NodePart& part = plan.parts[node];
    part.winds = winds[first[node]];
    if (!part.winds || tolerance > 0.0) continue;
    const double times = kWindingSides * std::sqrt(plan.parts[first[node]].radius / greatest);
    part.bands = std::max(part.bands, kWindingBands);
    part.sides = part.sphere_sides =
        static_cast<std::uint32_t>(std::lround(std::max(times, kLeastWindingSides) * part.axis_sides));
  }
}

/// Of axes that do not wind.
void cut_bends(const Skeleton& skeleton, const std::vector<bool>& going_on, ConesPlan& plan) {
  for (std::uint32_t node = 0; node < plan.parts.size(); ++node) {
    if (!going_on[node]) continue;
    const std::uint32_t parent = skeleton.parent[node];
    NodePart& part = plan.parts[node];
    NodePart& below = plan.parts[parent];
    if (part.winds || !part.has_cone || !below.has_cone) continue;
    cut_cones(below, part, std::min(skeleton.length(parent), skeleton.length(node)));
  }
}

/// With a tolerance, metres, axes that reach no farther are left out, like spheres of its size.
ConesPlan plan_within(double tolerance, const Skeleton& skeleton, const std::vector<bool>& going_on,
                      const MesherOptions& options) {
  const double thinnest = thinnest_radius(skeleton);
  const double greatest = *std::max_element(skeleton.diameter.begin(), skeleton.diameter.end());
  const std::vector<bool> is_kept = kept_axes(skeleton, tolerance);
  ConesPlan plan;
  plan.parts.resize(skeleton.node_count());
  plan.has_roots.assign(skeleton.root_count(), false);
  for (std::uint32_t node = 0; node < plan.parts.size(); ++node) {
    NodePart& part = plan.parts[node];
    part.radius = part.sphere_radius = std::max(0.5 * skeleton.diameter[node], thinnest);
    part.axis_sides = going_on[node] ? plan.parts[skeleton.parent[node]].axis_sides
                                     : side_count(skeleton.diameter[node], greatest, options);
    part.sides = part.sphere_sides = sides_within(part.axis_sides, part.radius, tolerance);
    part.has_sphere = is_kept[node] && part.radius > tolerance;
    part.is_tip = tolerance <= 0.0;
    part.root = node;
    part.along = part.bend = kUp;
    part.side = any_perpendicular(kUp);
    if (skeleton.is_root(node)) continue;

    const std::uint32_t parent = skeleton.parent[node];
    const double length = skeleton.length(node);
    NodePart& below = plan.parts[parent];
    part.root = below.root;
    part.along = part.bend = part.base_bend = normalized_or(skeleton.along(node), below.along, thinnest);
    part.side = transported(below.side, below.along, part.along);
    part.base_radius = going_on[node] ? below.radius : part.radius;
    part.v = length / (std::numbers::pi * (part.base_radius + part.radius));
    part.has_cone = is_kept[node] && length > std::abs(part.base_radius - part.radius) + thinnest;
    if (part.has_cone) part.sine = (part.base_radius - part.radius) / length;
    part.base_lean = part.end_lean = std::asin(part.sine);
    if (tolerance <= 0.0 && part.base_radius >= kThickTaper * 0.5 * greatest)
      part.bands = bands_of_taper(part.base_radius, part.radius);
    if (going_on[node]) go_on(below, part, tolerance <= 0.0);
    if (skeleton.is_root(parent) && part.along.y < 0.0) plan.has_roots[parent] = true;
  }
  find_winding_axes(skeleton, going_on, tolerance, plan);
  if (tolerance <= 0.0) cut_bends(skeleton, going_on, plan);
  for (NodePart& part : plan.parts) {
    part.first_vertex = plan.vertex_count;
    part.first_triangle = plan.triangle_count;
    plan.vertex_count += vertex_count(part);
    plan.triangle_count += triangle_count(part);
  }
  return plan;
}

}  // namespace

std::uint32_t NodePart::latitudes() const {
  const std::uint32_t at_tip = sides < kTwigSides ? kTwigTipLatitudes : kTipLatitudes;
  return std::max(is_tip ? at_tip : 1u, sphere_sides / 2 - 1) | 1u;
}

ConesPlan plan_cones(const Skeleton& skeleton, const MesherOptions& options) {
  const std::vector<bool> going_on = find_going_on(skeleton);
  ConesPlan plan = plan_within(0.0, skeleton, going_on, options);
  const std::size_t budget = triangle_budget(plan.triangle_count, options);
  if (plan.triangle_count <= budget) return plan;
  const auto count = [&](double tolerance) {
    return plan_within(tolerance, skeleton, going_on, options).triangle_count;
  };
  return plan_within(least_tolerance(skeleton, budget, count), skeleton, going_on, options);
}

}  // namespace ramify
