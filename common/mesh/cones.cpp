#include "common/mesh/cones.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "common/base/parallel.h"
#include "common/mesh/bark_stretches.h"
#include "common/mesh/cones_plan.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

// Of the way between two vertices: one moves no farther towards the other, where the line through both comes
// out of the ground; triangles between them would be too narrow.
constexpr double kFarthestOut = 0.9;

/// Writes the parts of one node into their place in the mesh.
class PartBuilder {
 public:
  PartBuilder(const Skeleton& skeleton, std::size_t node, const ConesPlan& plan,
              const BarkStretches* stretches, Mesh& mesh)
      : skeleton_(skeleton),
        node_(static_cast<std::uint32_t>(node)),
        part_(plan.parts[node]),
        stretches_(part_.winds ? stretches : nullptr),
        mesh_(mesh) {
    // What itself grows down there is not cut off.
    const double ground = skeleton.position[part_.root].y;
    const std::size_t below = skeleton.is_root(node) ? node : skeleton.parent[node];
    const double lowest = std::min(skeleton.position[below].y, skeleton.position[node].y);
    if (plan.has_roots[part_.root] || lowest < ground) return;
    ground_ = ground;
    moves_out_ = lowest - std::max(part_.base_radius, part_.radius) < ground;
  }

  void build() {
    add_parts();
    if (has_moved_out_ && is_turned_over()) {  // lying cones of few sides
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

  void add_vertex(Vec3 position, const Vec3& normal, double u, double v) {
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

  /// Evenly between the ends of each side, but for sides that come out of the ground.
  void add_ring(std::uint32_t band) {
    const Vec3& base = skeleton_.position[skeleton_.parent[node_]];
    const double lean = glm::mix(part_.base_lean, part_.end_lean, static_cast<double>(band) / part_.bands);
    const double lean_cosine = std::cos(lean);
    const double lean_sine = std::sin(lean);
    for (std::uint32_t i = 0; i <= sides_; ++i) {
      const Vec3 side = outwards(i % sides_);
      const Ends at = ends(side);
      const auto [low, high] = corners(side, at);
      const auto height = [&](double share) { return base.y + glm::mix(low, high, share).y; };
      const Vec3 place = glm::mix(low, high, out_of_ground(0.0, 1.0, part_.bands, band, height));
      const double x = glm::dot(place, axis_);
      const Vec3 normal = side * lean_cosine + axis_ * lean_sine;
      add_vertex(base + place, normal_on_cone(normal, side, x, at), static_cast<double>(i) / sides_,
                 v_on_cone(x, at));
    }
  }

  /// Where one side of the cone meets the cones before and after it, metres from its base: where the axis
  /// bends, in the plane of the bend.
  struct Ends {
    double from;
    double to;
  };

  Ends ends(const Vec3& side) const {
    const auto shift = [&](const Vec3& bend) { return glm::dot(side, bend) / glm::dot(part_.along, bend); };
    return {part_.base_meeting - part_.base_radius * shift(part_.base_bend),
            skeleton_.length(node_) + part_.end_meeting - part_.radius * shift(part_.bend)};
  }

  /// The first and the last point of a side of the cone, seen from the node below: where it touches spheres
  /// about points of its axis, or is cut.
  std::pair<Vec3, Vec3> corners(const Vec3& side, const Ends& at) const {
    const Vec3 from_center = side * std::sqrt(1.0 - part_.sine * part_.sine) + axis_ * part_.sine;
    const auto touching = [&](double along) {
      return along * axis_ + (part_.base_radius - part_.sine * along) * from_center;
    };
    return {part_.base_is_cut ? at.from * axis_ + part_.base_radius * side : touching(-part_.base_gap),
            part_.end_is_cut ? at.to * axis_ + part_.radius * side
                             : touching(skeleton_.length(node_) + part_.end_gap)};
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
    if (!moves_out_) return here;
    const double below = ground_ - height(here);
    if (below <= 0.0) return here;
    for (const std::uint32_t next : {std::min(index + 1, steps), std::max(index, 1u) - 1}) {
      const double share = below / (height(at(next)) - height(here));
      if (share <= 0.0 || share > kFarthestOut) continue;
      has_moved_out_ = true;
      return glm::mix(here, at(next), share);
    }
    return here;
  }

  /// On a side of the cone, `x` metres from its base. Where cones meet both have the same bark.
  double v_on_cone(double x, const Ends& at) const {
    const double length = skeleton_.length(node_);
    const double girth = std::numbers::pi * (part_.base_radius + part_.radius);
    const double seen = std::max(at.to - at.from, kLeastBark * length);
    return part_.v + ((x - at.from) / seen - 1.0) * length / girth;
  }

  /// The cone's normal there. Where cones meet in the edge of a bend, on its inner side or all around, it
  /// leans into the plane of that little by little, so that both have the same: no edge shows in the shading.
  Vec3 normal_on_cone(const Vec3& normal, const Vec3& side, double x, const Ends& at) const {
    const double half = std::max(0.5 * (at.to - at.from), 0.0);
    const double last_ring = skeleton_.length(node_) / part_.bands;  // before the edge
    const auto leant = [&](const Vec3& bend, double radius, double before_edge) {
      const double reach = std::max(std::min(radius, half), 1e-9);
      const double share = 1.0 - glm::smoothstep(std::min(last_ring, 0.5 * reach), reach, before_edge);
      return bend * (share * glm::dot(normal, bend));
    };
    Vec3 turned = normal;
    if (part_.base_is_cut || glm::dot(side, part_.base_bend) < 0.0)
      turned -= leant(part_.base_bend, part_.base_radius, x - at.from);
    if (part_.end_is_cut || glm::dot(side, part_.bend) > 0.0)
      turned -= leant(part_.bend, part_.radius, at.to - x);
    return turned;
  }

  /// Its poles lie along the internode, so that its corners meet those of the cone; at a bend within both
  /// cones.
  void add_sphere() {
    sides_ = part_.sphere_sides;
    axis_ = part_.bend;
    side_ = transported(part_.side, part_.along, part_.bend);
    const std::uint32_t bands = part_.latitudes() + 1;
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
    const double south = -0.5 * std::numbers::pi;
    const double even = glm::mix(south, -south, static_cast<double>(band) / bands);
    const double cosine = std::cos(even);
    const double sine = std::sin(even);
    for (std::uint32_t i = 0; i <= sides_; ++i) {
      const Vec3 side = outwards(i % sides_);
      Vec3 normal = side * cosine + axis_ * sine;
      if (moves_out_) {
        const auto at = [&](double latitude) {
          return side * std::cos(latitude) + axis_ * std::sin(latitude);
        };
        const auto height = [&](double latitude) { return center.y + part_.sphere_radius * at(latitude).y; };
        normal = at(out_of_ground(south, -south, bands, band, height));
      }
      const glm::dvec2 uv = on_sphere(static_cast<double>(i) / sides_, normal);
      add_vertex(center + part_.sphere_radius * normal, normal, uv.x, uv.y);
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
                       std::asin(std::clamp(part_.end_meeting / part_.radius, -1.0, 1.0));
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
    const std::size_t poles = lowest + part_.latitudes() * (sides + 1);
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
    add_vertex(skeleton_.position[node_] + part_.sphere_radius * normal, normal, u, on_sphere(u, normal).y);
  }

  const Skeleton& skeleton_;
  std::uint32_t node_;
  const NodePart& part_;
  const BarkStretches* stretches_;                            // of axes that wind; else none
  std::uint32_t sides_ = 0;                                   // of what is being added, like the two below
  Vec3 axis_{0.0};                                            // unit: it stands around this
  Vec3 side_{0.0};                                            // unit, of its first corner
  double ground_ = -std::numeric_limits<double>::infinity();  // nothing goes lower
  bool moves_out_ = false;  // vertices to where the surface comes out of the ground
  bool has_moved_out_ = false;
  Mesh& mesh_;
  std::size_t vertex_ = 0;
  std::size_t triangle_ = 0;
};

}  // namespace

Mesh cones_mesh(const Skeleton& skeleton, const MesherOptions& options) {
  if (skeleton.internode_count() == 0) return {};
  const ConesPlan plan = plan_cones(skeleton, options);
  Mesh mesh = wood_of_size(plan.vertex_count, plan.triangle_count);
  std::optional<BarkStretches> stretches;
  if (plan.has_winding) stretches.emplace(skeleton);
  parallel_for(plan.parts.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t node = begin; node < end; ++node) {
      PartBuilder(skeleton, node, plan, stretches ? &*stretches : nullptr, mesh).build();
    }
  });
  return mesh;
}

}  // namespace ramify
