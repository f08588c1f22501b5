#include "common/format/treeqsm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "common/base/errors.h"

namespace ramify {
namespace {

// The program's own order, for files without a header; later columns are not read.
const std::vector<std::string_view> kOrder = {"radius", "length",    "start", "axis",
                                              "parent", "extension", "branch"};

/// "Start_point (m)" is "start".
std::string plain(std::string_view column) {
  std::string name(trimmed(column.substr(0, column.find('('))));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return c == ' ' ? '_' : static_cast<char>(std::tolower(c)); });
  if (name == "start_point") return "start";
  if (name == "axis_direction") return "axis";
  return name;
}

bool is_headless(const TextTable& table) {
  return finite_number(table.columns().front()).has_value();
}

/// Where the values of each named column begin, and how many values a row has.
struct Places {
  std::map<std::string, std::size_t> first;
  std::size_t width = 0;

  void add(const std::string& name) {
    first.emplace(name, width);
    width += name == "start" || name == "axis" ? 3 : 1;
  }

  std::size_t required(const std::string& name, const std::string& file) const {
    const auto found = first.find(name);
    if (found != first.end()) return found->second;
    throw InputError(fmt::format("{}:1: no column '{}' (TreeQSM's cylinders have {})", file, name,
                                 "radius, length, start_point, axis_direction, parent"));
  }
};

Places places_of(const TextTable& table) {
  Places places;
  if (!is_headless(table)) {
    for (const std::string_view column : table.columns()) places.add(plain(column));
    return places;
  }
  for (const std::string_view column : kOrder) places.add(std::string(column));
  places.width = std::max(places.width, table.columns().size());
  return places;
}

}  // namespace

bool is_treeqsm(const TextTable& table) {
  if (is_headless(table)) return true;
  return std::any_of(table.columns().begin(), table.columns().end(),
                     [](std::string_view column) { return plain(column) == "axis"; });
}

Cylinders read_treeqsm(std::string_view text, const std::string& name) {
  TextTable header(text, name);
  const Places places = places_of(header);
  const std::size_t radius = places.required("radius", name);
  const std::size_t length = places.required("length", name);
  const std::size_t start = places.required("start", name);
  const std::size_t axis = places.required("axis", name);
  const std::size_t parent = places.required("parent", name);
  const auto branch = places.first.find("branch");

  Cylinders cylinders;
  cylinders.links.id_name = "row";
  cylinders.links.parent_name = "parent";
  cylinders.links.no_parent = 0;
  TextTable table(text, name, !is_headless(header));
  while (table.next_row(places.width)) {
    const auto row = static_cast<std::int64_t>(cylinders.radius.size()) + 1;
    cylinders.links.add(row, table.whole(parent, "parent"), table.line());
    const Vec3 from = table.point({start, start + 1, start + 2}, {"start x", "start y", "start z"});
    const Vec3 along = table.point({axis, axis + 1, axis + 2}, {"axis x", "axis y", "axis z"});
    cylinders.start.push_back(from);
    cylinders.end.push_back(from + table.number(length, "length") * along);
    cylinders.radius.push_back(table.positive(radius, "radius"));
    if (branch != places.first.end()) cylinders.run.push_back(table.whole(branch->second, "branch"));
  }
  return cylinders;
}

}  // namespace ramify
