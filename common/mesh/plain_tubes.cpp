#include "common/mesh/plain_tubes.h"

#include <bit>
#include <cstddef>
#include <limits>
#include <numbers>

#include "common/base/lanes3.h"
#include "common/mesh/wood.h"

namespace ramify {
namespace {

constexpr std::uint32_t kSides = 3;
constexpr std::uint32_t kRing = kSides + 1;  // vertices: the first stands there once more, with another u

// A lane is a tube; all that follows is in the same terms as Frame in smooth.cpp.

/// The points of four axes at the same place of their rows.
struct Points {
  Lanes3 position;
  Lanes radius;
};

Points load(const std::array<const AxisPoint*, kLanes>& points, std::size_t i) {
  static_assert(offsetof(AxisPoint, radius) == sizeof(Vec3f));
  const auto of = [&](std::size_t lane) { return load_lanes(&points[lane][i].position.x); };
  const auto [x, y, z, radius] = transposed(of(0), of(1), of(2), of(3));
  return {{x, y, z}, radius};
}

/// Of four tubes: see Frame in smooth.cpp.
struct Frames {
  Lanes3 along;
  Lanes3 side;
  Lanes3 across;

  void begin(const Lanes3& new_along) {
    constexpr std::int32_t sign_bit = std::numeric_limits<std::int32_t>::min();
    const Lanes sign = std::bit_cast<Lanes>((std::bit_cast<LaneMask>(new_along.z) & sign_bit) |
                                            std::bit_cast<LaneMask>(all_lanes(1.0f)));
    const Lanes a = -1.0f / (sign + new_along.z);
    set(new_along, {new_along.x * new_along.y * a, sign + new_along.y * new_along.y * a, -new_along.y});
  }

  void turn_to(const Lanes3& next) {
    const Lanes cosine = dot(along, next);
    const Lanes3 turned = side - (along + next) * (dot(next, side) / (1.0f + cosine));
    const Lanes3 carried = select(cosine > kHalfTurn, turned, side);
    set(next, carried * (1.5f - 0.5f * dot(carried, carried)));
  }

 private:
  void set(const Lanes3& new_along, const Lanes3& new_side) {
    along = new_along;
    side = new_side;
    across = cross(along, side);
  }
};

/// Where the next vertices and triangles of four tubes go.
class Outputs {
 public:
  Outputs(const TubePlan& plan, const std::array<std::uint32_t, kLanes>& tubes, Mesh& mesh) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Tube& tube = plan.tubes[tubes[lane]];
      vertices_[lane] = static_cast<std::uint32_t>(tube.first_vertex);
      positions_[lane] = &mesh.positions[tube.first_vertex].x;
      normals_[lane] = &mesh.normals[tube.first_vertex].x;
      uvs_[lane] = &mesh.uvs[tube.first_vertex].x;
      internodes_[lane] = &mesh.internodes[tube.first_vertex];
      triangles_[lane] = mesh.triangles[tube.first_triangle].data();
    }
  }

  /// A ring's vertices but for the last, which repeats the first.
  void add_ring(const std::array<Lanes3, kSides>& positions, const std::array<Lanes3, kSides>& normals,
                Lanes v, const std::array<std::uint32_t, kLanes>& nodes) {
    add_repeated(positions, positions_);
    add_repeated(normals, normals_);
    constexpr float step = 1.0f / kSides;
    write<2>({transposed(all_lanes(0.0f), v, all_lanes(step), v),
              transposed(all_lanes(2.0f * step), v, all_lanes(3.0f * step), v)},
             {0, 4}, uvs_);
    for (float*& place : uvs_) place += 2 * kRing;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      for (std::size_t i = 0; i < kRing; ++i) internodes_[lane][i] = nodes[lane];
      internodes_[lane] += kRing;
      vertices_[lane] += kRing;
    }
  }

  /// The band between the last two rings.
  void join() {
    static constexpr auto kBand = [] {
      std::array<std::uint32_t, 6 * kSides> corners{};
      for (std::uint32_t i = 0; i < kSides; ++i) {
        const std::uint32_t two[] = {i, i + 1, kRing + i + 1, i, kRing + i + 1, kRing + i};
        for (std::uint32_t k = 0; k < 6; ++k) corners[6 * i + k] = two[k];
      }
      return corners;
    }();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t low = vertices_[lane] - 2 * kRing;
      for (std::size_t i = 0; i < kBand.size(); ++i) triangles_[lane][i] = low + kBand[i];
      triangles_[lane] += kBand.size();
    }
  }

  /// A vertex for each side, all in one place.
  void add_tip(const Lanes3& apex, const std::array<Lanes3, kSides>& normals, Lanes v,
               const std::array<std::uint32_t, kLanes>& nodes) {
    // The last of the nine or six numbers are written with some of those before them.
    const auto& [a, b, c] = normals;
    write<3>({transposed(apex.x, apex.y, apex.z, apex.x), transposed(apex.y, apex.z, apex.x, apex.y),
              transposed(apex.z, apex.x, apex.y, apex.z)},
             {0, 4, 5}, positions_);
    write<3>({transposed(a.x, a.y, a.z, b.x), transposed(b.y, b.z, c.x, c.y), transposed(b.z, c.x, c.y, c.z)},
             {0, 4, 5}, normals_);
    const auto middle = [](float side) { return all_lanes((side + 0.5f) / kSides); };
    write<2>({transposed(middle(0.0f), v, middle(1.0f), v), transposed(middle(1.0f), v, middle(2.0f), v)},
             {0, 2}, uvs_);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t tip = vertices_[lane];
      const std::uint32_t ring = tip - kRing;
      for (std::uint32_t i = 0; i < kSides; ++i) {
        internodes_[lane][i] = nodes[lane];
        triangles_[lane][3 * i] = ring + i;
        triangles_[lane][3 * i + 1] = ring + i + 1;
        triangles_[lane][3 * i + 2] = tip + i;
      }
    }
  }

 private:
  static void add_repeated(const std::array<Lanes3, kSides>& ring, std::array<float*, kLanes>& places) {
    const auto& [a, b, c] = ring;
    write<3>({transposed(a.x, a.y, a.z, b.x), transposed(b.y, b.z, c.x, c.y), transposed(c.z, a.x, a.y, a.z)},
             {0, 4, 8}, places);
    for (float*& place : places) place += 3 * kRing;
  }

  /// rows[i][lane] goes to offsets[i] numbers beyond the lane's place.
  template <std::size_t Count>
  static void write(const std::array<std::array<Lanes, kLanes>, Count>& rows,
                    const std::array<std::size_t, Count>& offsets, const std::array<float*, kLanes>& places) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      for (std::size_t i = 0; i < Count; ++i) store(rows[i][lane], places[lane] + offsets[i]);
    }
  }

  std::array<std::uint32_t, kLanes> vertices_;
  std::array<float*, kLanes> positions_;
  std::array<float*, kLanes> normals_;
  std::array<float*, kLanes> uvs_;
  std::array<std::uint32_t*, kLanes> internodes_;
  std::array<std::uint32_t*, kLanes> triangles_;
};

/// Asks for memory that is written soon. Always inline: GCC leaves out calls of functions that only prefetch.
template <class T>
[[gnu::always_inline]] inline void prefetch(const T* first, std::size_t count) {
  constexpr std::size_t line = 64;
  const char* bytes = reinterpret_cast<const char*>(first);
  for (std::size_t i = 0; i < count * sizeof(T); i += line) __builtin_prefetch(bytes + i, 1);
}

/// From one point to the next.
struct Stretch {
  Lanes3 along;
  Lanes length;
};

Stretch stretch(const Points& from, const Points& to, const Stretch& before) {
  const Lanes3 step = to.position - from.position;
  const Lanes distance = length(step);
  return {select(distance > kLeastLength, step / distance, before.along), distance};
}

/// The direction of a ring between two stretches.
Lanes3 between(const Lanes3& before, const Lanes3& after) {
  const Lanes3 sum = before + after;
  const Lanes sum_length = length(sum);
  return select(sum_length < 1e-6f, before, sum / sum_length);
}

std::array<Lanes3, kSides> around(const Lanes3& center, const Lanes3& side, const Lanes3& across,
                                  const Vec2f* circle, std::size_t stride) {
  std::array<Lanes3, kSides> ring;
  for (std::size_t i = 0; i < kSides; ++i) {
    const Vec2f& on_circle = circle[i * stride];
    ring[i] = center + side * all_lanes(on_circle.x) + across * all_lanes(on_circle.y);
  }
  return ring;
}

}  // namespace

void PlainTubeWriter::add(std::uint32_t index) {
  // The processor reads what it writes a part of; it has time to, until there are four tubes.
  const Tube& tube = plan_.tubes[index];
  const std::size_t vertices = tube.rings * kRing + kSides;
  prefetch(&mesh_.positions[tube.first_vertex], vertices);
  prefetch(&mesh_.normals[tube.first_vertex], vertices);
  prefetch(&mesh_.uvs[tube.first_vertex], vertices);
  prefetch(&mesh_.internodes[tube.first_vertex], vertices);
  prefetch(&mesh_.triangles[tube.first_triangle], (2 * tube.rings - 1) * kSides);

  const std::uint32_t count = plan_.axes->list[index].count;
  if (groups_.size() <= count) groups_.resize(count + 1);
  Group& group = groups_[count];
  group.tubes[group.size++] = index;
  if (group.size == kLanes) write(group);
}

void PlainTubeWriter::write_rest() {
  for (Group& group : groups_) {
    if (group.size == 0) continue;
    // Lanes that are left over write the first tube once more.
    for (std::size_t lane = group.size; lane < kLanes; ++lane) group.tubes[lane] = group.tubes[0];
    write(group);
  }
}

void PlainTubeWriter::write(Group& group) {
  group.size = 0;
  std::array<const AxisPoint*, kLanes> points;
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    points[lane] = &plan_.axes->points[plan_.axes->list[group.tubes[lane]].first];
  const std::size_t count = plan_.axes->list[group.tubes[0]].count;
  const auto nodes_at = [&](std::size_t i) {
    return std::array{points[0][i].node, points[1][i].node, points[2][i].node, points[3][i].node};
  };
  const Vec2f* circle = unit_circle(kSides);
  Outputs out(plan_, group.tubes, mesh_);

  Points at = load(points, 0);
  Points next = load(points, 1);
  Frames frames;
  Stretch before{{all_lanes(0.0f), all_lanes(1.0f), all_lanes(0.0f)}, all_lanes(0.0f)};
  Stretch after = stretch(at, next, before);
  frames.begin(after.along);
  Lanes radius_before = at.radius;
  Lanes v = all_lanes(0.0f);
  for (std::size_t i = 0;; ++i) {
    // Worked out for the next ring while this one is written: roots and divisions take long.
    Points beyond = next;
    Stretch further{after.along, all_lanes(0.0f)};
    Lanes3 next_along = after.along;
    if (i + 2 < count) {
      beyond = load(points, i + 2);
      further = stretch(next, beyond, after);
      next_along = between(after.along, further.along);
    }
    const Lanes both = before.length + after.length;
    const Lanes slope = both > plan_.axes->thinnest ? (radius_before - next.radius) / both : all_lanes(0.0f);
    const Lanes shorten = 1.0f / root(1.0f + slope * slope);
    out.add_ring(
        around(at.position, frames.side * at.radius, frames.across * at.radius, circle, 1),
        around(frames.along * (slope * shorten), frames.side * shorten, frames.across * shorten, circle, 1),
        v, nodes_at(i == 0 ? 1 : i));
    if (i > 0) out.join();
    if (i + 1 == count) break;
    v += after.length / (std::numbers::pi_v<float> * (next.radius + at.radius));
    frames.turn_to(next_along);
    radius_before = at.radius;
    at = next;
    next = beyond;
    before = after;
    after = further;
  }
  const Lanes tip = kTipLength * at.radius;
  const Lanes share = all_lanes(std::numbers::sqrt2_v<float> / 2.0f);
  out.add_tip(at.position + frames.along * tip,
              around(frames.along * share, frames.side * share, frames.across * share,
                     unit_circle(2 * kSides) + 1, 2),
              v + tip / (2.0f * std::numbers::pi_v<float> * at.radius), nodes_at(count - 1));
}

}  // namespace ramify
