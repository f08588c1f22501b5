#include "common/volume/solid.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "common/volume/part.h"
#include "common/volume/volume.h"

namespace ramify {
namespace {

// Rays to each part's outer faces where its nearest face is covered.
constexpr int kRayCount = 256;

}  // namespace

Solid::Solid(const Volume& volume) : parts_(parts_of(volume)) {
  // Most points are in the largest part: it is asked first.
  const auto box_volume = [](const Part& part) {
    const Vec3 size = part.bounds.size();
    return size.x * size.y * size.z;
  };
  std::stable_sort(parts_.begin(), parts_.end(),
                   [&](const Part& a, const Part& b) { return box_volume(a) > box_volume(b); });
}

Solid::~Solid() = default;
Solid::Solid(Solid&&) noexcept = default;
Solid& Solid::operator=(Solid&&) noexcept = default;

bool Solid::contains(const Vec3& point) const {
  // Without a branch on what the only part says, which cannot be foreseen where points are drawn.
  if (parts_.size() == 1) return parts_.front().contains(point);
  return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.contains(point); });
}

void Solid::find_inside(std::span<const Vec3> points, std::span<std::uint8_t> is_inside) const {
  std::fill(is_inside.begin(), is_inside.end(), std::uint8_t{0});
  for (const Part& part : parts_) {
    for (std::size_t i = 0; i < points.size(); ++i) is_inside[i] |= part.contains(points[i]);
  }
}

double Solid::distance_bound(const Vec3& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) least = std::min(least, part.distance_bound(point));
  return least;
}

bool Solid::is_farther(const Vec3& point, double distance) const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return part.distance_bound(point) > distance; });
}

bool Solid::meets(const Vec3& from, const Vec3& to) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.meets(from, to); });
}

std::optional<std::uint32_t> Solid::convex_part(const Vec3& point) const {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].is_convex && parts_[i].contains(point)) return static_cast<std::uint32_t>(i);
  }
  return std::nullopt;
}

bool Solid::is_convex() const {
  return parts_.size() == 1 && parts_.front().is_convex;
}

Box Solid::bounds() const {
  Box box;
  for (const Part& part : parts_) box.include(part.bounds);
  return box;
}

double Solid::outer_depth(const Vec3& point) const {
  if (!contains(point)) return 0.0;
  std::vector<FacePoint> faces;
  add_free_faces(parts_, point, faces);
  double nearest = std::numeric_limits<double>::infinity();
  for (const FacePoint& face : faces) nearest = std::min(nearest, glm::distance(point, face.point));
  if (std::isfinite(nearest)) return nearest;
  nearest = depth_by_rays(point);
  if (std::isfinite(nearest)) return nearest;
  // Each part that holds the point keeps the surface at least so far away.
  double bound = 0.0;
  for (const Part& part : parts_) bound = std::max(bound, -part.distance_bound(point));
  return bound;
}

double Solid::depth_by_rays(const Vec3& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) {
    const auto at = [&](const Vec3& way) {
      const Vec3 own = part.primitive.center + way;
      return part.placement ? part.placement->to_world(own) : own;
    };
    for (int i = 0; i < kRayCount && part.parts.empty(); ++i) {
      // Fibonacci's spiral spreads the rays evenly over the sphere.
      const double y = 1.0 - (2.0 * i + 1.0) / kRayCount;
      const double azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const double across = std::sqrt(1.0 - y * y);
      const Vec3 ray(across * std::cos(azimuth), y, across * std::sin(azimuth));
      const std::optional<double> reach = part.primitive.face_along(ray);
      if (!reach || is_covered(parts_, part, at((*reach + kFaceStep) * ray))) continue;
      nearest = std::min(nearest, glm::distance(point, at(*reach * ray)));
    }
  }
  return nearest;
}

}  // namespace ramify
