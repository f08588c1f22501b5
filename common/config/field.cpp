#include "common/config/field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace ramify {
namespace {

std::string range_text(const FieldInfo& info) {
  return fmt::format("{}{} to {}", info.is_above_min ? "more than " : "", info.min, info.max);
}

/// Edit distance in which two letters that changed places count as one slip (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({substituted, d[i - 1][j] + 1, d[i][j - 1] + 1});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

Table joined(std::initializer_list<Table> tables) {
  Table all;
  for (const Table& table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

std::string allowed_values(const FieldRow& row) {
  switch (row.kind) {
    case FieldKind::number:
      return "a number, " + range_text(row.info);
    case FieldKind::integer:
      return "a whole number, " + range_text(row.info);
    case FieldKind::seed:
      return fmt::format("a whole number, 0 to {}", std::numeric_limits<std::int64_t>::max());  // TOML's most
    case FieldKind::boolean:
      return "true or false";
    case FieldKind::choice:
      return fmt::format("{}", fmt::join(row.info.choices, " | "));
    case FieldKind::vector:
      return "three numbers [x, y, z], each " + range_text(row.info);
    case FieldKind::schedule:
      return fmt::format("a number, {}, or [[{}, value], ...] with rising {}s", range_text(row.info),
                         row.info.over, row.info.over);
    case FieldKind::sketch:
      return fmt::format("a list of points [[x, y], ...], each number {}", range_text(row.info));
    case FieldKind::text:
      return "a text in quotes";
    case FieldKind::path:
      return "a file's path in quotes, seen from the config's own folder";
    case FieldKind::group:
      return "a table";
    case FieldKind::list:
      return "a list of tables";
    case FieldKind::map:
      return "named tables";
  }
  return {};
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace ramify
