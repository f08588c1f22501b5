#include "viewer/camera.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <glm/gtc/matrix_transform.hpp>

namespace ramify {
namespace {

// Of the picture's longer side. Wide enough for depth, narrow enough that the near branches do not swell.
constexpr double kFieldOfViewDeg = 30.0;

// A picture never shows less than this, metres: a tree may be a single point.
constexpr double kSmallestExtent = 0.02;

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// As many numbers as asked for, with commas between them; nullopt for anything else.
template <std::size_t N>
std::optional<std::array<double, N>> parse_numbers(std::string_view text) {
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    const bool is_last = i + 1 == N;
    const std::size_t end = is_last ? text.size() : text.find(',');
    if (end == std::string_view::npos) return std::nullopt;
    const std::optional<double> number = parse_number(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers[i] = *number;
    if (!is_last) text.remove_prefix(end + 1);
  }
  return numbers;
}

// Of the distance to the place that a close-up shows: what is nearer is cut away.
constexpr double kNearestOfCloseUp = 0.3;

/// Half the size of a picture's plane one metre away, its longer side `longer`.
glm::dvec2 half_size_of(double aspect, double longer) {
  return longer * (aspect >= 1.0 ? glm::dvec2(1.0, 1.0 / aspect) : glm::dvec2(aspect, 1.0));
}

}  // namespace

std::optional<ViewDirection> parse_view(std::string_view text) {
  if (text == "front") return ViewDirection{0.0, 0.0};
  if (text == "side") return ViewDirection{90.0, 0.0};
  if (text == "top") return ViewDirection{0.0, 90.0};
  const auto angles = parse_numbers<2>(text);
  if (!angles || std::abs((*angles)[1]) > 90.0) return std::nullopt;
  return ViewDirection{(*angles)[0], (*angles)[1]};
}

std::optional<Vec3> parse_point(std::string_view text) {
  const auto numbers = parse_numbers<3>(text);
  if (!numbers) return std::nullopt;
  return Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

CameraAxes camera_axes(double azimuth_deg, double elevation_deg) {
  const double azimuth = radians(azimuth_deg);
  const double elevation = radians(elevation_deg);
  CameraAxes axes;
  axes.back = {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
               std::cos(azimuth) * std::cos(elevation)};
  // Not from a cross product with +Y, which vanishes for a view straight down.
  axes.right = {std::cos(azimuth), 0.0, -std::sin(azimuth)};
  axes.up = glm::cross(axes.back, axes.right);
  return axes;
}

glm::dmat4 Camera::world_to_clip() const {
  const glm::dmat4 view = glm::lookAt(eye, eye - axes.back, axes.up);
  const double scale = is_parallel ? 1.0 : near_distance;
  const glm::dvec2 half = half_size * scale;
  return (is_parallel ? glm::ortho(-half.x, half.x, -half.y, half.y, near_distance, far_distance)
                      : glm::frustum(-half.x, half.x, -half.y, half.y, near_distance, far_distance)) *
         view;
}

std::array<Vec3, 8> corners(const Box& box) {
  std::array<Vec3, 8> result;
  for (int index = 0; index < 8; ++index) {
    result[index] = {index & 1 ? box.high.x : box.low.x, index & 2 ? box.high.y : box.low.y,
                     index & 4 ? box.high.z : box.low.z};
  }
  return result;
}

double field_of_view() {
  return std::tan(radians(kFieldOfViewDeg / 2.0));
}

Camera close_up_camera(const ViewDirection& view, double aspect, const CloseUp& place, double farthest) {
  Camera camera;
  camera.axes = camera_axes(view.azimuth_deg, view.elevation_deg);
  camera.is_parallel = view.is_parallel;
  const glm::dvec2 tangents = half_size_of(aspect, field_of_view());
  const double distance = 0.5 * place.across / std::min(tangents.x, tangents.y);
  camera.half_size = view.is_parallel ? tangents * distance : tangents;
  camera.eye = place.center + camera.axes.back * distance;
  camera.near_distance = kNearestOfCloseUp * distance;
  camera.far_distance = std::max(2.0 * distance, glm::dot(camera.eye, camera.axes.back) - farthest);
  return camera;
}

Framer::Framer(const ViewDirection& view, double aspect, double margin)
    : Framer(view, half_size_of(aspect, field_of_view()), margin) {}

Framer::Framer(const ViewDirection& view, const glm::dvec2& half_size, double margin)
    : axes_(camera_axes(view.azimuth_deg, view.elevation_deg)),
      is_parallel_(view.is_parallel),
      half_size_(half_size),
      free_size_(half_size * (1.0 - 2.0 * margin)),
      high_side_(-std::numeric_limits<double>::infinity()),
      low_side_(std::numeric_limits<double>::infinity()) {}

void Framer::include(const Vec3& point) {
  const Vec3 at = axes_.coordinates(point);
  extent_.include(at);
  high_side_ = glm::max(high_side_, glm::dvec2(at) + free_size_ * at.z);
  low_side_ = glm::min(low_side_, glm::dvec2(at) - free_size_ * at.z);
}

Camera Framer::camera(double reach) const {
  if (extent_.is_empty()) {
    Framer at_origin = *this;
    at_origin.include(Vec3(0.0));
    return at_origin.camera(reach);
  }
  Camera camera;
  camera.axes = axes_;
  camera.is_parallel = is_parallel_;
  if (is_parallel_) {
    const glm::dvec2 half = glm::max(glm::dvec2(extent_.size()) / 2.0, glm::dvec2(kSmallestExtent / 2.0));
    const glm::dvec2 needed = half / free_size_;
    camera.half_size = half_size_ * std::max(needed.x, needed.y);
    const double distance = reach + kSmallestExtent;
    camera.eye = axes_.world({extent_.center().x, extent_.center().y, extent_.high.z + distance});
    camera.near_distance = 0.0;
    camera.far_distance = 2.0 * distance + extent_.size().z;
    return camera;
  }

  // A point at depth z is inside if |coordinate - eye| <= tangent * (distance - z) on both sides: the
  // distance follows from the two sides' extremes, and the eye lies half way between them.
  const glm::dvec2 middle = (high_side_ + low_side_) / 2.0;
  const glm::dvec2 needed = (high_side_ - low_side_) / (2.0 * free_size_);
  const double nearest = extent_.high.z + kSmallestExtent / std::min(free_size_.x, free_size_.y);
  const double depth = std::max({needed.x, needed.y, nearest});
  camera.half_size = half_size_;
  camera.eye = axes_.world({middle.x, middle.y, depth});
  camera.near_distance = 0.05 * (depth - extent_.high.z);
  camera.far_distance = depth - extent_.low.z + reach;
  return camera;
}

}  // namespace ramify
