#include "common/format/skeleton_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <ostream>
#include <string_view>

#include "common/base/errors.h"

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

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Cuts the next line off `text`.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  return line;
}

void split(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line = line.substr(comma + 1);
  }
}

/// One pass over a table's rows into a skeleton whose roots are moved to the front at the end.
class TableReader {
 public:
  TableReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Skeleton read() {
    read_header();
    while (!text_.empty()) {
      const std::string_view line = next_line(text_);
      ++line_number_;
      if (trimmed(line).empty()) continue;
      split(line, cells_);
      if (cells_.size() != width_) fail(fmt::format("{} cells (the header has {})", cells_.size(), width_));
      read_row();
    }
    if (rows_.position.empty()) throw InputError(fmt::format("{}: no internodes", name_));
    return with_roots();
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_number_, problem));
  }

  void read_header() {
    line_number_ = 1;
    split(next_line(text_), cells_);
    width_ = cells_.size();
    for (std::size_t column = 0; column < kColumnCount; ++column) {
      const auto found = std::find(cells_.begin(), cells_.end(), kColumnNames[column]);
      if (found != cells_.end()) place_[column] = static_cast<std::size_t>(found - cells_.begin());
    }
    for (const Column column :
         {kId, kParentId, kStartX, kStartY, kStartZ, kEndX, kEndY, kEndZ, kRadius, kBranchId, kBranchOrder}) {
      if (!place_[column]) {
        fail(fmt::format("no column '{}' (a skeleton table begins {},{},{},...)", kColumnNames[column],
                         kColumnNames[kId], kColumnNames[kParentId], kColumnNames[kStartX]));
      }
    }
  }

  std::string_view cell(Column column) const { return place_[column] ? cells_[*place_[column]] : ""; }

  template <class T>
  T value(Column column) const {
    const std::string_view text = cell(column);
    T result{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    bool is_number = error == std::errc{} && end == text.data() + text.size();
    if constexpr (std::is_floating_point_v<T>) is_number = is_number && std::isfinite(result);
    if (!is_number)
      fail(fmt::format("{}: '{}' is no {}", kColumnNames[column], text,
                       std::is_floating_point_v<T> ? "finite number" : "whole number in range"));
    return result;
  }

  /// A column that may be missing or have empty cells.
  template <class T>
  void read_optional(Column column, std::vector<T>& values, T missing) {
    const bool is_empty = cell(column).empty();
    if (!is_empty) has_value_[column] = true;
    values.push_back(is_empty ? missing : value<T>(column));
  }

  void read_row() {
    const auto id = value<std::int64_t>(kId);
    const auto parent = value<std::int64_t>(kParentId);
    const std::size_t row = rows_.position.size();
    if (!row_of_.emplace(id, row).second) fail(fmt::format("ID: {} stands in an earlier row too", id));
    if (parent == -1) {
      rows_.parent.push_back(kNoParent);
    } else {
      const auto found = row_of_.find(parent);
      if (found == row_of_.end() || found->second == row) {
        fail(
            fmt::format("parentID: {} is in no earlier row (rows follow their parent; -1 for none)", parent));
      }
      rows_.parent.push_back(static_cast<std::uint32_t>(found->second));
    }
    start_.push_back({value<double>(kStartX), value<double>(kStartY), value<double>(kStartZ)});
    rows_.position.push_back({value<double>(kEndX), value<double>(kEndY), value<double>(kEndZ)});
    const auto radius = value<double>(kRadius);
    if (!(radius > 0)) fail(fmt::format("radius: {} (must be greater than 0)", radius));
    rows_.diameter.push_back(2.0 * radius);
    rows_.axis.push_back(value<std::uint32_t>(kBranchId));
    rows_.order.push_back(value<std::uint16_t>(kBranchOrder));
    read_optional(kBirthStep, rows_.birth_step, std::uint32_t{0});
    read_optional(kShedStep, rows_.shed_step, kAlive);
    read_optional(kLevel, rows_.level, std::uint16_t{0});
    read_optional(kLight, rows_.light, 0.0f);
    read_optional(kVigour, rows_.vigour, 0.0f);
    const std::string_view kind = cell(kKind);
    if (kind != "" && kind != "stem" && kind != "root") fail(fmt::format("kind: '{}' (stem | root)", kind));
    rows_.kind.push_back(kind == "root" ? Kind::root : Kind::stem);
  }

  /// The rows behind a node for each point that parentless rows start from.
  Skeleton with_roots() {
    std::vector<std::size_t> first_row;  // of each root
    std::vector<std::uint32_t> root_of(rows_.position.size(), 0);
    std::map<std::array<double, 3>, std::uint32_t> roots;
    for (std::size_t row = 0; row < rows_.position.size(); ++row) {
      if (rows_.parent[row] != kNoParent) continue;
      const Vec3& p = start_[row];
      const auto [entry, is_new] =
          roots.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(roots.size()));
      if (is_new) first_row.push_back(row);
      root_of[row] = entry->second;
    }

    Skeleton result;
    for (const std::size_t row : first_row) append(result, row, kNoParent, start_[row]);
    const auto count = static_cast<std::uint32_t>(first_row.size());
    for (std::size_t row = 0; row < rows_.position.size(); ++row) {
      const bool is_at_root = rows_.parent[row] == kNoParent;
      append(result, row, is_at_root ? root_of[row] : rows_.parent[row] + count, rows_.position[row]);
      if (is_at_root) {
        double& widest = result.diameter[root_of[row]];
        widest = std::max(widest, rows_.diameter[row]);
      }
    }
    clear_root_steps(result, count);
    return result;
  }

  void append(Skeleton& s, std::size_t row, std::uint32_t parent, const Vec3& position) const {
    s.position.push_back(position);
    s.parent.push_back(parent);
    s.diameter.push_back(rows_.diameter[row]);
    s.axis.push_back(rows_.axis[row]);
    s.order.push_back(rows_.order[row]);
    s.kind.push_back(rows_.kind[row]);
    if (has_value_[kBirthStep]) s.birth_step.push_back(rows_.birth_step[row]);
    if (has_value_[kBirthStep] || has_value_[kShedStep]) s.shed_step.push_back(rows_.shed_step[row]);
    if (has_value_[kLevel]) s.level.push_back(rows_.level[row]);
    if (has_value_[kLight]) s.light.push_back(rows_.light[row]);
    if (has_value_[kVigour]) s.vigour.push_back(rows_.vigour[row]);
  }

  static void clear_root_steps(Skeleton& s, std::uint32_t roots) {
    for (std::uint32_t root = 0; root < roots; ++root) {
      if (!s.birth_step.empty()) s.birth_step[root] = 0;
      if (!s.shed_step.empty()) s.shed_step[root] = kAlive;
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t line_number_ = 0;
  std::size_t width_ = 0;
  std::vector<std::string_view> cells_;
  std::array<std::optional<std::size_t>, kColumnCount> place_{};
  std::array<bool, kColumnCount> has_value_{};
  std::map<std::int64_t, std::size_t> row_of_;
  std::vector<Vec3> start_;
  Skeleton rows_;  // without root nodes: parents are rows
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
