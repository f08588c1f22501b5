#include "common/mesh/cones.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "common/base/parallel.h"
#include "common/mesh/axes.h"
#include "common/mesh/bark_stretches.h"
#include "common/mesh/detail.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

// Cosine beyond which an axis bends at a node: the ends of both cones would stand out of a sphere of as few
// sides.
const double kStraight = std::cos(radians(8.0));

// Half the angle between the sides of two cones that follow one another: beyond, what is between is a
// shoulder.
const double kShoulder = radians(20.0);

// Cosine below which an axis turns back: its bark starts anew there.
constexpr double kTurnsBack = -0.5;

// Of the length of a cone: its bark is squeezed or stretched no more than that by the bends at its ends.
constexpr double kLeastBark = 0.3;

// Circles of latitude of the sphere at a tip, of which half is seen: with fewer it would look pointed.
constexpr std::uint32_t kTipLatitudes = 5;

// Of a twig of less than so many sides.
constexpr std::uint32_t kTwigSides = 5;
constexpr std::uint32_t kTwigTipLatitudes = 3;

// Of an axis that winds: bark that lies by the place is not straight along the sides of its cones and
// spheres, and where these meet with too few of them it would jump. Sides are so many times more.
constexpr std::uint32_t kWindingBands = 4;
constexpr std::uint32_t kWindingSides = 2;

// Of the way between two vertices: one moves no farther towards the other, where the line through both comes
// out of the ground; triangles between them would be too narrow.
constexpr double kFarthestOut = 0.9;

/// How the parts of one node lie: its sphere, and the cone from its parent.
struct NodePart {
  Vec3 along;      // unit, of the internode
  Vec3 side;       // unit, perpendicular to it: where u is 0
  Vec3 bend;       // unit, of the axis at the node: halfway from this internode's direction to the next one's
  Vec3 base_bend;  // the same where the cone begins; a lateral's begins straight
  double v = 0.0;
  double base_radius = 0.0;  // of the cone
  double sine = 0.0;         // of its taper: radius that it loses along its side
  // Cones that follow one another touch the sphere between them in two circles, and meet at a height between
  // these: above the node, along the axis, metres.
  double base_meeting = 0.0;
  double end_meeting = 0.0;
  // Along the axis, metres, that a cone is longer to meet there, where else the sphere would be seen.
  double base_gap = 0.0;
  double end_gap = 0.0;
  bool has_cone = false;
  bool has_sphere = false;
  bool is_tip = false;           // the axis ends here
  bool winds = false;            // so does the axis: its bends reach into each other, see is_squeezed()
  std::uint32_t bands = 1;       // of the cone, one above the other
  std::uint32_t root = 0;        // of the tree
  std::uint32_t axis_sides = 0;  // of the axis at its base, as thick axes have them
  std::uint32_t sides = 0;       // of the cone: as many, more where the axis winds, or less on coarse levels
  std::uint32_t sphere_sides = 0;  // as many, or twice where the axis bends
  std::size_t first_vertex = 0;
  std::size_t first_triangle = 0;
};

/// Circles of latitude of a sphere, its poles not counted: its facets are about square, and the middle one is
/// where the cone ends, so that no edge of that stands out.
std::uint32_t latitudes(const NodePart& part) {
  const std::uint32_t at_tip = part.sides < kTwigSides ? kTwigTipLatitudes : kTipLatitudes;
  return std::max(part.is_tip ? at_tip : 1u, part.sphere_sides / 2 - 1) | 1u;
}

// A ring repeats its first vertex at the end, where u jumps from 1 to 0; a pole has a vertex a side.
std::size_t vertex_count(const NodePart& part) {
  const std::size_t of_cone = part.has_cone ? (part.bands + 1) * (part.sides + 1) : 0;
  if (!part.has_sphere) return of_cone;
  return of_cone + latitudes(part) * (part.sphere_sides + 1) + 2 * part.sphere_sides;
}

std::size_t triangle_count(const NodePart& part) {
  // Both caps of a sphere together have as many as one band.
  return (part.has_cone ? 2 * part.bands * part.sides : 0) +
         (part.has_sphere ? 2 * latitudes(part) * part.sphere_sides : 0);
}

double radius(const Skeleton& skeleton, std::size_t node, double thinnest) {
  return std::max(0.5 * skeleton.diameter[node], thinnest);
}

/// Whether the bends at both ends of a cone leave too little bark between them on some side. What is seen of
/// it is then cut off by more than the cones next to it.
bool is_squeezed(const NodePart& part, double length, double end_radius) {
  const auto reach = [&](double radius, const Vec3& bend) {
    return radius * glm::length(glm::cross(part.along, bend)) / glm::dot(part.along, bend);
  };
  const double bends = reach(part.base_radius, part.base_bend) + reach(end_radius, part.bend);
  return bends > (1.0 - kLeastBark) * length;
}

struct ConesPlan {
  std::vector<NodePart> parts;
  std::vector<bool> has_roots;             // of each tree; without, it stands flat on the ground
  bool has_winding = false;                // some axis
  std::optional<BarkStretches> stretches;  // if so, in the end
  double tolerance = 0.0;                  // metres
  std::size_t vertex_count = 0;
  std::size_t triangle_count = 0;
};

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

/// Lets two cones that follow one another meet about the node between them, which has this radius.
void join_cones(NodePart& below, NodePart& above, double radius) {
  const double low = std::asin(below.sine);
  const double high = std::asin(above.sine);
  const double half_apart = 0.5 * (high - low);
  below.end_meeting = above.base_meeting = radius * std::sin(0.5 * (low + high)) / std::cos(half_apart);
  // At a bend the sphere is seen in any case; as a shoulder it is rounder than an edge.
  const bool shows_sphere = half_apart > kShoulder || glm::dot(below.along, above.along) < kStraight;
  if (half_apart <= 0.0 || shows_sphere) return;
  below.end_gap = radius * std::tan(half_apart) / std::cos(low);
  above.base_gap = radius * std::tan(half_apart) / std::cos(high);
}

/// Bark lies on these by the place alone.
void find_winding_axes(const Skeleton& skeleton, const std::vector<bool>& going_on, double thinnest,
                       ConesPlan& plan) {
  std::vector<std::uint32_t> first(plan.parts.size());  // node of each one's axis
  std::vector<bool> winds(plan.parts.size(), false);    // of those nodes
  for (std::uint32_t node = 0; node < first.size(); ++node) {
    const NodePart& part = plan.parts[node];
    first[node] = going_on[node] ? first[skeleton.parent[node]] : node;
    if (part.has_cone && is_squeezed(part, skeleton.length(node), radius(skeleton, node, thinnest)))
      winds[first[node]] = plan.has_winding = true;
  }
  for (std::size_t node = 0; node < first.size(); ++node) {
    NodePart& part = plan.parts[node];
    part.winds = winds[first[node]];
    if (!part.winds || plan.tolerance > 0.0) continue;
    part.bands = kWindingBands;
    part.sides = part.sphere_sides = kWindingSides * part.axis_sides;
  }
}

/// Frames are carried along each axis, so that bark does not turn from one cone to the next. With a
/// tolerance, metres, axes that reach no farther are left out, like spheres of its size.
ConesPlan plan_cones(const Skeleton& skeleton, const std::vector<bool>& going_on,
                     const MesherOptions& options, double tolerance = 0.0) {
  const double thinnest = thinnest_radius(skeleton);
  const double greatest = *std::max_element(skeleton.diameter.begin(), skeleton.diameter.end());
  const std::vector<bool> is_kept = kept_axes(skeleton, tolerance);
  ConesPlan plan;
  plan.tolerance = tolerance;
  plan.parts.resize(skeleton.node_count());
  plan.has_roots.assign(skeleton.root_count(), false);
  std::vector<NodePart>& parts = plan.parts;
  for (std::size_t node = 0; node < parts.size(); ++node) {
    NodePart& part = parts[node];
    const double end_radius = radius(skeleton, node, thinnest);
    const bool goes_on = going_on[node];
    part.axis_sides = goes_on ? parts[skeleton.parent[node]].axis_sides
                              : side_count(skeleton.diameter[node], greatest, options);
    part.sides = sides_within(part.axis_sides, end_radius, tolerance);
    part.sphere_sides = part.sides;
    part.has_sphere = is_kept[node] && end_radius > tolerance;
    part.is_tip = tolerance <= 0.0;
    part.along = part.bend = kUp;
    part.root = static_cast<std::uint32_t>(node);
    if (skeleton.is_root(node)) {
      part.side = any_perpendicular(kUp);
      continue;
    }
    const std::uint32_t parent = skeleton.parent[node];
    const double length = skeleton.length(node);
    part.base_radius = goes_on ? radius(skeleton, parent, thinnest) : end_radius;
    part.along = normalized_or(skeleton.along(node), parts[parent].along, thinnest);
    part.bend = part.base_bend = part.along;
    part.side = transported(parts[parent].side, parts[parent].along, part.along);
    NodePart& below = parts[parent];
    part.root = below.root;
    if (skeleton.is_root(parent) && part.along.y < 0.0) plan.has_roots[parent] = true;
    if (goes_on) below.is_tip = false;
    const bool turns_back = glm::dot(below.along, part.along) <= kTurnsBack;
    if (goes_on && !turns_back) below.bend = part.base_bend = glm::normalize(below.along + part.along);
    if (goes_on && tolerance <= 0.0 && glm::dot(below.along, part.along) < kStraight)
      below.sphere_sides = 2 * below.sides;
    part.v = length / (std::numbers::pi * (part.base_radius + end_radius));
    if (goes_on) part.v += parts[parent].v;
    part.has_cone = is_kept[node] && length > std::abs(part.base_radius - end_radius) + thinnest;
    if (part.has_cone) part.sine = (part.base_radius - end_radius) / length;
    if (goes_on && !turns_back && below.has_cone && part.has_cone) join_cones(below, part, part.base_radius);
  }
  find_winding_axes(skeleton, going_on, thinnest, plan);
  for (NodePart& part : parts) {
    part.first_vertex = plan.vertex_count;
    part.first_triangle = plan.triangle_count;
    plan.vertex_count += vertex_count(part);
    plan.triangle_count += triangle_count(part);
  }
  return plan;
}

/// Writes the parts of one node into their place in the mesh.
class PartBuilder {
 public:
  PartBuilder(const Skeleton& skeleton, std::size_t node, const ConesPlan& plan, double end_radius,
              Mesh& mesh)
      : skeleton_(skeleton),
        node_(static_cast<std::uint32_t>(node)),
        part_(plan.parts[node]),
        end_radius_(end_radius),
        stretches_(part_.winds ? &*plan.stretches : nullptr),
        mesh_(mesh) {
    // What itself grows down there is not cut off.
    const double ground = skeleton.position[part_.root].y;
    const std::size_t below = skeleton.is_root(node) ? node : skeleton.parent[node];
    const bool is_above = std::min(skeleton.position[below].y, skeleton.position[node].y) >= ground;
    if (!plan.has_roots[part_.root] && is_above) ground_ = ground;
  }

  void build() {
    add_parts();
    if (has_moved_out_ && is_turned_over()) {
      moves_out_ = false;
      add_parts();
    }
    if (stretches_) lay_bark_by_place();
  }

 private:
  void add_parts() {
    vertex_ = part_.first_vertex;
    triangle_ = part_.first_triangle;
    if (part_.has_cone) add_cone();
    if (part_.has_sphere) add_sphere();
  }

  /// Whether some triangle faces inwards.
  bool is_turned_over() const {
    for (std::size_t i = part_.first_triangle; i < triangle_; ++i) {
      const auto& [a, b, c] = mesh_.triangles[i];
      const Vec3f across =
          glm::cross(mesh_.positions[b] - mesh_.positions[a], mesh_.positions[c] - mesh_.positions[a]);
      if (glm::dot(across, mesh_.normals[a] + mesh_.normals[b] + mesh_.normals[c]) <= 0.0f) return true;
    }
    return false;
  }

  Vec3 outwards(std::uint32_t side) const {
    const double angle = 2.0 * std::numbers::pi * side / sides_;
    return side_ * std::cos(angle) + glm::cross(axis_, side_) * std::sin(angle);
  }

  void add_vertex(const Vec3& center, double radius, const Vec3& normal, double u, double v) {
    Vec3 position = center + radius * normal;
    position.y = std::max(position.y, ground_);
    mesh_.positions[vertex_] = Vec3f(position);
    mesh_.normals[vertex_] = glm::normalize(Vec3f(normal));
    mesh_.uvs[vertex_] = {static_cast<float>(u), static_cast<float>(v)};
    mesh_.internodes[vertex_++] = node_;
  }

  void add_triangle(std::size_t a, std::size_t b, std::size_t c) {
    mesh_.triangles[triangle_++] = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                                    static_cast<std::uint32_t>(c)};
  }

  void join_circles(std::size_t low, std::size_t high) {
    for (std::uint32_t i = 0; i < sides_; ++i) {
      add_triangle(low + i, low + i + 1, high + i + 1);
      add_triangle(low + i, high + i + 1, high + i);
    }
  }

  /// Between the circles in which a cone touches both spheres, or on to where it meets other cones.
  void add_cone() {
    sides_ = part_.sides;
    axis_ = part_.along;
    side_ = part_.side;
    for (std::uint32_t band = 0; band <= part_.bands; ++band) {
      add_ring(band);
      if (band > 0) join_circles(vertex_ - 2 * (sides_ + 1), vertex_ - (sides_ + 1));
    }
  }

  /// Where the cone touches spheres about points of its axis: all one, but for sides that come out of the
  /// ground.
  void add_ring(std::uint32_t band) {
    const Vec3& base = skeleton_.position[skeleton_.parent[node_]];
    const double low = -part_.base_gap;
    const double high = skeleton_.length(node_) + part_.end_gap;
    const double cosine = std::sqrt(1.0 - part_.sine * part_.sine);
    const auto center = [&](double along) { return base + along * axis_; };
    const auto radius = [&](double along) { return part_.base_radius - part_.sine * along; };
    for (std::uint32_t i = 0; i <= sides_; ++i) {
      const Vec3 side = outwards(i % sides_);
      const Vec3 normal = side * cosine + axis_ * part_.sine;
      const auto height = [&](double at) { return center(at).y + radius(at) * normal.y; };
      const double along = out_of_ground(low, high, part_.bands, band, height);
      add_vertex(center(along), radius(along), normal, static_cast<double>(i) / sides_,
                 v_on_cone(side, along + part_.sine * radius(along)));
    }
  }

  /// Where the vertex `index` is of a line on the surface with one at each of `steps` from `low` to `high`:
  /// evenly, but for the one below the ground next to where the line comes out, which is there. Only lifted
  /// it would leave a notch. height(at): of a place on the line.
  template <class Height>
  double out_of_ground(double low, double high, std::uint32_t steps, std::uint32_t index, Height height) {
    const auto at = [&](std::uint32_t step) {
      return glm::mix(low, high, static_cast<double>(step) / steps);
    };
    const double here = at(index);
    const double below = ground_ - height(here);
    if (below <= 0.0 || !moves_out_) return here;
    for (const std::uint32_t next : {std::min(index + 1, steps), std::max(index, 1u) - 1}) {
      const double share = below / (height(at(next)) - height(here));
      if (share <= 0.0 || share > kFarthestOut) continue;
      has_moved_out_ = true;
      return glm::mix(here, at(next), share);
    }
    return here;
  }

  /// On one side of the cone, `x` metres from its base. Where the axis bends, cones meet in a plane: there
  /// both have the same bark.
  double v_on_cone(const Vec3& side, double x) const {
    const double length = skeleton_.length(node_);
    const double girth = std::numbers::pi * (part_.base_radius + end_radius_);
    const auto shift = [&](const Vec3& bend) { return glm::dot(side, bend) / glm::dot(part_.along, bend); };
    const double from = part_.base_meeting - part_.base_radius * shift(part_.base_bend);
    const double to = length + part_.end_meeting - end_radius_ * shift(part_.bend);
    const double seen = std::max(to - from, kLeastBark * length);
    return part_.v + ((x - from) / seen - 1.0) * length / girth;
  }

  /// Its poles lie along the internode, so that its corners meet those of the cone; at a bend within both
  /// cones.
  void add_sphere() {
    sides_ = part_.sphere_sides;
    axis_ = part_.bend;
    side_ = transported(part_.side, part_.along, part_.bend);
    const std::uint32_t bands = latitudes(part_) + 1;
    const std::size_t lowest = vertex_;
    for (std::uint32_t band = 1; band < bands; ++band) {
      add_circle(band, bands);
      if (band > 1) join_circles(vertex_ - 2 * (sides_ + 1), vertex_ - (sides_ + 1));
    }
    const std::size_t highest = vertex_ - (sides_ + 1);
    for (std::uint32_t i = 0; i < sides_; ++i) {
      add_triangle(vertex_, lowest + i + 1, lowest + i);
      add_pole(-1.0, i);
      add_triangle(highest + i, highest + i + 1, vertex_);
      add_pole(1.0, i);
    }
  }

  /// A circle of latitude of the sphere, but where that comes out of the ground.
  void add_circle(std::uint32_t band, std::uint32_t bands) {
    const Vec3& center = skeleton_.position[node_];
    for (std::uint32_t i = 0; i <= sides_; ++i) {
      const Vec3 side = outwards(i % sides_);
      const auto normal_at = [&](double latitude) {
        return side * std::cos(latitude) + axis_ * std::sin(latitude);
      };
      const auto height = [&](double at) { return center.y + end_radius_ * normal_at(at).y; };
      const Vec3 normal =
          normal_at(out_of_ground(-0.5 * std::numbers::pi, 0.5 * std::numbers::pi, bands, band, height));
      const glm::dvec2 uv = on_sphere(static_cast<double>(i) / sides_, normal);
      add_vertex(center, end_radius_, normal, uv.x, uv.y);
    }
  }

  /// An arc as long as the girth is one unit of v. Below the plane of the bend u is that of this cone, above
  /// it, which is its mirror image, that of the next; `u` is near to it, but about the poles, which are
  /// hidden.
  glm::dvec2 on_sphere(double u, const Vec3& normal) const {
    const double height = glm::dot(normal, part_.bend);
    const Vec3 below = height > 0.0 ? normal - 2.0 * height * part_.bend : normal;
    const double angle =
        std::atan2(glm::dot(below, glm::cross(part_.along, part_.side)), glm::dot(below, part_.side));
    const double own = angle / (2.0 * std::numbers::pi);
    const double arc = std::asin(std::clamp(height, -1.0, 1.0)) -
                       std::asin(std::clamp(part_.end_meeting / end_radius_, -1.0, 1.0));
    return {own + std::round(u - own), part_.v + arc / (2.0 * std::numbers::pi)};
  }

  /// Instead of what has been laid: all surfaces about one place show the same there.
  void lay_bark_by_place() {
    std::size_t ring = part_.first_vertex;
    if (part_.has_cone) {
      float first = 0.0f;
      for (std::uint32_t i = 0; i <= part_.bands; ++i, ring += part_.sides + 1) {
        lay_ring(ring, part_.sides, first);
        first = mesh_.uvs[ring].x;
      }
    }
    if (!part_.has_sphere) return;
    const std::uint32_t sides = part_.sphere_sides;
    const std::size_t lowest = ring;
    const std::size_t poles = lowest + latitudes(part_) * (sides + 1);
    for (float first = 0.0f; ring < poles; ring += sides + 1) {
      lay_ring(ring, sides, first);
      first = mesh_.uvs[ring].x;
    }
    const std::size_t highest = poles - (sides + 1);
    for (std::uint32_t i = 0; i < sides; ++i) {
      lay_pole(poles + 2 * i, lowest + i);
      lay_pole(poles + 2 * i + 1, highest + i);
    }
  }

  Vec2f uv_at(std::size_t vertex) const { return stretches_->uv(node_, Vec3(mesh_.positions[vertex])); }

  /// u goes on from vertex to vertex, and from that of the ring below.
  void lay_ring(std::size_t first, std::uint32_t sides, float u) {
    for (std::size_t vertex = first; vertex <= first + sides; ++vertex) {
      const Vec2f own = uv_at(vertex);
      u = own.x + std::round(u - own.x);
      mesh_.uvs[vertex] = {u, own.y};
    }
  }

  /// Between two vertices of the circle next to it.
  void lay_pole(std::size_t pole, std::size_t on_circle) {
    mesh_.uvs[pole] = {0.5f * (mesh_.uvs[on_circle].x + mesh_.uvs[on_circle + 1].x), uv_at(pole).y};
  }

  void add_pole(double sign, std::uint32_t side) {
    const Vec3 normal = axis_ * sign;
    const double u = (side + 0.5) / sides_;
    add_vertex(skeleton_.position[node_], end_radius_, normal, u, on_sphere(u, normal).y);
  }

  const Skeleton& skeleton_;
  std::uint32_t node_;
  const NodePart& part_;
  double end_radius_;
  const BarkStretches* stretches_;                            // of axes that wind; else none
  std::uint32_t sides_ = 0;                                   // of what is being added, like the two below
  Vec3 axis_{0.0};                                            // unit: it stands around this
  Vec3 side_{0.0};                                            // unit, of its first corner
  double ground_ = -std::numeric_limits<double>::infinity();  // nothing goes lower
  bool moves_out_ =
      true;  // vertices to where the surface comes out of the ground, unless that turns some over
  bool has_moved_out_ = false;
  Mesh& mesh_;
  std::size_t vertex_ = 0;
  std::size_t triangle_ = 0;
};

}  // namespace

Mesh cones_mesh(const Skeleton& skeleton, const MesherOptions& options) {
  if (skeleton.internode_count() == 0) return {};
  const std::vector<bool> going_on = find_going_on(skeleton);
  ConesPlan plan = plan_cones(skeleton, going_on, options);
  const std::size_t budget = triangle_budget(plan.triangle_count, options);
  if (plan.triangle_count > budget) {
    const auto count = [&](double tolerance) {
      return plan_cones(skeleton, going_on, options, tolerance).triangle_count;
    };
    plan = plan_cones(skeleton, going_on, options, least_tolerance(skeleton, budget, count));
  }
  Mesh mesh = wood_of_size(plan.vertex_count, plan.triangle_count);
  const double thinnest = thinnest_radius(skeleton);
  if (plan.has_winding) plan.stretches.emplace(skeleton);
  parallel_for(plan.parts.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      PartBuilder(skeleton, node, plan, radius(skeleton, node, thinnest), mesh).build();
    }
  });
  return mesh;
}

}  // namespace ramify
