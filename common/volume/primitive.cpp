#include "common/volume/primitive.h"

#include <algorithm>
#include <limits>

namespace ramify {
namespace {

/// The part of a segment, in shares of its length, that is left of it after clipping.
struct Stretch {
  double begin = 0.0;
  double end = 1.0;

  bool is_empty() const { return !(begin <= end); }
  void clip(double low, double high) {
    begin = std::max(begin, low);
    end = std::min(end, high);
  }
};

constexpr Stretch kNothing{1.0, 0.0};

/// Where low <= value + t * slope <= high.
void clip_to_slab(Stretch& stretch, double value, double slope, double low, double high) {
  if (slope == 0.0) {
    if (value < low || value > high) stretch = kNothing;
    return;
  }
  const double a = (low - value) / slope;
  const double b = (high - value) / slope;
  stretch.clip(std::min(a, b), std::max(a, b));
}

/// Where from + t * step is no farther than `radius` from the origin.
void clip_to_ball(Stretch& stretch, const Vec3& from, const Vec3& step, double radius) {
  const double square = glm::dot(step, step);
  if (square == 0.0) {
    if (glm::length(from) > radius) stretch = kNothing;
    return;
  }
  const double nearest = -glm::dot(from, step) / square;
  const Vec3 foot = from + nearest * step;
  const double rest = radius * radius - glm::dot(foot, foot);
  if (rest < 0.0) {
    stretch = kNothing;
    return;
  }
  const double half = std::sqrt(rest / square);
  stretch.clip(nearest - half, nearest + half);
}

/// constant + t * slope + weight * |from + t * step|, which is what a cylinder's, cone's or portion's side
/// says along a segment.
struct SideAlong {
  double constant;
  double slope;
  double weight;
  Vec3 from;
  Vec3 step;

  double at(double t) const { return constant + t * slope + weight * glm::length(from + t * step); }

  /// Over a stretch that is not empty.
  double least(const Stretch& stretch) const {
    const double ends = std::min(at(stretch.begin), at(stretch.end));
    // The derivative vanishes where s / sqrt(s^2 + offset^2) = k, s being counted from the foot.
    const double speed = glm::length(step);
    const double k = -slope / (weight * speed);
    if (speed == 0.0 || !(std::abs(k) < 1.0)) return ends;
    const double foot = -glm::dot(from, step) / (speed * speed);
    const double offset = glm::length(from + foot * step) / speed;
    const double t = foot + k * offset / std::sqrt(1.0 - k * k);
    return std::min(ends, at(std::clamp(t, stretch.begin, stretch.end)));
  }
};

/// The share of the segment at which it is nearest to the origin.
double nearest_share(const Vec3& from, const Vec3& step) {
  const double square = glm::dot(step, step);
  return square == 0.0 ? 0.0 : std::clamp(-glm::dot(from, step) / square, 0.0, 1.0);
}

/// The point of an ellipsoid's surface that is nearest to `inside`, both relative to its centre.
/// D. Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid, 2013.
Vec3 nearest_on_ellipsoid(const Vec3& inside, const Vec3& radii) {
  // The foot is r_i^2 p_i / (t + r_i^2); the t in (-shortest^2, 0] that puts it on the surface is bisected.
  const int shortest = radii.x <= radii.y && radii.x <= radii.z ? 0 : (radii.y <= radii.z ? 1 : 2);
  const Vec3 squares = radii * radii;
  const Vec3 scaled = radii * inside;
  double low = -squares[shortest] * (1.0 - 1e-12);
  double high = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const Vec3 ratio = scaled / (squares + middle);
    (glm::dot(ratio, ratio) > 1.0 ? low : high) = middle;
  }
  Vec3 foot = squares * inside / (squares + high);
  // On the plane across the shortest axis that axis's share is lost: it is what the others leave.
  Vec3 ratio = foot / radii;
  ratio[shortest] = 0.0;
  const double rest = std::sqrt(std::max(0.0, 1.0 - glm::dot(ratio, ratio)));
  foot[shortest] = std::copysign(rest * radii[shortest], inside[shortest]);
  return foot;
}

/// Distance to the surface of a box about the origin, negative inside; too small beside its edges.
double box_bound(const Vec3& from, const Vec3& half) {
  const Vec3 outside = glm::abs(from) - half;
  return std::max({outside.x, outside.y, outside.z});
}

double mesh_bound(const LevelSet& level_set, const Vec3& point) {
  const Box& box = level_set.bounds();
  return std::max(box_bound(point - box.center(), 0.5 * box.size()) - level_set.voxel_size(),
                  level_set.signed_distance(point) / LevelSet::kSteepness);
}

/// The way to the surface of a mesh, straight out.
FacePoint nearest_on_mesh(const LevelSet& level_set, const Vec3& point) {
  const double depth = level_set.depth(point);
  const double step = std::max(0.5 * level_set.voxel_size(), 0.1 * depth);
  Vec3 slope(0.0);
  for (int i = 0; i < 3; ++i) {
    Vec3 offset(0.0);
    offset[i] = step;
    slope[i] = level_set.depth(point - offset) - level_set.depth(point + offset);
  }
  const Vec3 normal = normalized_or(slope, kUp, 1e-12);
  return {point + depth * normal, normal};
}

}  // namespace

bool box_is_met(const Box& box, const Vec3& from, const Vec3& to) {
  Stretch stretch;
  for (int i = 0; i < 3; ++i) {
    clip_to_slab(stretch, from[i], to[i] - from[i], box.low[i] - kSurfaceSlack, box.high[i] + kSurfaceSlack);
  }
  return !stretch.is_empty();
}

Sketch sketch_of(const Volume& volume) {
  return volume.file.empty() ? volume.points : read_sketch(volume.file);
}

Primitive::Primitive(const Volume& volume)
    : shape(volume.shape),
      center(volume.center),
      axis(normalized_or(volume.direction, kUp)),
      radius(volume.radius),
      height(volume.height),
      radii(volume.shape == Shape::box ? 0.5 * volume.size : volume.radii),
      angle(volume.shape == Shape::hemisphere ? radians(90.0) : radians(volume.angle_deg)),
      cosine(volume.shape == Shape::hemisphere ? 0.0 : std::cos(angle)),
      sine(std::sin(angle)) {
  if (shape == Shape::revolution) profile = std::make_shared<Profile>(sketch_of(volume));
  if (shape == Shape::mesh) level_set = level_set_of(volume.file, volume.voxel_size);
}

double Primitive::other_bound(const Vec3& point) const {
  switch (shape) {
    case Shape::box:
      return box_bound(point - center, radii);
    case Shape::revolution:
      return profile->signed_distance(beside_axis(point));
    case Shape::mesh:
      return mesh_bound(*level_set, point);
    default:
      return std::numeric_limits<double>::infinity();
  }
}

bool Primitive::is_convex() const {
  switch (shape) {
    case Shape::sphere_portion:
      return cosine >= 0.0 || angle >= radians(180.0);
    case Shape::revolution:
    case Shape::mesh:
      return false;
    default:
      return true;
  }
}

Vec2 Primitive::beside_axis(const Vec3& point) const {
  const Vec3 from = point - center;
  const double along = glm::dot(from, axis);
  return {glm::length(from - along * axis), along};
}

double Primitive::furthest(const Vec3& towards) const {
  const double middle = glm::dot(center, towards);
  const double along = glm::dot(axis, towards);
  const double length = glm::length(towards);
  const double across = std::sqrt(std::max(0.0, length * length - along * along));
  switch (shape) {
    case Shape::sphere:
      return middle + radius * length;
    case Shape::ellipsoid:
      return middle + glm::length(radii * towards);
    case Shape::cylinder:
      return middle + std::max(0.0, height * along) + radius * across;
    case Shape::cone:
      return std::max(middle + radius * across, middle + height * along);
    case Shape::hemisphere:
    case Shape::sphere_portion: {
      const double off = std::acos(std::clamp(along / length, -1.0, 1.0)) - angle;
      return middle + length * (off <= 0.0 ? radius : std::max(0.0, radius * std::cos(off)));
    }
    case Shape::box:
      return middle + glm::dot(radii, glm::abs(towards));
    case Shape::revolution: {
      double furthest = -std::numeric_limits<double>::infinity();
      for (const Vec2& corner : profile->corners()) {
        furthest = std::max(furthest, middle + corner.x * across + corner.y * along);
      }
      return furthest;
    }
    case Shape::mesh: {
      const Box& box = level_set->bounds();
      return glm::dot(box.center(), towards) + 0.5 * glm::dot(box.size(), glm::abs(towards));
    }
    case Shape::union_of:
    case Shape::difference:
    case Shape::intersection:
      break;
  }
  return -std::numeric_limits<double>::infinity();
}

bool Primitive::meets(const Vec3& from, const Vec3& to) const {
  const Vec3 start = from - center;
  const Vec3 step = to - from;
  const double along = glm::dot(start, axis);
  const double rise = glm::dot(step, axis);
  const Vec3 across = start - along * axis;
  const Vec3 sidestep = step - rise * axis;
  Stretch stretch;
  SideAlong side{0.0, 0.0, 1.0, across, sidestep};
  switch (shape) {
    case Shape::sphere:
      return distance_bound(from + nearest_share(start, step) * step) <= kSurfaceSlack;
    case Shape::ellipsoid:
      return distance_bound(from + nearest_share(start / radii, step / radii) * step) <= kSurfaceSlack;
    case Shape::box:
      return box_is_met({center - radii, center + radii}, from, to);
    case Shape::cylinder:
      clip_to_slab(stretch, along, rise, -kSurfaceSlack, height + kSurfaceSlack);
      side.constant = -radius;
      break;
    case Shape::cone: {
      const double slant = std::hypot(radius, height);
      clip_to_slab(stretch, along, rise, -kSurfaceSlack, height + kSurfaceSlack);
      side.constant = radius * (along - height) / slant;
      side.slope = radius * rise / slant;
      side.weight = height / slant;
      break;
    }
    case Shape::hemisphere:
    case Shape::sphere_portion:
      clip_to_ball(stretch, start, step, radius + kSurfaceSlack);
      side.constant = -along * sine;
      side.slope = -rise * sine;
      side.weight = cosine;
      break;
    default:
      return false;
  }
  return !stretch.is_empty() && side.least(stretch) <= kSurfaceSlack;
}

void Primitive::add_nearest_faces(const Vec3& point, std::vector<FacePoint>& faces) const {
  const Vec3 from = point - center;
  const double along = glm::dot(from, axis);
  const double across = std::sqrt(std::max(0.0, glm::dot(from, from) - along * along));
  const auto outwards = [&] { return normalized_or(from - along * axis, any_perpendicular(axis)); };
  switch (shape) {
    case Shape::sphere:
    case Shape::hemisphere:
    case Shape::sphere_portion: {
      const Vec3 normal = normalized_or(from, axis);
      faces.push_back({center + radius * normal, normal});
      break;
    }
    case Shape::ellipsoid: {
      const Vec3 foot = nearest_on_ellipsoid(from, radii);
      faces.push_back({center + foot, glm::normalize(foot / (radii * radii))});
      break;
    }
    case Shape::cylinder:
      faces.push_back({point + (radius - across) * outwards(), outwards()});
      faces.push_back({point + (height - along) * axis, axis});
      break;
    case Shape::cone: {
      const Vec3 normal = glm::normalize(radius * axis + height * outwards());
      const double depth = (radius * height - radius * along - height * across) / std::hypot(radius, height);
      faces.push_back({point + depth * normal, normal});
      break;
    }
    case Shape::box:
      for (int i = 0; i < 3; ++i) {
        for (const double side : {-1.0, 1.0}) {
          Vec3 normal(0.0);
          normal[i] = side;
          faces.push_back({point + (radii[i] - side * from[i]) * normal, normal});
        }
      }
      break;
    case Shape::revolution: {
      const Vec2 here(across, along);
      const Vec2 foot = profile->nearest_outer(here);
      const Vec3 on_face = center + foot.y * axis + foot.x * outwards();
      faces.push_back({on_face, normalized_or(on_face - point, outwards(), 1e-12)});
      break;
    }
    case Shape::mesh:
      faces.push_back(nearest_on_mesh(*level_set, point));
      break;
    case Shape::union_of:
    case Shape::difference:
    case Shape::intersection:
      break;
  }
}

std::optional<double> Primitive::face_along(const Vec3& ray) const {
  const double along = glm::dot(ray, axis);
  const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
  switch (shape) {
    case Shape::sphere:
      return radius;
    case Shape::ellipsoid:
      return 1.0 / glm::length(ray / radii);
    case Shape::cylinder:
      if (along < 0.0) return std::nullopt;
      return across * height > along * radius ? radius / across : height / along;
    case Shape::cone:
      if (along < 0.0) return std::nullopt;
      return 1.0 / (along / height + across / radius);
    case Shape::hemisphere:
    case Shape::sphere_portion:
      if (along < cosine) return std::nullopt;
      return radius;
    case Shape::box: {
      const Vec3 share = glm::abs(ray) / radii;
      return 1.0 / std::max({share.x, share.y, share.z});
    }
    default:
      return std::nullopt;
  }
}

}  // namespace ramify
