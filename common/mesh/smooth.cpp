#include "common/mesh/smooth.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <ranges>
#include <span>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/detail.h"
#include "common/mesh/plain_tubes.h"
#include "common/mesh/sharp_turns.h"
#include "common/mesh/tube_plan.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

constexpr std::size_t kGrain = 256;
constexpr std::size_t kGrainOfCollars = 4;

// Of a round tip, in radii of its branch: where its ring stands and how wide it is.
constexpr float kTipRing = 0.6f;
constexpr float kTipRingRadius = 0.75f;

// In radii of the bearer: a collar that stands out by more is laid anew, on the facets that lie so near.
constexpr double kStandsOut = 0.01;
constexpr double kFacetsReach = 3.0;

/// Unit vectors along a tube's line and across it.
struct Frame {
  Vec3f along;
  Vec3f side;
  Vec3f across;

  void set(const Vec3f& new_along, const Vec3f& new_side) {
    along = new_along;
    side = new_side;
    across = glm::cross(along, side);
  }

  /// Carries it on without twist to where the line runs along `next` (parallel transport).
  void turn_to(const Vec3f& next) {
    // The turn from a to b takes v, square to a, to v - (a + b) b.v / (1 + a.b). Half a turn leaves it.
    const float cosine = glm::dot(along, next);
    Vec3f carried = side;
    if (cosine > kHalfTurn) carried -= (along + next) * (glm::dot(next, side) / (1.0f + cosine));
    // A step of Newton's: rounding would add up over thousands of rings.
    set(next, carried * (1.5f - 0.5f * glm::dot(carried, carried)));
  }
};

/// A unit vector square to a line's direction, found without a branch: any_perpendicular() goes a way of its
/// own for each twig, which the processor does not foresee.
/// T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
Vec3f square_to(const Vec3f& along) {
  const float sign = std::copysign(1.0f, along.z);
  const float a = -1.0f / (sign + along.z);
  return {along.x * along.y * a, sign + along.y * along.y * a, -along.y};
}

/// Writes tubes into their parts of the mesh, one after the other.
class TubeWriter {
 public:
  TubeWriter(const TubePlan& plan, Mesh& mesh) : plan_(plan), mesh_(mesh) {}

  void write(std::size_t index) {
    Fork fork;
    if (plan_.tubes[index].collar > 0) fork = fork_at(plan_, index);
    write(index, fork);
    if (tube_->collar > 0 && may_stand_out(fork, first_ring(index))) standing_out_.push_back(index);
  }

  /// Those of the tubes written whose collars may stand out of their bearers.
  const std::vector<std::size_t>& standing_out() const { return standing_out_; }

  /// Writes one of those anew, on its bearer's facets, if it does. Its bearer must have been written.
  void mend(std::size_t index) {
    Fork fork = fork_at(plan_, index);
    const BearerFacets facets = facets_about(index, fork);
    if (facets.is_empty() || facets.greatest_height(first_ring(index)) <= kStandsOut * fork.radius) return;
    fork.facets = &facets;
    write(index, fork);
  }

 private:
  void write(std::size_t index, const Fork& fork) {
    tube_ = &plan_.tubes[index];
    collect_knots(plan_, index, knots_);
    if (tube_->collar > 0) move_base(fork);
    points_.clear();
    flare_ = trace_tube(plan_, *tube_, knots_, points_);
    vertex_ = tube_->first_vertex;
    triangle_ = tube_->first_triangle;
    frame_.set(points_[0].along, square_to(points_[0].along));
    v_ = 0.0f;
    from_base_ = 0.0f;
    if (tube_->collar > 0) write_collar(fork);
    circle_ = unit_circle(tube_->sides);
    middles_ = unit_circle(2 * tube_->sides) + 1;
    // Nearly all tubes of a large tree have three sides: there the compiler unrolls what runs over them.
    if (tube_->sides == 3) {
      write_rings<3>();
      write_tip<3>();
    } else {
      write_rings<0>();
      write_tip<0>();
    }
    if (tube_->is_closed) write_flat_end();
    if (tube_->is_low) lay_on_ground(index);
  }

  BearerFacets facets_about(std::size_t index, const Fork& fork) const {
    const auto [first, end] = triangles_around(plan_, plan_.axes->list[index].bearer);
    const std::ranges::iota_view all(first, end);
    const auto node_of = [&](std::size_t t) { return mesh_.internodes[mesh_.triangles[t][0]]; };
    // Along an axis each node is greater than the one before.
    const auto low = std::ranges::lower_bound(all, fork.line.front().node, {}, node_of);
    const auto high = std::ranges::upper_bound(low, all.end(), fork.line.back().node, {}, node_of);
    return {mesh_, *low, *high, fork.center, kFacetsReach * fork.radius};
  }

  std::span<const Vec3f> first_ring(std::size_t index) const {
    return {&mesh_.positions[plan_.tubes[index].first_vertex], plan_.tubes[index].sides};
  }

  template <std::uint32_t Sides>
  std::uint32_t side_count() const {
    return Sides > 0 ? Sides : tube_->sides;
  }

  void move_base(const Fork& fork) {
    knots_[0].position = Vec3f(fork.center);
    measure(knots_);
    knots_[1].room *= kRoomBesideCollar;
  }

  void set_vertex(std::size_t vertex, const Vec3f& position, const Vec3f& normal, float u, float v,
                  std::uint32_t node) {
    mesh_.positions[vertex] = position;
    mesh_.normals[vertex] = glm::normalize(normal);
    mesh_.uvs[vertex] = {u, v};
    mesh_.internodes[vertex] = node;
  }

  void add_triangle(std::size_t a, std::size_t b, std::size_t c) {
    mesh_.triangles[triangle_++] = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                    static_cast<std::uint32_t>(c)};
  }

  /// Joins two rings of as many sides.
  template <std::uint32_t Sides>
  void join(std::size_t low_ring, std::size_t high_ring, std::uint32_t sides_here) {
    const std::uint32_t sides = Sides > 0 ? Sides : sides_here;
    const auto low = static_cast<std::uint32_t>(low_ring);
    const auto high = static_cast<std::uint32_t>(high_ring);
    std::array<std::uint32_t, 3>* triangles = mesh_.triangles.data() + triangle_;
    for (std::uint32_t i = 0; i < sides; ++i) {
      triangles[2 * i] = {low + i, low + i + 1, high + i + 1};
      triangles[2 * i + 1] = {low + i, high + i + 1, high + i};
    }
    triangle_ += 2 * sides;
  }

  /// Joins a ring to one of half as many sides.
  void join_to_half(std::size_t low, std::size_t high, std::uint32_t high_sides) {
    for (std::uint32_t i = 0; i < high_sides; ++i) {
      add_triangle(low + 2 * i, low + 2 * i + 1, high + i);
      add_triangle(low + 2 * i + 1, high + i + 1, high + i);
      add_triangle(low + 2 * i + 1, low + 2 * i + 2, high + i + 1);
    }
  }

  /// The rings from the bearer's surface to the lateral's own.
  void write_collar(const Fork& fork) {
    const Knot& end = knots_[1];
    const std::uint32_t sides = tube_->sides;
    const std::uint32_t stretches = tube_->collar;
    const double radius = knots_[0].radius;
    const Vec3 along(frame_.along);
    Lateral lateral{
        .along = along, .length = end.length, .free = free_length(), .radius = radius, .bow = Vec3(0.0)};
    if (plan_.line == CentreLine::catmull_rom)
      lateral.bow = Vec3(spline_tangent(knots_, 1) - end.along * end.length);
    // A corner in the plane of the fork: the collar is the same on both sides.
    const Vec3 up = fork.along - along * glm::dot(fork.along, along);
    Vec3 side = normalized_or(up, Vec3(frame_.side), 1e-3);
    side = glm::normalize(side - along * glm::dot(side, along));
    frame_.set(frame_.along, Vec3f(side));

    const Vec3 across = glm::cross(along, side);
    const Vec2f* circle = unit_circle(sides);
    outwards_.clear();
    for (std::uint32_t i = 0; i < sides; ++i)
      outwards_.push_back(side * double{circle[i].x} + across * double{circle[i].y});
    collar_.lay(fork, lateral, outwards_, stretches);

    const double girth = 2.0 * std::numbers::pi * radius;
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const CollarLine& line = collar_.lines[i % sides];
      const SurfacePoint* points = &collar_.points[i % sides * (stretches + 1)];
      const double top = glm::dot(line.top - fork.center, along);
      const double length = glm::length(line.crotch - line.foot) + glm::length(line.top - line.crotch);
      for (std::uint32_t ring = 0; ring <= stretches; ++ring) {
        const double t = static_cast<double>(ring) / stretches;
        set_vertex(vertex_ + ring * (sides + 1) + i, Vec3f(points[ring].position), Vec3f(points[ring].normal),
                   static_cast<float>(i) / static_cast<float>(sides),
                   static_cast<float>((top - (1.0 - t) * length) / girth), end.node);
      }
    }
    for (std::uint32_t ring = 0; ring < stretches; ++ring) {
      join<0>(vertex_ + ring * (sides + 1), vertex_ + (ring + 1) * (sides + 1), sides);
    }
    vertex_ += (tube_->collar + 1) * (sides + 1);
  }

  /// As far the first stretch goes before the next ring begins, which may lean.
  double free_length() const {
    const LinePoint& next = points_[1];
    const float lean = glm::length(glm::cross(frame_.along, next.along));
    return double{glm::dot(next.position - points_[0].position, frame_.along) - next.radius * lean};
  }

  template <std::uint32_t Sides>
  void write_rings() {
    const std::size_t count = points_.size() - (tube_->is_pointed ? 1 : 0);
    float length = 0.0f;  // from the point before
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const LinePoint& point = points_[i];
      const LinePoint& low = points_[i == 0 ? 0 : i - 1];
      const LinePoint& high = points_[std::min(i + 1, points_.size() - 1)];
      const float next_length = glm::distance(point.position, high.position);
      if (i > 0) {
        v_ += length / (std::numbers::pi_v<float> * (point.radius + low.radius));
        from_base_ += length;
        frame_.turn_to(point.along);
      }
      if (i < count && !(i == 0 && tube_->collar > 0)) {
        const float both = length + next_length;
        const float taper = both > plan_.axes->thinnest ? (low.radius - high.radius) / both : 0.0f;
        // The first ring shows the same internode as the one above it.
        write_and_join<Sides>(i, taper, i == 0 ? knots_[1].node : point.node);
      }
      length = next_length;
    }
  }

  /// A ring of the line, and the band to the one below.
  template <std::uint32_t Sides>
  void write_and_join(std::size_t i, float taper, std::uint32_t node) {
    const std::size_t ring = vertex_;
    const std::uint32_t sides = side_count<Sides>();
    if (i < tube_->flare_rings) {
      write_flared_ring(points_[i], 2 * sides, node);
      if (i > 0) join<0>(ring - 2 * sides - 1, ring, 2 * sides);
      return;
    }
    write_ring<Sides>(points_[i], taper, node);
    if (i == 0) return;
    if (i == tube_->flare_rings) {
      join_to_half(ring - 2 * sides - 1, ring, sides);
    } else {
      join<Sides>(ring - sides - 1, ring, sides);
    }
  }

  /// A circle whose normals lean with the slope: lost radius a metre.
  template <std::uint32_t Sides>
  void write_ring(const LinePoint& point, float slope, std::uint32_t node) {
    const std::uint32_t sides = side_count<Sides>();
    const float shorten = 1.0f / std::sqrt(1.0f + slope * slope);
    const Vec3f center = point.position;
    const Vec3f side_offset = frame_.side * point.radius;
    const Vec3f across_offset = frame_.across * point.radius;
    const Vec3f lean = frame_.along * (slope * shorten);
    const Vec3f side_normal = frame_.side * shorten;
    const Vec3f across_normal = frame_.across * shorten;
    const Vec2f* circle = circle_;
    const float step = 1.0f / static_cast<float>(sides);
    const float v = v_;
    Vec3f* positions = mesh_.positions.data() + vertex_;
    Vec3f* normals = mesh_.normals.data() + vertex_;
    Vec2f* uvs = mesh_.uvs.data() + vertex_;
    std::uint32_t* internodes = mesh_.internodes.data() + vertex_;
    // The last vertex is the first once more. Made anew: reading the first would wait for it to be written.
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const Vec2f& on_circle = circle[i < sides ? i : 0];
      positions[i] = center + side_offset * on_circle.x + across_offset * on_circle.y;
      normals[i] = lean + side_normal * on_circle.x + across_normal * on_circle.y;
    }
    for (std::uint32_t i = 0; i <= sides; ++i) {
      uvs[i] = {static_cast<float>(i) * step, v};
      internodes[i] = node;
    }
    vertex_ += sides + 1;
  }

  void write_flared_ring(const LinePoint& point, std::uint32_t sides, std::uint32_t node) {
    for (std::uint32_t i = 0; i <= sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i % sides) / sides;
      const auto cosine = static_cast<float>(std::cos(angle));
      const auto sine = static_cast<float>(std::sin(angle));
      const Vec3f outwards = frame_.side * cosine + frame_.across * sine;
      const Vec3f around = frame_.across * cosine - frame_.side * sine;
      const RootFlare::Widening wide = flare_.at(from_base_ / flare_.height, angle);
      const Vec3f normal = outwards - around * static_cast<float>(wide.by_angle / wide.factor) -
                           frame_.along * static_cast<float>(wide.by_share * point.radius / flare_.height);
      set_vertex(vertex_++, point.position + outwards * (point.radius * static_cast<float>(wide.factor)),
                 normal, static_cast<float>(i) / static_cast<float>(sides), v_, node);
    }
  }

  /// Rounded, or a cone. Its point has a vertex for each side, so that shading runs round it.
  template <std::uint32_t Sides>
  void write_tip() {
    const LinePoint& last = points_.back();
    const std::uint32_t sides = side_count<Sides>();
    const float length = tube_->is_pointed ? 0.0f : kTipLength * last.radius;
    if (tube_->has_round_tip()) {
      const float v = v_;
      LinePoint ring = last;
      ring.position += frame_.along * (kTipRing * last.radius);
      ring.radius *= kTipRingRadius;
      v_ += kTipRing / (2.0f * std::numbers::pi_v<float>);
      write_ring<Sides>(ring, 1.0f, last.node);
      join<Sides>(vertex_ - 2 * (sides + 1), vertex_ - (sides + 1), sides);
      v_ = v;
    }
    const auto ring = static_cast<std::uint32_t>(vertex_ - (sides + 1));
    const Vec3f apex = last.position + frame_.along * length;
    const float v = v_ + length / (2.0f * std::numbers::pi_v<float> * last.radius);
    // Between the sides, and half forwards unless the tip is as slim as its branch.
    const float share = tube_->is_pointed ? 1.0f : std::numbers::sqrt2_v<float> / 2.0f;
    const Vec3f forwards = frame_.along * (tube_->is_pointed ? 0.0f : share);
    const Vec3f side_normal = frame_.side * share;
    const Vec3f across_normal = frame_.across * share;
    const Vec2f* middles = middles_;
    Vec3f* positions = mesh_.positions.data() + vertex_;
    Vec3f* normals = mesh_.normals.data() + vertex_;
    Vec2f* uvs = mesh_.uvs.data() + vertex_;
    std::uint32_t* internodes = mesh_.internodes.data() + vertex_;
    std::array<std::uint32_t, 3>* triangles = mesh_.triangles.data() + triangle_;
    for (std::uint32_t i = 0; i < sides; ++i) {
      triangles[i] = {ring + i, ring + i + 1, ring + sides + 1 + i};
      positions[i] = apex;
      normals[i] = forwards + side_normal * middles[2 * i].x + across_normal * middles[2 * i].y;
      uvs[i] = {(static_cast<float>(i) + 0.5f) / static_cast<float>(sides), v};
      internodes[i] = last.node;
    }
    vertex_ += sides;
    triangle_ += sides;
  }

  /// Closes a trunk's base with a fan that faces down.
  void write_flat_end() {
    const std::uint32_t sides = tube_->sides * (tube_->flare_rings > 0 ? 2 : 1);
    const std::size_t ring = tube_->first_vertex;
    const std::size_t center = vertex_;
    const Vec3f down = -points_[0].along;
    const std::uint32_t node = knots_[1].node;
    set_vertex(vertex_++, knots_[0].position, down, 0.5f, 0.0f, node);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const Vec2f uv = mesh_.uvs[ring + i];
      set_vertex(vertex_++, mesh_.positions[ring + i], down, uv.x, uv.y, node);
      add_triangle(center, center + 1 + (i + 1) % sides, center + 1 + i);
    }
  }

  /// What grows on the ground is flat below: a tube that lies there, and what of a lateral at the root is in
  /// the trunk's foot. One that grows down there itself stays as it is.
  void lay_on_ground(std::size_t index) {
    const Axes& axes = *plan_.axes;
    std::size_t trunk = index;
    while (!axes.list[trunk].is_trunk()) trunk = axes.list[trunk].bearer;
    const float ground = axes.points[axes.list[trunk].first].position.y;
    for (const Knot& knot : knots_) {
      if (knot.position.y < ground) return;
    }
    for (std::size_t v = tube_->first_vertex; v < vertex_; ++v)
      mesh_.positions[v].y = std::max(mesh_.positions[v].y, ground);
  }

  const TubePlan& plan_;
  Mesh& mesh_;
  std::vector<std::size_t> standing_out_;
  const Tube* tube_ = nullptr;
  std::vector<Knot> knots_;  // scratch, like the four below
  std::vector<LinePoint> points_;
  std::vector<Vec3> outwards_;
  Collar collar_;
  RootFlare flare_;
  const Vec2f* circle_ = nullptr;
  const Vec2f* middles_ = nullptr;
  std::size_t vertex_ = 0;  // the next one
  std::size_t triangle_ = 0;
  Frame frame_;  // of the last ring
  float v_ = 0.0f;
  float from_base_ = 0.0f;
};

Axes axes_without_sharp_turns(const Skeleton& skeleton) {
  Axes axes = find_axes(skeleton);
  part_sharp_turns(axes);
  return axes;
}

/// Mends the collars that stand out of their bearers; of these tubes they may.
void mend_collars(const TubePlan& plan, std::vector<std::size_t> tubes, Mesh& mesh) {
  std::sort(tubes.begin(), tubes.end());
  const auto follows_another = [&](std::size_t tube) {
    return std::binary_search(tubes.begin(), tubes.end(), plan.axes->list[tube].bearer);
  };
  parallel_for(tubes.size(), kGrainOfCollars, [&](std::size_t begin, std::size_t end) {
    TubeWriter writer(plan, mesh);
    for (std::size_t i = begin; i < end; ++i) {
      if (!follows_another(tubes[i])) writer.mend(tubes[i]);
    }
  });
  // A bearer's own collar comes before those of its laterals.
  TubeWriter writer(plan, mesh);
  for (const std::size_t tube : tubes) {
    if (follows_another(tube)) writer.mend(tube);
  }
}

}  // namespace

Mesh sweep(const TubePlan& plan, Mesh memory) {
  Mesh mesh = wood_of_size(plan.vertex_count, plan.triangle_count, std::move(memory));
  std::vector<std::size_t> standing_out;
  std::mutex is_appending;
  parallel_for(plan.tubes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    TubeWriter writer(plan, mesh);
    PlainTubeWriter plain(plan, mesh);
    for (std::size_t i = begin; i < end; ++i) {
      if (plan.tubes[i].is_plain) {
        plain.add(static_cast<std::uint32_t>(i));
      } else if (plan.tubes[i].rings > 0) {
        writer.write(i);
      }
    }
    if (writer.standing_out().empty()) return;
    const std::lock_guard lock(is_appending);
    standing_out.insert(standing_out.end(), writer.standing_out().begin(), writer.standing_out().end());
  });
  mend_collars(plan, std::move(standing_out), mesh);
  return mesh;
}

Mesh smooth_mesh(const Skeleton& skeleton, const MesherOptions& options, Mesh memory) {
  if (skeleton.internode_count() == 0) return {};
  const Axes axes = axes_without_sharp_turns(skeleton);
  const TubePlan plan = plan_tubes(skeleton, axes, options);
  const std::size_t budget = triangle_budget(plan.triangle_count, options);
  if (plan.triangle_count <= budget) return sweep(plan, std::move(memory));
  const auto count = [&](double tolerance) {
    return plan_tubes(skeleton, axes, options, tolerance).triangle_count;
  };
  const double tolerance = least_tolerance(skeleton, budget, count);
  return sweep(plan_tubes(skeleton, axes, options, tolerance), std::move(memory));
}

Mesh smooth_mesh(const Skeleton& skeleton, const MesherOptions& options, double tolerance) {
  const Axes axes = axes_without_sharp_turns(skeleton);
  return sweep(plan_tubes(skeleton, axes, options, tolerance), {});
}

}  // namespace ramify
