#include "common/volume/part.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace ramify {
namespace {

// Of a segment's length: near misses of what is not met exactly count as hits. It bounds the steps along a
// surface.
constexpr double kNearMiss = 1e-4;

bool is_compound(Shape shape) {
  return shape == Shape::union_of || shape == Shape::difference || shape == Shape::intersection;
}

/// It looks the same after a turn if its centre and axis are turned.
bool is_round(Shape shape) {
  return shape != Shape::ellipsoid && shape != Shape::box && shape != Shape::mesh;
}

/// A ball, an ellipsoid or a box takes an uneven scale of its own into its sizes and stays one of them.
Volume with_own_scale(Volume volume) {
  const bool is_even = volume.scale == Vec3(volume.scale.x);
  const bool takes_it =
      volume.shape == Shape::sphere || volume.shape == Shape::ellipsoid || volume.shape == Shape::box;
  if (is_even || !takes_it) return volume;
  if (volume.shape == Shape::sphere) {
    volume.shape = Shape::ellipsoid;
    volume.radii = Vec3(volume.radius);
  }
  volume.center *= volume.scale;
  volume.radii *= volume.scale;
  volume.size *= volume.scale;
  volume.scale = Vec3(1.0);
  return volume;
}

/// The same shape in the world's frame, if it has one there.
std::optional<Volume> in_world(Volume volume, const Placement& placement) {
  if (placement.is_identity()) return volume;
  if (volume.shape == Shape::mesh || !placement.is_even()) return std::nullopt;
  if (!is_round(volume.shape) && !placement.is_upright()) return std::nullopt;
  const double scale = placement.least_scale();
  volume.center = placement.to_world(volume.center);
  volume.direction = placement.vector_to_world(volume.direction);
  volume.radius *= scale;
  volume.height *= scale;
  volume.radii *= scale;
  volume.size *= scale;
  if (volume.shape == Shape::revolution) {
    volume.points = sketch_of(volume);
    volume.file.clear();
    for (Vec2& point : volume.points) point *= scale;
  }
  return volume;
}

Box bounds_of(const Primitive& primitive, const std::optional<Placement>& placement) {
  Box box;
  const Vec3 offset = placement ? placement->to_world(Vec3(0.0)) : Vec3(0.0);
  for (int i = 0; i < 3; ++i) {
    Vec3 towards(0.0);
    towards[i] = 1.0;
    const Vec3 own = placement ? placement->covector_to_own(towards) : towards;
    box.high[i] = offset[i] + primitive.furthest(own);
    box.low[i] = offset[i] - primitive.furthest(-own);
  }
  return box;
}

Part primitive_part(const Volume& volume, const Placement& placement) {
  const std::optional<Volume> plain = in_world(volume, placement);
  Part part{
      .shape = volume.shape, .is_plain = plain.has_value(), .primitive = Primitive(plain.value_or(volume))};
  if (!plain) part.placement = placement;
  part.is_convex = part.primitive.is_convex();
  part.bounds = bounds_of(part.primitive, part.placement);
  if (volume.shape == Shape::mesh) {
    // At a wall of the mesh the interpolated distance is at most half a voxel's diagonal, however thin the
    // wall.
    part.tolerance = 0.5 * part.primitive.level_set->voxel_size() * placement.least_scale();
  }
  return part;
}

void add_parts(const Volume& volume, const Placement& around, std::vector<Part>& found);

Part compound_part(Shape shape, std::vector<Part> parts) {
  Part part{.shape = shape, .is_plain = false, .primitive = Primitive(Volume{}), .parts = std::move(parts)};
  for (std::size_t i = 0; i < part.parts.size(); ++i) {
    const Part& child = part.parts[i];
    part.tolerance = std::max(part.tolerance, child.tolerance);
    if (shape == Shape::union_of || i == 0) {
      part.bounds.include(child.bounds);
    } else if (shape == Shape::intersection) {
      part.bounds.low = glm::max(part.bounds.low, child.bounds.low);
      part.bounds.high = glm::min(part.bounds.high, child.bounds.high);
    }
  }
  if (part.bounds.is_empty()) part.bounds = Box{};
  part.is_convex =
      shape == Shape::intersection &&
      std::all_of(part.parts.begin(), part.parts.end(), [](const Part& child) { return child.is_convex; });
  return part;
}

/// One part for each volume, as the terms of a difference or intersection.
std::vector<Part> terms(const std::vector<Volume>& volumes, const Placement& around) {
  std::vector<Part> result;
  for (const Volume& volume : volumes) {
    std::vector<Part> parts;
    add_parts(volume, around, parts);
    result.push_back(parts.size() == 1 ? std::move(parts.front())
                                       : compound_part(Shape::union_of, std::move(parts)));
  }
  return result;
}

void add_parts(const Volume& volume, const Placement& around, std::vector<Part>& found) {
  if (!is_compound(volume.shape)) {
    const Volume scaled = with_own_scale(volume);
    found.push_back(primitive_part(scaled, Placement(around, scaled)));
    return;
  }
  const Placement placement(around, volume);
  if (volume.shape == Shape::union_of) {
    for (const Volume& part : volume.parts) add_parts(part, placement, found);
    return;
  }
  found.push_back(compound_part(volume.shape, terms(volume.parts, placement)));
}

}  // namespace

std::vector<Part> parts_of(const Volume& volume) {
  std::vector<Part> parts;
  add_parts(volume, Placement(), parts);
  return parts;
}

double Part::other_bound(const Vec3& point) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  switch (shape) {
    case Shape::union_of: {
      double bound = kFar;
      for (const Part& part : parts) bound = std::min(bound, part.distance_bound(point));
      return bound;
    }
    case Shape::difference:
    case Shape::intersection: {
      if (parts.empty()) return kFar;
      double bound = parts.front().distance_bound(point);
      for (std::size_t i = 1; i < parts.size(); ++i) {
        const double other = parts[i].distance_bound(point);
        bound = std::max(bound, shape == Shape::difference ? -other : other);
      }
      return bound;
    }
    default:
      return placement->least_scale() * primitive.distance_bound(placement->to_own(point));
  }
}

bool Part::meets(const Vec3& from, const Vec3& to) const {
  if (is_compound(shape) || !primitive.has_exact_meets()) {
    // One way along, so that near misses are the same from either end.
    const bool is_forward = std::tie(from.x, from.y, from.z) < std::tie(to.x, to.y, to.z);
    // What is met within the tolerance may lie that much beside the bounds.
    const Box box{bounds.low - tolerance, bounds.high + tolerance};
    return box_is_met(box, from, to) && (is_forward ? marches_into(from, to) : marches_into(to, from));
  }
  if (is_plain) return primitive.meets(from, to);
  return primitive.meets(placement->to_own(from), placement->to_own(to));
}

bool Part::marches_into(const Vec3& from, const Vec3& to) const {
  const Vec3 way = to - from;
  const double length = glm::length(way);
  const double near = std::max({kSurfaceSlack, kNearMiss * length, 1.25 * tolerance});
  for (double gone = 0.0; gone <= length;) {
    const double bound = distance_bound(length == 0.0 ? from : from + gone / length * way);
    if (bound <= near) return true;
    // All the way to there the bound is more than the tolerance.
    gone += bound - tolerance;
  }
  return false;
}

FacePoint Part::nearest_seen_from_outside(const Vec3& point) const {
  const double distance = std::max(0.0, distance_bound(point));
  const double step = std::max({1e-6, 1e-3 * distance, tolerance});
  Vec3 slope(0.0);
  for (int i = 0; i < 3; ++i) {
    Vec3 offset(0.0);
    offset[i] = step;
    slope[i] = distance_bound(point + offset) - distance_bound(point - offset);
  }
  const Vec3 towards = -normalized_or(slope, kUp, 1e-15);
  return {point + distance * towards, towards};
}

void Part::add_nearest_faces(const Vec3& point, std::vector<FacePoint>& faces) const {
  switch (shape) {
    case Shape::union_of:
      add_free_faces(parts, point, faces);
      return;
    case Shape::difference:
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i == 0) parts[i].add_nearest_faces(point, faces);
        if (i > 0) faces.push_back(parts[i].nearest_seen_from_outside(point));
      }
      return;
    case Shape::intersection:
      for (const Part& part : parts) part.add_nearest_faces(point, faces);
      return;
    default:
      break;
  }
  if (is_plain) {
    primitive.add_nearest_faces(point, faces);
    return;
  }
  const std::size_t first = faces.size();
  primitive.add_nearest_faces(placement->to_own(point), faces);
  for (std::size_t i = first; i < faces.size(); ++i) {
    // Uneven scales move the nearest point of a face; the way to the tangent plane is nearer the truth than
    // the way to the point, and the same if they are even.
    const Vec3 normal = placement->normal_to_world(faces[i].normal);
    const double depth = glm::dot(placement->to_world(faces[i].point) - point, normal);
    faces[i] = {point + depth * normal, normal};
  }
}

void add_free_faces(const std::vector<Part>& parts, const Vec3& point, std::vector<FacePoint>& faces) {
  for (const Part& part : parts) {
    if (!part.contains(point)) continue;
    const std::size_t first = faces.size();
    part.add_nearest_faces(point, faces);
    const auto covered = [&](const FacePoint& face) {
      return is_covered(parts, part, face.point + kFaceStep * face.normal);
    };
    faces.erase(std::remove_if(faces.begin() + static_cast<std::ptrdiff_t>(first), faces.end(), covered),
                faces.end());
  }
}

bool is_covered(const std::vector<Part>& parts, const Part& own, const Vec3& point) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Part& part) { return &part != &own && part.contains(point); });
}

}  // namespace ramify
