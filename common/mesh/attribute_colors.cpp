#include "common/mesh/attribute_colors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/errors.h"
#include "common/mesh/palette.h"
#include "common/skeleton/passes.h"

namespace ramify {
namespace {

enum class Scale { categorical, linear, logarithmic };

struct Attribute {
  std::vector<double> values;  // one a node
  Scale scale = Scale::linear;
};

template <class T>
std::vector<double> as_numbers(const std::vector<T>& values) {
  return {values.begin(), values.end()};
}

/// `name` must be among color_attributes(skeleton).
Attribute attribute(const Skeleton& skeleton, std::string_view name) {
  if (name == "order") return {as_numbers(skeleton.order), Scale::categorical};
  if (name == "strahler") return {as_numbers(strahler_orders(skeleton)), Scale::linear};
  if (name == "width") return {skeleton.diameter, Scale::logarithmic};
  if (name == "birthStep") return {as_numbers(skeleton.birth_step), Scale::linear};
  if (name == "level") return {as_numbers(skeleton.level), Scale::categorical};
  if (name == "light") return {as_numbers(skeleton.light), Scale::logarithmic};
  if (name == "vigour") return {as_numbers(skeleton.vigour), Scale::logarithmic};
  return {skeleton.channels.at(std::string(name)), Scale::linear};
}

/// On a logarithmic scale only positive values have a place; the others stand at its low end.
std::vector<double> to_logarithms(std::vector<double> values) {
  double least = std::numeric_limits<double>::infinity();
  for (double value : values) {
    if (value > 0.0) least = std::min(least, value);
  }
  for (double& value : values) {
    if (!std::isnan(value)) value = std::isinf(least) ? 0.0 : std::log(std::max(value, least));
  }
  return values;
}

void require_attribute(const Skeleton& skeleton, std::string_view name, std::string_view asked_by) {
  const std::vector<std::string> known = color_attributes(skeleton);
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw InputError(
      fmt::format("{}: the tree has no attribute '{}' (it has {})", asked_by, name, fmt::join(known, ", ")));
}

struct Extremes {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

/// Of the internodes: root nodes bear none, what they hold must not stretch the scale.
Extremes extremes(const Skeleton& skeleton, const std::vector<double>& values, bool only_positive) {
  Extremes result;
  for (std::size_t node = skeleton.root_count(); node < values.size(); ++node) {
    if (!std::isfinite(values[node]) || (only_positive && values[node] <= 0.0)) continue;
    result.low = std::min(result.low, values[node]);
    result.high = std::max(result.high, values[node]);
  }
  return result;
}

}  // namespace

std::vector<std::string> color_attributes(const Skeleton& skeleton) {
  std::vector<std::string> names{"order", "strahler", "width"};
  if (!skeleton.birth_step.empty()) names.emplace_back("birthStep");
  if (!skeleton.level.empty()) names.emplace_back("level");
  if (!skeleton.light.empty()) names.emplace_back("light");
  if (!skeleton.vigour.empty()) names.emplace_back("vigour");
  for (const auto& [name, values] : skeleton.channels) names.push_back(name);
  return names;
}

AttributeScale attribute_scale(const Skeleton& skeleton, std::string_view name) {
  require_attribute(skeleton, name, "--color-by");
  const auto [values, scale] = attribute(skeleton, name);
  AttributeScale result;
  result.is_categorical = scale == Scale::categorical;
  result.is_logarithmic = scale == Scale::logarithmic;
  const Extremes found = extremes(skeleton, values, result.is_logarithmic);
  if (found.low <= found.high) {
    result.low = found.low;
    result.high = found.high;
  }
  return result;
}

std::vector<Color> attribute_colors(const Skeleton& skeleton, std::string_view name,
                                    std::string_view asked_by) {
  require_attribute(skeleton, name, asked_by);
  auto [values, scale] = attribute(skeleton, name);
  std::vector<Color> colors(values.size());
  if (scale == Scale::categorical) {
    for (std::size_t node = 0; node < values.size(); ++node) {
      colors[node] = categorical_color(static_cast<std::size_t>(values[node]));
    }
    return colors;
  }

  // Root nodes are grey.
  for (std::size_t node = 0; node < skeleton.root_count(); ++node) {
    values[node] = std::numeric_limits<double>::quiet_NaN();
  }
  if (scale == Scale::logarithmic) values = to_logarithms(std::move(values));
  const auto [low, high] = extremes(skeleton, values, false);
  for (std::size_t node = 0; node < values.size(); ++node) {
    colors[node] = sequential_color(high > low ? (values[node] - low) / (high - low) : values[node] - low);
  }
  return colors;
}

}  // namespace ramify
