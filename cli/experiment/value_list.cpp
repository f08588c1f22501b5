#include "cli/experiment/value_list.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "cli/text.h"
#include "common/base/errors.h"

namespace ramify::cli {
namespace {

// More values of one key than any sweep may have runs.
constexpr double kMaxValues = 1e6;

constexpr const char* kListForm = "a,b,c or from:to:step";

[[noreturn]] void fail(const std::string& key, const std::string& problem) {
  throw InputError(fmt::format("--vary: {}: {}", key, problem));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The parts between those separators that stand in no quotes and no brackets.
std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::string part;
  char quote = 0;
  int depth = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == separator && depth == 0) {
      parts.emplace_back(trimmed(part));
      part.clear();
      continue;
    }
    part += c;
  }
  parts.emplace_back(trimmed(part));
  return parts;
}

template <class Number>
std::optional<Number> number_of(std::string_view text) {
  if (text.substr(0, 1) == "+") text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// How many values there are between two numbers, both included; 0 if the step leads away.
double count_of(double from, double to, double step) {
  // A part in 10^9 of a step: so that 0.46:0.54:0.02 reaches 0.54.
  return std::floor((to - from) / step + 1e-9) + 1.0;
}

std::vector<std::string> range_values(const std::string& key, const std::string& text,
                                      const std::vector<std::string>& parts) {
  std::vector<double> numbers;
  for (const std::string& part : parts) {
    const auto number = number_of<double>(part);
    if (!number || !std::isfinite(*number))
      fail(key, fmt::format("'{}' is no number in '{}' ({})", part, text, kListForm));
    numbers.push_back(*number);
  }
  if (numbers.size() != 3) fail(key, fmt::format("'{}' is no range ({})", text, kListForm));
  const auto [from, to, step] = std::tuple(numbers[0], numbers[1], numbers[2]);
  if (step == 0.0) fail(key, fmt::format("the step of '{}' is 0 (more than 0, or less to go down)", text));
  const double count = count_of(from, to, step);
  if (count < 1.0) {
    fail(key,
         fmt::format("'{}' is empty: a step of {} leads from {} away from {} ({})", text, parts[2], parts[0],
                     parts[1], step > 0.0 ? "a negative one goes down" : "a positive one goes up"));
  }
  if (count > kMaxValues)
    fail(key, fmt::format("'{}' has {:.3g} values (at most {:.0f})", text, count, kMaxValues));
  const bool is_whole = number_of<std::int64_t>(parts[0]) && number_of<std::int64_t>(parts[2]);
  std::vector<std::string> values;
  for (double i = 0.0; i < count; ++i) {
    const double value = from + i * step;
    // Twelve digits leave out what rounding adds.
    values.push_back(is_whole ? fmt::format("{:.0f}", value) : fmt::format("{:.12g}", value));
  }
  return values;
}

}  // namespace

Axis axis_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(fmt::format("--vary: '{}' is no KEY=LIST ({})", text, kListForm));
  }
  Axis axis{text.substr(0, equals), {}};
  for (const std::string& item : parts_of(text.substr(equals + 1), ',')) {
    if (item.empty())
      fail(axis.key, fmt::format("a value is missing in '{}' ({})", text.substr(equals + 1), kListForm));
    const std::vector<std::string> parts = parts_of(item, ':');
    if (parts.size() == 1) {
      axis.values.push_back(item);
      continue;
    }
    const std::vector<std::string> values = range_values(axis.key, item, parts);
    axis.values.insert(axis.values.end(), values.begin(), values.end());
  }
  return axis;
}

}  // namespace ramify::cli
