#include "common/format/treegraph.h"

#include <array>
#include <string_view>

namespace ramify {
namespace {

constexpr const char* kHint =
    "a table of Treegraph or aRchi has startX, ..., endZ, cyl_ID, parent_ID, radius_cyl";

}  // namespace

bool is_treegraph(const TextTable& table) {
  return table.column("cyl_ID").has_value();
}

Cylinders read_treegraph(TextTable& table) {
  const std::array<std::string_view, 3> starts = {"startX", "startY", "startZ"};
  const std::array<std::string_view, 3> ends = {"endX", "endY", "endZ"};
  std::array<std::size_t, 3> start{};
  std::array<std::size_t, 3> end{};
  for (std::size_t i = 0; i < 3; ++i) start[i] = table.required_column(starts[i], kHint);
  for (std::size_t i = 0; i < 3; ++i) end[i] = table.required_column(ends[i], kHint);
  const std::size_t id = table.required_column("cyl_ID", kHint);
  const std::size_t parent = table.required_column("parent_ID", kHint);
  const std::size_t radius = table.required_column("radius_cyl", kHint);
  const std::optional<std::size_t> axis = table.column("axis_ID");

  Cylinders cylinders;
  cylinders.links.id_name = "cyl_ID";
  cylinders.links.parent_name = "parent_ID";
  cylinders.links.no_parent = 0;
  while (table.next_row()) {
    cylinders.links.add(table.whole(id, "cyl_ID"), table.whole(parent, "parent_ID"), table.line());
    cylinders.start.push_back(table.point(start, starts));
    cylinders.end.push_back(table.point(end, ends));
    cylinders.radius.push_back(table.positive(radius, "radius_cyl"));
    if (axis) cylinders.run.push_back(table.whole(*axis, "axis_ID"));
  }
  return cylinders;
}

}  // namespace ramify
