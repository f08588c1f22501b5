#include "common/format/simpleforest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string_view>

#include "common/format/up_axis.h"

namespace ramify {
namespace {

constexpr const char* kHint = "a table of SimpleForest has ID, parentID, startX, ..., endZ, radius";

// As SimpleForest writes it, odd spacing included.
constexpr const char* kHeader =
    " ID, parentID, startX, startY, startZ, endX, endY, endZ, radius, length, growthLength, "
    "averagePointDistance,segmentID, parentSegmentID, branchOrder, reverseBranchOrder, branchID\n";

constexpr std::size_t kChunk = 1 << 16;

/// What the table tells of each node beyond its own attributes.
struct Segments {
  std::vector<std::int64_t> segment;         // stretches between two branching nodes, counted; -1 for roots
  std::vector<std::int64_t> parent_segment;  // the one that a segment follows
  std::vector<std::uint32_t> reverse_order;  // of segments: a tip's 1, below a fork the greatest + 1
  std::vector<double> growth_length;         // metres from the node's start to all its tips
  std::vector<std::uint32_t> branch;  // the lateral of the trunk that bears it, counted; 0 in the trunk
};

Segments segments_of(const Skeleton& s) {
  const std::size_t count = s.node_count();
  Segments result{std::vector<std::int64_t>(count, -1), std::vector<std::int64_t>(count, -1),
                  std::vector<std::uint32_t>(count, 1), std::vector<double>(count, 0.0),
                  std::vector<std::uint32_t>(count, 0)};
  std::vector<std::uint32_t> children(count, 0);
  for (std::size_t node = count; node-- > 0;) {
    if (children[node] > 1) ++result.reverse_order[node];
    if (s.is_root(node)) continue;
    const std::uint32_t parent = s.parent[node];
    result.growth_length[node] += s.length(node);
    result.growth_length[parent] += result.growth_length[node];
    result.reverse_order[parent] = std::max(result.reverse_order[parent], result.reverse_order[node]);
    ++children[parent];
  }
  std::int64_t next_segment = 0;
  std::uint32_t next_branch = 1;
  for (std::size_t node = s.root_count(); node < count; ++node) {
    const std::uint32_t parent = s.parent[node];
    const bool goes_on = !s.is_root(parent) && children[parent] == 1;
    result.segment[node] = goes_on ? result.segment[parent] : next_segment++;
    result.parent_segment[node] = goes_on ? result.parent_segment[parent] : result.segment[parent];
    const bool founds_branch = result.branch[parent] == 0 && s.order[node] > 0;
    result.branch[node] = founds_branch ? next_branch++ : result.branch[parent];
  }
  return result;
}

/// The radius of a cylinder as long and as voluminous as the internode's truncated cone.
double cylinder_radius(const Skeleton& s, std::size_t node) {
  const double end = 0.5 * s.diameter[node];
  const double start = s.start_radius(node);
  return start == end ? end : std::sqrt((start * start + start * end + end * end) / 3.0);
}

}  // namespace

bool is_simpleforest(const TextTable& table) {
  return table.column("segmentID") || table.column("growthLength") || table.column("reverseBranchOrder");
}

Cylinders read_simpleforest(TextTable& table) {
  const std::array<std::string_view, 3> starts = {"startX", "startY", "startZ"};
  const std::array<std::string_view, 3> ends = {"endX", "endY", "endZ"};
  std::array<std::size_t, 3> start{};
  std::array<std::size_t, 3> end{};
  const std::size_t id = table.required_column("ID", kHint);
  const std::size_t parent = table.required_column("parentID", kHint);
  for (std::size_t i = 0; i < 3; ++i) start[i] = table.required_column(starts[i], kHint);
  for (std::size_t i = 0; i < 3; ++i) end[i] = table.required_column(ends[i], kHint);
  const std::size_t radius = table.required_column("radius", kHint);
  const std::optional<std::size_t> order = table.column("branchOrder");

  Cylinders cylinders;
  cylinders.links.id_name = "ID";
  cylinders.links.parent_name = "parentID";
  while (table.next_row()) {
    cylinders.links.add(table.whole(id, "ID"), table.whole(parent, "parentID"), table.line());
    cylinders.start.push_back(table.point(start, starts));
    cylinders.end.push_back(table.point(end, ends));
    cylinders.radius.push_back(table.positive(radius, "radius"));
    if (order) cylinders.run.push_back(table.whole(*order, "branchOrder"));
  }
  return cylinders;
}

void write_simpleforest(const Skeleton& skeleton, std::ostream& out) {
  const Segments segments = segments_of(skeleton);
  const std::size_t roots = skeleton.root_count();
  fmt::memory_buffer rows;
  fmt::format_to(std::back_inserter(rows), "{}", kHeader);
  for (std::size_t node = roots; node < skeleton.node_count(); ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    const Vec3 start = z_up(skeleton.position[parent]);
    const Vec3 end = z_up(skeleton.position[node]);
    fmt::format_to(std::back_inserter(rows), "{},{},{},{},{},{},{},{},", node - roots,
                   parent < roots ? std::int64_t{-1} : static_cast<std::int64_t>(parent - roots), start.x,
                   start.y, start.z, end.x, end.y, end.z);
    fmt::format_to(std::back_inserter(rows), "{},{},{},,{},{},{},{},{}\n", cylinder_radius(skeleton, node),
                   skeleton.length(node), segments.growth_length[node], segments.segment[node],
                   segments.parent_segment[node], skeleton.order[node], segments.reverse_order[node],
                   segments.branch[node]);
    if (rows.size() < kChunk) continue;
    out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
    rows.clear();
  }
  out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

}  // namespace ramify
