#include "common/format/skeleton_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <string_view>

#include "common/base/errors.h"
#include "common/format/row_links.h"
#include "common/format/text_table.h"

namespace ramify {
namespace {

enum Column {
  kId,
  kParentId,
  kStartX,
  kStartY,
  kStartZ,
  kEndX,
  kEndY,
  kEndZ,
  kRadius,
  kLength,
  kBranchId,
  kBranchOrder,
  kBirthStep,
  kShedStep,
  kLevel,
  kLight,
  kVigour,
  kKind,
  kColumnCount
};

constexpr std::array<std::string_view, kColumnCount> kColumnNames = {
    "ID",     "parentID", "startX",      "startY",    "startZ",   "endX",  "endY",  "endZ",   "radius",
    "length", "branchID", "branchOrder", "birthStep", "shedStep", "level", "light", "vigour", "kind"};

constexpr std::size_t kChunk = 1 << 16;

// --- Writing
// ------------------------------------------------------------------------------------------------

using Buffer = fmt::memory_buffer;

template <class T>
void put(Buffer& row, const T& value) {
  fmt::format_to(std::back_inserter(row), "{},", value);
}

/// A value, or nothing where the skeleton has no such attribute or `has_value` denies it.
template <class T>
void put_optional(Buffer& row, const std::vector<T>& values, std::size_t node, bool has_value = true) {
  if (!values.empty() && has_value) fmt::format_to(std::back_inserter(row), "{}", values[node]);
  row.push_back(',');
}

void put_row(Buffer& row, const Skeleton& s, std::size_t node, std::size_t roots) {
  const std::uint32_t parent = s.parent[node];
  const Vec3& start = s.position[parent];
  const Vec3& end = s.position[node];
  put(row, node - roots);
  put(row, parent < roots ? std::int64_t{-1} : static_cast<std::int64_t>(parent - roots));
  for (const double x : {start.x, start.y, start.z, end.x, end.y, end.z}) put(row, x);
  put(row, 0.5 * s.diameter[node]);
  put(row, s.length(node));
  put(row, s.axis[node]);
  put(row, s.order[node]);
  put_optional(row, s.birth_step, node);
  put_optional(row, s.shed_step, node, s.is_shed(node));
  put_optional(row, s.level, node);
  put_optional(row, s.light, node);
  put_optional(row, s.vigour, node);
  const std::string_view kind = s.kind[node] == Kind::root ? "root\n" : "stem\n";
  row.append(kind.data(), kind.data() + kind.size());
}

// --- Reading
// ------------------------------------------------------------------------------------------------

/// One pass over a table's rows into columns, which then are laid out as nodes.
class TableReader {
 public:
  TableReader(const std::string& text, const std::string& name) : name_(name), table_(text, name) {
    links_.id_name = kColumnNames[kId];
    links_.parent_name = kColumnNames[kParentId];
    for (std::size_t column = 0; column < kColumnCount; ++column) {
      place_[column] = table_.column(kColumnNames[column]);
    }
    for (const Column column :
         {kId, kParentId, kStartX, kStartY, kStartZ, kEndX, kEndY, kEndZ, kRadius, kBranchId, kBranchOrder}) {
      table_.required_column(kColumnNames[column],
                             fmt::format("a skeleton table begins {},{},{},...", kColumnNames[kId],
                                         kColumnNames[kParentId], kColumnNames[kStartX]));
    }
  }

  Skeleton read() {
    while (table_.next_row()) read_row();
    const NodeLayout layout = lay_out(links_, start_, name_);
    Skeleton result = gathered(rows_, layout.row);
    result.parent = layout.parent;
    make_roots(result, layout);
    return result;
  }

 private:
  bool is_empty(Column column) const { return !place_[column] || table_.cell(*place_[column]).empty(); }

  double number(Column column) const { return table_.number(*place_[column], kColumnNames[column]); }

  Vec3 point(Column x, Column y, Column z) const { return {number(x), number(y), number(z)}; }

  /// A whole number that T holds.
  template <class T>
  T whole(Column column) const {
    const std::int64_t value = table_.whole(*place_[column], kColumnNames[column]);
    if (value < 0 || value > std::numeric_limits<T>::max()) {
      table_.fail(fmt::format("{}: '{}' is no whole number in range", kColumnNames[column], value));
    }
    return static_cast<T>(value);
  }

  /// A column that may be missing or have empty cells.
  template <class T>
  void read_optional(Column column, std::vector<T>& values, T missing) {
    if (!is_empty(column)) has_value_[column] = true;
    if (is_empty(column)) {
      values.push_back(missing);
    } else if constexpr (std::is_floating_point_v<T>) {
      values.push_back(table_.float_number(*place_[column], kColumnNames[column]));
    } else {
      values.push_back(whole<T>(column));
    }
  }

  void read_row() {
    links_.add(table_.whole(*place_[kId], kColumnNames[kId]),
               table_.whole(*place_[kParentId], kColumnNames[kParentId]), table_.line());
    start_.push_back(point(kStartX, kStartY, kStartZ));
    rows_.position.push_back(point(kEndX, kEndY, kEndZ));
    rows_.diameter.push_back(2.0 * table_.positive(*place_[kRadius], kColumnNames[kRadius]));
    rows_.axis.push_back(whole<std::uint32_t>(kBranchId));
    rows_.order.push_back(whole<std::uint16_t>(kBranchOrder));
    read_optional(kBirthStep, rows_.birth_step, std::uint32_t{0});
    read_optional(kShedStep, rows_.shed_step, kAlive);
    read_optional(kLevel, rows_.level, std::uint16_t{0});
    read_optional(kLight, rows_.light, 0.0f);
    read_optional(kVigour, rows_.vigour, 0.0f);
    const std::string_view kind = is_empty(kKind) ? "" : table_.cell(*place_[kKind]);
    if (kind != "" && kind != "stem" && kind != "root") {
      table_.fail(fmt::format("kind: '{}' (stem | root)", shown(kind)));
    }
    rows_.kind.push_back(kind == "root" ? Kind::root : Kind::stem);
  }

  /// What root nodes have not from the first row that starts there.
  void make_roots(Skeleton& s, const NodeLayout& layout) const {
    for (std::size_t root = 0; root < layout.root_count; ++root) s.position[root] = start_[layout.row[root]];
    for (std::size_t node = layout.root_count; node < s.node_count(); ++node) {
      if (layout.parent[node] >= layout.root_count) continue;
      double& widest = s.diameter[layout.parent[node]];
      widest = std::max(widest, s.diameter[node]);
    }
    if (!has_value_[kBirthStep]) s.birth_step.clear();
    if (!has_value_[kBirthStep] && !has_value_[kShedStep]) s.shed_step.clear();
    if (!has_value_[kLevel]) s.level.clear();
    if (!has_value_[kLight]) s.light.clear();
    if (!has_value_[kVigour]) s.vigour.clear();
    for (std::size_t root = 0; root < layout.root_count; ++root) {
      if (!s.birth_step.empty()) s.birth_step[root] = 0;
      if (!s.shed_step.empty()) s.shed_step[root] = kAlive;
    }
  }

  const std::string& name_;
  TextTable table_;
  std::array<std::optional<std::size_t>, kColumnCount> place_{};
  std::array<bool, kColumnCount> has_value_{};
  RowLinks links_;
  std::vector<Vec3> start_;
  Skeleton rows_;  // one entry a row, without parents
};

}  // namespace

void write_skeleton_table(const Skeleton& skeleton, std::ostream& out) {
  Buffer rows;
  fmt::format_to(std::back_inserter(rows), "{}\n", fmt::join(kColumnNames, ","));
  const std::size_t roots = skeleton.root_count();
  for (std::size_t node = roots; node < skeleton.node_count(); ++node) {
    put_row(rows, skeleton, node, roots);
    if (rows.size() < kChunk) continue;
    out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
    rows.clear();
  }
  out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

Skeleton read_skeleton_table(const std::string& text, const std::string& name) {
  Skeleton skeleton = TableReader(text, name).read();
  const std::vector<std::string> problems = violations(skeleton, 1);
  if (!problems.empty()) throw InputError(fmt::format("{}: {}", name, problems.front()));
  return skeleton;
}

}  // namespace ramify
