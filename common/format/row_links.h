// Rows that name their parents by number, in any order, as the nodes of a skeleton: parents first.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/base/geometry.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// The rows of a table by their numbers, and how the table calls these.
struct RowLinks {
  std::string id_name;          // "ID"
  std::string parent_name;      // "parentID"
  std::int64_t no_parent = -1;  // what a row without parent says
  std::vector<std::int64_t> id;
  std::vector<std::int64_t> parent;
  std::vector<std::size_t> line;  // for messages

  void add(std::int64_t row_id, std::int64_t row_parent, std::size_t row_line);
};

/// The row of each row's parent, kNoParent where it has none. O(n log n). Throws InputError naming the line
/// of a number that stands twice or of a parent that is no row's.
std::vector<std::uint32_t> parent_rows(const RowLinks& links, const std::string& file);

/// The rows, each after its parent, otherwise as they stand. O(n). Throws InputError naming the line of a row
/// that is its own ancestor.
std::vector<std::uint32_t> parents_first(const RowLinks& links, std::span<const std::uint32_t> parents,
                                         const std::string& file);

/// Where the nodes of a skeleton come from: its root nodes first, one for each point where rows without
/// parent start, then one node a row.
struct NodeLayout {
  std::size_t root_count = 0;
  std::vector<std::uint32_t> row;     // of each node; of a root node the first row that starts there
  std::vector<std::uint32_t> parent;  // node of each node
};

/// `start` has one entry a row, of which those without parent count. Throws InputError as above, and if there
/// are no rows.
NodeLayout lay_out(const RowLinks& links, std::span<const Vec3> start, const std::string& file);

}  // namespace ramify
