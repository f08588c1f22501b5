#include "common/volume/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "common/base/errors.h"
#include "common/base/parallel.h"

namespace ramify {
namespace {

// A point on the surface is inside: this much covers the rounding of a tilted axis. Metres.
constexpr double kSurfaceSlack = 1e-9;

// A face is covered where the point this far in front of it is inside another part: parts that only touch
// cover each other's faces, a part does not cover its own. Metres.
constexpr double kFaceStep = 1e-6;

// Points counted a task: some tens of microseconds.
constexpr std::size_t kPointsPerTask = 4096;

// Rays to each part's outer faces where its nearest face is covered.
constexpr int kRayCount = 256;

/// A place on an outer face and where the face looks there.
struct FacePoint {
  Vec3 point;
  Vec3 normal;
};

bool has_axis(Shape shape) {
  return shape == Shape::cylinder || shape == Shape::cone || shape == Shape::hemisphere ||
         shape == Shape::sphere_portion;
}

void collect_primitives(const Volume& volume, std::vector<const Volume*>& found) {
  if (volume.shape != Shape::union_of) found.push_back(&volume);
  if (volume.shape == Shape::union_of) {
    for (const Volume& part : volume.parts) collect_primitives(part, found);
  }
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

/// The volume of the part of `box` for which is_inside is true, by the share of evenly spread points that
/// are. M. Roberts' R3 sequence, 2018: a regular grid of as many points is off by up to 2 % where it lies
/// along a face.
template <class Inside>
double counted_volume(const Box& box, int points, const Inside& is_inside) {
  if (box.is_empty()) return 0.0;
  constexpr double kPlastic = 1.2207440846057596;  // the root of x^4 = x + 1
  const Vec3 stride = 1.0 / Vec3(kPlastic, kPlastic * kPlastic, kPlastic * kPlastic * kPlastic);
  const Vec3 size = box.size();

  const auto count = static_cast<std::size_t>(points);
  std::vector<std::size_t> inside((count + kPointsPerTask - 1) / kPointsPerTask, 0);
  parallel_for(inside.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * kPointsPerTask; i < std::min(end * kPointsPerTask, count); ++i) {
      const Vec3 place = glm::fract(static_cast<double>(i + 1) * stride);
      if (is_inside(box.low + place * size)) ++inside[i / kPointsPerTask];
    }
  });
  const std::size_t total = std::accumulate(inside.begin(), inside.end(), std::size_t{0});
  return size.x * size.y * size.z * static_cast<double>(total) / static_cast<double>(points);
}

void check_shape(const Volume& volume, const std::string& key) {
  if (volume.shape == Shape::union_of && volume.parts.empty()) {
    throw ConfigError("", key, "a union without parts (at least one part)");
  }
  if (volume.shape == Shape::union_of) {
    for (std::size_t i = 0; i < volume.parts.size(); ++i) {
      check_shape(volume.parts[i], fmt::format("{}.parts.{}", key, i + 1));
    }
  }
  if (has_axis(volume.shape) && glm::length(volume.direction) < 1e-6) {
    throw ConfigError("", key + ".direction",
                      "its length is 0 (any other length; only where it points counts)");
  }
}

}  // namespace

/// A primitive with what its tests need worked out.
struct Solid::Part {
  explicit Part(const Volume& volume)
      : shape(volume.shape),
        center(volume.center),
        axis(normalized_or(volume.direction, kUp)),
        radius(volume.radius),
        height(volume.height),
        radii(volume.radii),
        angle(volume.shape == Shape::hemisphere ? radians(90.0) : radians(volume.angle_deg)),
        cosine(volume.shape == Shape::hemisphere ? 0.0 : std::cos(angle)),
        sine(std::sin(angle)) {}

  /// The point is at least so far outside, and 0 or less on the surface and inside; metres. Exact but for an
  /// ellipsoid and beside edges.
  double distance_bound(const Vec3& point) const;
  bool contains(const Vec3& point) const { return distance_bound(point) <= kSurfaceSlack; }
  bool is_convex() const {
    return shape != Shape::sphere_portion || cosine >= 0.0 || angle >= radians(180.0);
  }
  Box bounds() const;

  /// The nearest point of each outer face to a point inside.
  std::array<std::optional<FacePoint>, 2> nearest_faces(const Vec3& point) const;

  /// How far the outer face is from the centre in the unit direction `ray`, if the ray meets one.
  std::optional<double> face_along(const Vec3& ray) const;

  Shape shape;
  Vec3 center;
  Vec3 axis;  // unit
  double radius;
  double height;
  Vec3 radii;
  double angle;  // of a portion, a hemisphere being one; radians
  double cosine;
  double sine;
};

double Solid::Part::distance_bound(const Vec3& point) const {
  const Vec3 from = point - center;
  const double square = glm::dot(from, from);
  const double along = glm::dot(from, axis);
  const auto across = [&] { return std::sqrt(std::max(0.0, square - along * along)); };
  switch (shape) {
    case Shape::sphere:
      return std::sqrt(square) - radius;
    case Shape::ellipsoid:
      return (glm::length(from / radii) - 1.0) * std::min({radii.x, radii.y, radii.z});
    case Shape::cylinder:
      return std::max({-along, along - height, across() - radius});
    case Shape::cone:
      return std::max(-along,
                      (radius * along + height * across() - radius * height) / std::hypot(radius, height));
    case Shape::hemisphere:
    case Shape::sphere_portion:
      return std::max(std::sqrt(square) - radius, across() * cosine - along * sine);
    case Shape::union_of:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

Box Solid::Part::bounds() const {
  Box box;
  const auto include_disk = [&](const Vec3& middle) {
    const Vec3 reach = radius * glm::sqrt(glm::max(Vec3(0.0), 1.0 - axis * axis));
    box.include(middle - reach);
    box.include(middle + reach);
  };
  // How far a portion of a sphere goes towards a unit vector at angle acos(c) from its axis.
  const auto portion_reach = [&](double c) {
    const double off = std::acos(std::clamp(c, -1.0, 1.0)) - angle;
    return off <= 0.0 ? radius : std::max(0.0, radius * std::cos(off));
  };
  switch (shape) {
    case Shape::sphere:
    case Shape::ellipsoid: {
      const Vec3 reach = shape == Shape::sphere ? Vec3(radius) : radii;
      box.include(center - reach);
      box.include(center + reach);
      break;
    }
    case Shape::cylinder:
      include_disk(center);
      include_disk(center + height * axis);
      break;
    case Shape::cone:
      include_disk(center);
      box.include(center + height * axis);
      break;
    case Shape::hemisphere:
    case Shape::sphere_portion:
      for (int i = 0; i < 3; ++i) {
        box.low[i] = center[i] - portion_reach(-axis[i]);
        box.high[i] = center[i] + portion_reach(axis[i]);
      }
      break;
    case Shape::union_of:
      break;
  }
  return box;
}

std::array<std::optional<FacePoint>, 2> Solid::Part::nearest_faces(const Vec3& point) const {
  const Vec3 from = point - center;
  const double along = glm::dot(from, axis);
  const double across = std::sqrt(std::max(0.0, glm::dot(from, from) - along * along));
  const auto outwards = [&] { return normalized_or(from - along * axis, any_perpendicular(axis)); };
  switch (shape) {
    case Shape::sphere:
    case Shape::hemisphere:
    case Shape::sphere_portion: {
      const Vec3 normal = normalized_or(from, axis);
      return {FacePoint{center + radius * normal, normal}, std::nullopt};
    }
    case Shape::ellipsoid: {
      const Vec3 foot = nearest_on_ellipsoid(from, radii);
      return {FacePoint{center + foot, glm::normalize(foot / (radii * radii))}, std::nullopt};
    }
    case Shape::cylinder:
      return {FacePoint{point + (radius - across) * outwards(), outwards()},
              FacePoint{point + (height - along) * axis, axis}};
    case Shape::cone: {
      const Vec3 normal = glm::normalize(radius * axis + height * outwards());
      const double depth = (radius * height - radius * along - height * across) / std::hypot(radius, height);
      return {FacePoint{point + depth * normal, normal}, std::nullopt};
    }
    case Shape::union_of:
      break;
  }
  return {};
}

std::optional<double> Solid::Part::face_along(const Vec3& ray) const {
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
    case Shape::union_of:
      break;
  }
  return std::nullopt;
}

Solid::Solid(const Volume& volume) {
  std::vector<const Volume*> primitives;
  collect_primitives(volume, primitives);
  parts_.reserve(primitives.size());
  for (const Volume* primitive : primitives) parts_.emplace_back(*primitive);
  // Most points are in the largest part: it is asked first.
  const auto box_volume = [](const Part& part) {
    const Vec3 size = part.bounds().size();
    return size.x * size.y * size.z;
  };
  std::stable_sort(parts_.begin(), parts_.end(),
                   [&](const Part& a, const Part& b) { return box_volume(a) > box_volume(b); });
}

Solid::~Solid() = default;
Solid::Solid(Solid&&) noexcept = default;
Solid& Solid::operator=(Solid&&) noexcept = default;

bool Solid::contains(const Vec3& point) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.contains(point); });
}

bool Solid::is_farther(const Vec3& point, double distance) const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return part.distance_bound(point) > distance; });
}

std::optional<std::uint32_t> Solid::convex_part(const Vec3& point) const {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].is_convex() && parts_[i].contains(point)) return static_cast<std::uint32_t>(i);
  }
  return std::nullopt;
}

Box Solid::bounds() const {
  Box box;
  for (const Part& part : parts_) box.include(part.bounds());
  return box;
}

bool Solid::is_covered(const Vec3& point, const Part& own) const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return &part != &own && part.contains(point); });
}

double Solid::outer_depth(const Vec3& point) const {
  if (!contains(point)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) {
    if (!part.contains(point)) continue;
    for (const std::optional<FacePoint>& face : part.nearest_faces(point)) {
      if (!face || is_covered(face->point + kFaceStep * face->normal, part)) continue;
      nearest = std::min(nearest, glm::distance(point, face->point));
    }
  }
  return std::isfinite(nearest) ? nearest : depth_by_rays(point);
}

double Solid::depth_by_rays(const Vec3& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) {
    for (int i = 0; i < kRayCount; ++i) {
      // Fibonacci's spiral spreads the rays evenly over the sphere.
      const double y = 1.0 - (2.0 * i + 1.0) / kRayCount;
      const double azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const double across = std::sqrt(1.0 - y * y);
      const Vec3 ray(across * std::cos(azimuth), y, across * std::sin(azimuth));
      const std::optional<double> reach = part.face_along(ray);
      if (!reach || is_covered(part.center + (*reach + kFaceStep) * ray, part)) continue;
      nearest = std::min(nearest, glm::distance(point, part.center + *reach * ray));
    }
  }
  return nearest;
}

bool contains(const Volume& volume, const Vec3& point) {
  return Solid(volume).contains(point);
}

Box bounds(const Volume& volume) {
  return Solid(volume).bounds();
}

double outer_depth(const Volume& volume, const Vec3& point) {
  return Solid(volume).outer_depth(point);
}

double volume_of(const Volume& volume, int points) {
  const Solid solid(volume);
  return counted_volume(solid.bounds(), points, [&](const Vec3& point) { return solid.contains(point); });
}

double shared_volume_of(const Volume& a, const Volume& b, int points) {
  const Solid solid_a(a);
  const Solid solid_b(b);
  const Box box_a = solid_a.bounds();
  const Box box_b = solid_b.bounds();
  const Box shared{glm::max(box_a.low, box_b.low), glm::min(box_a.high, box_b.high)};
  return counted_volume(
      shared, points, [&](const Vec3& point) { return solid_a.contains(point) && solid_b.contains(point); });
}

void check_volume(const Volume& volume, const std::string& key) {
  check_shape(volume, key);
  if (volume_of(volume) > 0.0) return;
  throw ConfigError("", key, "nothing inside it (sizes that fill at least a hundred-thousandth of its box)");
}

const Table& Volume::fields() {
  // Larger than any plant, and small enough that a cell's number still fits.
  constexpr double kFar = 1000.0;
  static const Table table = make_table<Volume>({
      {"shape",
       &Volume::shape,
       {.help = "what the solid is",
        .source = "XM12 3.3.1",
        .choices = {"sphere", "ellipsoid", "cylinder", "cone", "hemisphere", "sphere_portion", "union"}}},
      {"center",
       &Volume::center,
       {.min = -kFar,
        .max = kFar,
        .unit = "metres",
        .help = "centre of a sphere or ellipsoid, of the base of the others; a portion's apex"}},
      {"radius",
       &Volume::radius,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "of a sphere, hemisphere, portion or cylinder; of a cone's base"}},
      {"height",
       &Volume::height,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "of a cylinder or cone, along its direction"}},
      {"radii",
       &Volume::radii,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "half axes of an ellipsoid along x, y and z"}},
      {"angle_deg",
       &Volume::angle_deg,
       {.max = 180.0,
        .is_above_min = true,
        .unit = "degrees",
        .help = "sphere_portion: greatest angle from the direction; 90 is a half ball",
        .source = "XM12 Fig. 4, step 4C"}},
      {"direction",
       &Volume::direction,
       {.min = -kFar,
        .max = kFar,
        .help = "axis: from the base of a cylinder, cone or hemisphere, along the middle of a portion"}},
      {"parts", &Volume::parts, {.help = "union: what it is made of; parts may overlap and be unions again"}},
  });
  return table;
}

}  // namespace ramify
