#include "common/mesh/tube_plan.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "common/mesh/detail.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

// Knots nearer than this, in diameters, would make rings that cut into each other where thick wood bends in
// short internodes; nodes between stay well inside the wood.
constexpr double kKnotSpacing = 0.75;

// From ring to ring a line turns by no more: at coarse levels twice that.
constexpr double kTurnMax = radians(18.0);

// A straightened line looks back at no more knots than these.
constexpr std::size_t kLookBack = 64;

// A trunk that leans more than this, as a cosine, has no foot that stands on the ground.
constexpr double kLeastUpright = 0.3;

// Of the thickest wood: thinner twigs, which have three sides, just begin inside their parents. They are most
// of a tree, and a collar takes as long as the rest of a twig.
constexpr double kLeastCollar = 0.03;

// In radii of a lateral: its first knot is so far outside its parent, so that its collar has room.
constexpr double kClear = 1.2;

// A collar begins by so much inside the facets of the parent.
constexpr double kWithinFacets = 0.97;

constexpr std::size_t kGrain = 256;

std::uint8_t collar_stretches(std::uint32_t sides) {
  return static_cast<std::uint8_t>(sides <= 3 ? 1 : sides <= 5 ? 2 : sides <= 8 ? 3 : 5);
}

/// Chains the internodes of each axis and lists the tubes, parents before their laterals.
void find_axes(TubePlan& plan) {
  const Skeleton& skeleton = *plan.skeleton;
  const std::size_t roots = skeleton.root_count();
  plan.continuation.assign(skeleton.node_count(), kNoParent);
  const std::vector<bool> is_kept = kept_axes(skeleton, plan.tolerance);
  std::vector<std::uint32_t> tube_of(skeleton.node_count(), kNoParent);
  for (std::size_t i = roots; i < skeleton.node_count(); ++i) {
    const auto node = static_cast<std::uint32_t>(i);
    const std::uint32_t parent = skeleton.parent[node];
    const bool goes_on =
        skeleton.axis[node] == skeleton.axis[parent] && plan.continuation[parent] == kNoParent;
    if (goes_on) plan.continuation[parent] = node;
    if (goes_on && parent >= roots) {
      tube_of[node] = tube_of[parent];
      continue;
    }
    if (!is_kept[node]) continue;
    tube_of[node] = static_cast<std::uint32_t>(plan.tubes.size());
    plan.tubes.push_back({.base = parent, .first = node, .parent = tube_of[parent]});
  }
  for (Tube& tube : plan.tubes) {
    if (tube.base >= roots) continue;
    const std::uint32_t trunk = plan.continuation[tube.base];
    tube.is_closed = trunk == kNoParent || trunk == tube.first;
    if (!tube.is_closed) tube.parent = tube_of[trunk];
  }
}

/// Trunks that stand on the ground with a foot of their own: those without real roots.
void find_flares(TubePlan& plan) {
  const Skeleton& skeleton = *plan.skeleton;
  if (plan.flare <= 0.0) return;
  const std::size_t roots = skeleton.root_count();
  std::vector<bool> has_roots(roots, false);
  for (std::size_t node = roots; node < skeleton.node_count(); ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    if (parent < roots && skeleton.kind[node] == Kind::root) has_roots[parent] = true;
  }
  for (Tube& tube : plan.tubes) {
    tube.has_flare = tube.base < roots && tube.is_closed && tube.first == plan.continuation[tube.base] &&
                     !has_roots[tube.base] && plan.flare * plan.radius(tube.base) > plan.tolerance;
  }
}

/// Whether all knots after `from` are within `tolerance` of the straight stretch from it to `to`.
bool is_straight(std::span<const Knot> between, const Knot& from, const Knot& to, double tolerance) {
  const Vec3 step = to.position - from.position;
  const double length2 = std::max(glm::dot(step, step), 1e-24);
  for (const Knot& knot : between) {
    const double t = std::clamp(glm::dot(knot.position - from.position, step) / length2, 0.0, 1.0);
    const double apart = glm::length(knot.position - (from.position + step * t)) +
                         std::abs(knot.radius - glm::mix(from.radius, to.radius, t));
    if (apart > tolerance) return false;
  }
  return true;
}

/// Leaves out knots so that the line stays within `tolerance` of the one given.
void straighten(std::vector<Knot>& knots, double tolerance) {
  std::size_t kept = 0;  // knots[kept] is the last that stays
  std::size_t from = 0;  // where it stood
  std::vector<Knot>& line = knots;
  Knot anchor = line[0];
  for (std::size_t i = 2; i <= line.size(); ++i) {
    const bool is_end = i == line.size();
    const bool goes_on =
        !is_end && i - from <= kLookBack &&
        is_straight(std::span(line).subspan(from + 1, i - from - 1), anchor, line[i], tolerance);
    if (goes_on) continue;
    from = i - 1;
    anchor = line[from];
    line[++kept] = anchor;
  }
  line.resize(kept + 1);
}

class Planner {
 public:
  Planner(TubePlan& plan, const MesherOptions& options)
      : plan_(plan), skeleton_(*plan.skeleton), options_(options) {
    greatest_ = *std::max_element(skeleton_.diameter.begin(), skeleton_.diameter.end());
  }

  /// Chooses a tube's knots, sides and rings. `knots` and `points` are scratch.
  void plan(Tube& tube, std::vector<Knot>& knots, std::vector<LinePoint>& points) {
    tube.sides = sides(tube);
    choose_knots(tube, knots);
    if (knots.back().length <= plan_.thinnest && knots.size() == 2) return;  // a point
    const double radius = plan_.radius(tube.first);
    const double seen = std::max(2.0 * plan_.tolerance, 0.5 * kLeastCollar * greatest_);
    const bool is_seen = radius > seen;
    if (!tube.is_closed && is_seen && knots[1].length > plan_.radius(tube.base) + 0.5 * radius) {
      tube.collar = collar_stretches(tube.sides);
      knots[1].room *= kRoomBesideCollar;
    }
    const double turn_max = plan_.tolerance > 0.0 ? 2.0 * kTurnMax : kTurnMax;
    count_rings(knots, plan_.line, turn_max, 0.5 * plan_.tolerance);
    std::size_t rings = 1;
    for (std::size_t i = 1; i < knots.size(); ++i) {
      plan_.rings[knots[i].node] = static_cast<std::uint8_t>(knots[i].rings);
      rings += knots[i].rings;
    }
    tube.is_pointed = plan_.tolerance > 0.0 && tube.sides == 3 && knots.back().radius < plan_.tolerance;
    tube.has_flare = tube.has_flare && knots[0].along.y > kLeastUpright;
    if (tube.has_flare) {
      points.clear();
      const RootFlare flare = trace_tube(plan_, tube, knots, points);
      tube.flare_rings = rings_below(points, flare.height);
      rings = points.size();
    }
    tube.rings = static_cast<std::uint32_t>(rings) + tube.collar + (tube.has_round_tip() ? 1 : 0) -
                 (tube.is_pointed ? 1 : 0);
  }

 private:
  std::uint16_t sides(const Tube& tube) const {
    const double diameter = skeleton_.diameter[tube.first];
    const std::uint32_t wanted = side_count(diameter, greatest_, options_);
    return static_cast<std::uint16_t>(sides_within(wanted, 0.5 * diameter, plan_.tolerance));
  }

  Knot knot_at(std::uint32_t node) const {
    return {.position = skeleton_.position[node], .radius = plan_.radius(node), .node = node};
  }

  void choose_knots(const Tube& tube, std::vector<Knot>& knots) const {
    knots.clear();
    knots.push_back(knot_at(tube.base));
    if (!tube.is_closed) knots[0].radius = plan_.radius(tube.first);
    for (std::uint32_t node = tube.first; node != kNoParent; node = plan_.continuation[node]) {
      Knot knot = knot_at(node);
      const bool is_tip = plan_.continuation[node] == kNoParent;
      const double apart = glm::length(knot.position - knots.back().position);
      const bool is_crowded = apart < std::max(2.0 * kKnotSpacing * knot.radius, plan_.thinnest);
      const bool is_inside = knots.size() == 1 && !tube.is_closed && is_buried(tube.base, knot);
      if (is_tip) {
        if (is_crowded && knots.size() > 1) knots.pop_back();
        knots.push_back(knot);
      } else if (!is_crowded && !is_inside) {
        knots.push_back(knot);
      }
    }
    if (plan_.tolerance > 0.0) straighten(knots, 0.5 * plan_.tolerance);
    measure(knots);
  }

  /// Whether a lateral's knot still lies in the wood of the parent, about which the lateral begins.
  bool is_buried(std::uint32_t base, const Knot& knot) const {
    const double radius = plan_.radius(base);
    const double edge = radius + kClear * knot.radius;
    const Vec3 offset = knot.position - skeleton_.position[base];
    const double distance2 = glm::dot(offset, offset);
    if (distance2 < edge * edge) return true;
    if (distance2 > 9.0 * radius * radius) return false;
    const std::uint32_t next = plan_.continuation[base];
    const bool ends = next == kNoParent;
    if (ends && skeleton_.is_root(base)) return false;
    const Vec3 along = normalized_or(ends ? skeleton_.along(base) : skeleton_.along(next), kUp, 1e-12);
    const double height = glm::dot(offset, along);
    return !(ends && height > 0.0) && distance2 - height * height < edge * edge;
  }

  static std::uint32_t rings_below(const std::vector<LinePoint>& points, double height) {
    double from = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i > 0) from += glm::length(points[i].position - points[i - 1].position);
      // The last ring keeps the trunk's own sides, and the flare's end must not miss it by rounding.
      if (from > 0.999 * height || i + 1 == points.size()) return static_cast<std::uint32_t>(i);
    }
    return 0;
  }

  TubePlan& plan_;
  const Skeleton& skeleton_;
  const MesherOptions& options_;
  double greatest_ = 0.0;
};

// A ring repeats its first vertex at the end, where u jumps from 1 to 0. The tip has a vertex a side, a
// closed base its rim once more and a center.
std::size_t vertex_count(const Tube& tube) {
  const std::size_t base_sides = tube.sides * (tube.flare_rings > 0 ? 2 : 1);
  return tube.rings * (tube.sides + 1) + tube.flare_rings * tube.sides + tube.sides +
         (tube.is_closed ? base_sides + 1 : 0);
}

std::size_t triangle_count(const Tube& tube) {
  const std::size_t base_sides = tube.sides * (tube.flare_rings > 0 ? 2 : 1);
  std::size_t bands = (tube.rings - 1) * 2;  // of triangles a side
  if (tube.flare_rings > 0) bands += (tube.flare_rings - 1) * 2 + 1;
  return (bands + 1) * tube.sides + (tube.is_closed ? base_sides : 0);
}

}  // namespace

TubePlan plan_tubes(const Skeleton& skeleton, const MesherOptions& options, double tolerance) {
  TubePlan plan;
  plan.skeleton = &skeleton;
  plan.line = options.centre_line;
  plan.flare = options.root_flare;
  plan.tolerance = tolerance;
  plan.thinnest = thinnest_radius(skeleton);
  find_axes(plan);
  find_flares(plan);
  plan.rings.assign(skeleton.node_count(), 0);
  Planner planner(plan, options);
  parallel_for(plan.tubes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Knot> knots;
    std::vector<LinePoint> points;
    for (std::size_t i = begin; i < end; ++i) planner.plan(plan.tubes[i], knots, points);
  });
  for (Tube& tube : plan.tubes) {
    tube.first_vertex = plan.vertex_count;
    tube.first_triangle = plan.triangle_count;
    if (tube.rings == 0) continue;
    plan.vertex_count += vertex_count(tube);
    plan.triangle_count += triangle_count(tube);
  }
  return plan;
}

void collect_knots(const TubePlan& plan, const Tube& tube, std::vector<Knot>& knots) {
  const Skeleton& skeleton = *plan.skeleton;
  knots.clear();
  const std::uint32_t thick = tube.is_closed ? tube.base : tube.first;
  knots.push_back(
      {.position = skeleton.position[tube.base], .radius = plan.radius(thick), .node = tube.base});
  for (std::uint32_t node = tube.first; node != kNoParent; node = plan.continuation[node]) {
    if (plan.rings[node] == 0) continue;
    knots.push_back({.position = skeleton.position[node],
                     .radius = plan.radius(node),
                     .node = node,
                     .rings = plan.rings[node]});
  }
  measure(knots);
  if (tube.collar > 0) knots[1].room *= kRoomBesideCollar;
}

RootFlare trace_tube(const TubePlan& plan, const Tube& tube, const std::vector<Knot>& knots,
                     std::vector<LinePoint>& points) {
  trace_line(knots, plan.line, points);
  if (!tube.has_flare) return {};
  double length = 0.0;
  for (const Knot& knot : knots) length += knot.length;
  const RootFlare flare = flare_of(knots[0].radius, length, plan.flare);
  add_flare_points(flare, points);
  return flare;
}

Fork fork_at(const TubePlan& plan, const Tube& lateral) {
  const Skeleton& skeleton = *plan.skeleton;
  const std::uint32_t node = lateral.base;
  Fork fork;
  fork.center = skeleton.position[node];
  fork.radius = plan.radius(node);
  if (lateral.parent == kNoParent) return fork;

  // The parent's knots around the node: it may have been left out itself.
  const Tube& tube = plan.tubes[lateral.parent];
  const bool is_base = node == tube.base;
  std::uint32_t below = node;
  while (below != tube.base && (below == node || plan.rings[below] == 0)) below = skeleton.parent[below];
  std::uint32_t above = is_base ? tube.first : plan.continuation[node];
  while (above != kNoParent && plan.rings[above] == 0) above = plan.continuation[above];
  const bool is_knot = is_base || plan.rings[node] > 0;
  const bool is_lateral_base = below == tube.base && !tube.is_closed;
  const double radius_below = plan.radius(is_lateral_base ? tube.first : below);
  const double inscribed = std::cos(std::numbers::pi / tube.sides);
  fork.inset = kWithinFacets * inscribed;

  if (!is_knot && above != kNoParent) {  // on the straight stretch between two knots
    const Vec3 from = skeleton.position[below];
    const Vec3 step = skeleton.position[above] - from;
    const double length2 = std::max(glm::dot(step, step), 1e-24);
    const double t = std::clamp(glm::dot(fork.center - from, step) / length2, 0.0, 1.0);
    fork.center = from + step * t;
    fork.along = fork.run = normalized_or(step, kUp, 1e-12);
    fork.radius = glm::mix(radius_below, plan.radius(above), t);
    fork.widening_above = fork.widening_below = (plan.radius(above) - radius_below) / std::sqrt(length2);
    return fork;
  }
  const Vec3 before = skeleton.position[node] - skeleton.position[below];
  const double length_before = glm::length(before);
  const Vec3 after = above != kNoParent ? skeleton.position[above] - skeleton.position[node] : Vec3(0.0);
  const double length_after = glm::length(after);
  const Vec3 into = normalized_or(before, normalized_or(after, kUp, 1e-12), 1e-12);
  const Vec3 out = normalized_or(after, into, 1e-12);
  fork.run = 0.5 * (into + out);
  fork.bend = out - into;
  fork.along = normalized_or(fork.run, into);
  fork.is_ground = is_base;
  if (length_before > 0.0) fork.widening_below = (fork.radius - radius_below) / length_before;
  // A parent that ends here closes in a tip of about its own width.
  fork.widening_above = length_after > 0.0 ? (plan.radius(above) - fork.radius) / length_after : -0.7;
  if (plan.line == CentreLine::polyline && plan.rings[node] > 1) {
    const double room = is_lateral_base && tube.collar > 0 ? kRoomBesideCollar : 1.0;
    fork.reach = bend_reach(fork.radius, room * length_before, length_after);
    fork.center += fork.bend * (0.25 * fork.reach);
  } else if (plan.line == CentreLine::catmull_rom) {
    fork.reach = std::min(length_before, length_after);
  }
  return fork;
}

}  // namespace ramify
