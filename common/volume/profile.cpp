#include "common/volume/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>

#include "common/base/errors.h"
#include "common/base/files.h"

namespace ramify {
namespace {

constexpr std::string_view kHeader = "radius,height";

double square(const Vec2& v) {
  return glm::dot(v, v);
}

Vec2 nearest_on_segment(const Vec2& from, const Vec2& to, const Vec2& point) {
  const Vec2 along = to - from;
  const double length = square(along);
  if (length == 0.0) return from;
  return from + std::clamp(glm::dot(point - from, along) / length, 0.0, 1.0) * along;
}

std::string without_blanks(std::string_view line) {
  std::string kept;
  std::copy_if(line.begin(), line.end(), std::back_inserter(kept),
               [](char c) { return c != ' ' && c != '\t' && c != '\r'; });
  return kept;
}

bool read_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

Profile::Profile(const Sketch& sketch) : corners_(sketch) {
  if (sketch.empty()) return;
  if (corners_.front() != corners_.back()) {
    const double first_height = corners_.front().y;
    corners_.emplace_back(0.0, corners_.back().y);
    corners_.insert(corners_.begin(), Vec2(0.0, first_height));
  }

  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec2& corner : corners_) lowest = std::min(lowest, corner.y);
  for (std::size_t i = 1; i < corners_.size(); ++i) {
    const Vec2& from = corners_[i - 1];
    const Vec2& to = corners_[i];
    if (from.x == 0.0 && to.x == 0.0) continue;
    const bool is_bottom = from.y == lowest && to.y == lowest;
    edges_.push_back({from, to, !is_bottom});
  }
}

double Profile::signed_distance(const Vec2& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  bool is_inside = false;
  for (const auto& [from, to, is_outer] : edges_) {
    nearest = std::min(nearest, square(nearest_on_segment(from, to, point) - point));
    // A way out, straight away from the axis.
    if ((from.y > point.y) == (to.y > point.y)) continue;
    const double crossing = from.x + (point.y - from.y) / (to.y - from.y) * (to.x - from.x);
    if (crossing > point.x) is_inside = !is_inside;
  }
  return is_inside ? -std::sqrt(nearest) : std::sqrt(nearest);
}

Vec2 Profile::nearest_outer(const Vec2& point) const {
  Vec2 best = point;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [from, to, is_outer] : edges_) {
    if (!is_outer) continue;
    const Vec2 foot = nearest_on_segment(from, to, point);
    const double distance = square(foot - point);
    if (distance >= nearest) continue;
    nearest = distance;
    best = foot;
  }
  return best;
}

std::string sketch_problem(const Sketch& sketch) {
  for (std::size_t i = 0; i < sketch.size(); ++i) {
    if (sketch[i].x < 0.0) return fmt::format("point {}: radius {} is less than 0", i + 1, sketch[i].x);
  }
  if (sketch.size() < 2) return fmt::format("a sketch of {} points (at least 2)", sketch.size());
  return {};
}

Sketch read_sketch(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  Sketch sketch;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = without_blanks(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    ++number;
    if (line.empty() || (sketch.empty() && line == kHeader)) continue;

    const std::size_t comma = std::min(line.find(','), line.size());
    Vec2 point(0.0);
    const bool is_point = comma < line.size() &&
                          read_number(std::string_view(line).substr(0, comma), point.x) &&
                          read_number(std::string_view(line).substr(comma + 1), point.y);
    if (!is_point) {
      throw InputError(
          fmt::format("{}:{}: '{}' is no point (two numbers, {})", file.string(), number, line, kHeader));
    }
    sketch.push_back(point);
  }
  return sketch;
}

}  // namespace ramify
