#include "common/format/cylinders.h"

#include <algorithm>

#include "common/skeleton/passes.h"

namespace ramify {
namespace {

void find_largest_gap(const Cylinders& cylinders, const NodeLayout& layout, CylinderTree& tree) {
  const Skeleton& s = tree.skeleton;
  for (std::size_t node = layout.root_count; node < s.node_count(); ++node) {
    const double gap = glm::distance(cylinders.start[layout.row[node]], s.position[s.parent[node]]);
    if (gap <= tree.largest_gap) continue;
    tree.largest_gap = gap;
    tree.largest_gap_line = cylinders.links.line[layout.row[node]];
  }
}

}  // namespace

CylinderTree join_cylinders(const Cylinders& cylinders, const std::string& file) {
  const NodeLayout layout = lay_out(cylinders.links, cylinders.start, file);
  CylinderTree tree;
  Skeleton& s = tree.skeleton;
  s.parent = layout.parent;
  s.kind.assign(layout.row.size(), Kind::stem);
  std::vector<std::int64_t> run;
  for (std::size_t node = 0; node < layout.row.size(); ++node) {
    const std::uint32_t row = layout.row[node];
    s.position.push_back(node < layout.root_count ? cylinders.start[row] : cylinders.end[row]);
    s.diameter.push_back(2.0 * cylinders.radius[row]);
    s.channels[kStartRadius].push_back(cylinders.radius[row]);
    if (!cylinders.run.empty()) run.push_back(cylinders.run[row]);
  }
  // The trunk goes on from its root: in every table it has the lowest number, of orders, branches or axes.
  for (std::size_t node = layout.root_count; node < run.size(); ++node) {
    if (layout.parent[node] < layout.root_count) {
      run[layout.parent[node]] = std::min(run[layout.parent[node]], run[node]);
    }
  }
  if (run.empty()) {
    assign_axes(s);
  } else {
    assign_axes_along(s, run);
  }
  find_largest_gap(cylinders, layout, tree);
  return tree;
}

}  // namespace ramify
