#include "common/format/swc.h"

#include <fmt/format.h>

#include <array>
#include <ostream>
#include <vector>

#include "common/base/errors.h"
#include "common/format/row_links.h"
#include "common/format/text_table.h"
#include "common/skeleton/passes.h"

namespace ramify {
namespace {

constexpr int kRootType = 1;
constexpr int kFirstType = 16;  // of branchOrder 0; those below are named by the standard
constexpr std::size_t kChunk = 1 << 16;

enum Column { kId, kType, kX, kY, kZ, kRadius, kParent, kColumnCount };
constexpr std::array<std::string_view, kColumnCount> kNames = {"id", "type",   "x",     "y",
                                                               "z",  "radius", "parent"};

/// Samples as they stand, one entry a row.
class SwcReader {
 public:
  SwcReader(std::string_view text, const std::string& name) : text_(without_mark(text)), name_(name) {
    links_.id_name = kNames[kId];
    links_.parent_name = kNames[kParent];
  }

  Skeleton read() {
    while (!text_.empty()) {
      const std::string_view line = trimmed(next_line(text_));
      ++line_;
      if (!line.empty() && line.front() != '#') read_row(line);
    }
    if (links_.id.empty()) throw InputError(fmt::format("{}: no nodes", name_));
    return skeleton();
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line_, problem));
  }

  /// Seven words; what follows them, as some programs write it, is not looked at.
  void split(std::string_view line) {
    for (std::size_t i = 0; i < kColumnCount; ++i) {
      const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
      cells_[i] = line.substr(0, end);
      if (cells_[i].empty()) fail(fmt::format("{} numbers (id type x y z radius parent)", i));
      line = trimmed(line.substr(end));
    }
  }

  double number(Column column) const {
    const std::optional<double> value = finite_number(cells_[column]);
    if (!value) fail(fmt::format("{}: '{}' is no finite number", kNames[column], shown(cells_[column])));
    return *value;
  }

  std::int64_t whole(Column column) const {
    const std::optional<std::int64_t> value = whole_number(cells_[column]);
    if (!value) fail(fmt::format("{}: '{}' is no whole number", kNames[column], shown(cells_[column])));
    return *value;
  }

  void read_row(std::string_view line) {
    split(line);
    links_.add(whole(kId), whole(kParent), line_);
    type_.push_back(whole(kType));
    position_.push_back({number(kX), number(kY), number(kZ)});
    const double radius = number(kRadius);
    if (!(radius > 0)) fail(fmt::format("radius: {} (must be greater than 0)", radius));
    diameter_.push_back(2.0 * radius);
  }

  Skeleton skeleton() const {
    const std::vector<std::uint32_t> parents = parent_rows(links_, name_);
    const std::vector<std::uint32_t> order = parents_first(links_, parents, name_);
    std::vector<std::uint32_t> rows;  // of each node: roots to the front
    for (const bool wants_roots : {true, false}) {
      for (const std::uint32_t row : order) {
        if ((parents[row] == kNoParent) == wants_roots) rows.push_back(row);
      }
    }
    std::vector<std::uint32_t> node_of(rows.size());
    Skeleton s;
    std::vector<std::int64_t> run;
    bool has_orders = true;
    for (std::uint32_t node = 0; node < rows.size(); ++node) {
      const std::uint32_t row = rows[node];
      const bool is_root = parents[row] == kNoParent;
      node_of[row] = node;
      s.position.push_back(position_[row]);
      s.parent.push_back(is_root ? kNoParent : node_of[parents[row]]);
      s.diameter.push_back(diameter_[row]);
      s.kind.push_back(Kind::stem);
      run.push_back(is_root ? kFirstType : type_[row]);
      has_orders = has_orders && run.back() >= kFirstType;
    }
    if (has_orders) {
      assign_axes_along(s, run);
    } else {
      assign_axes(s);
    }
    return s;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t line_ = 0;
  std::array<std::string_view, kColumnCount> cells_;
  RowLinks links_;
  std::vector<std::int64_t> type_;
  std::vector<Vec3> position_;
  std::vector<double> diameter_;
};

}  // namespace

void write_swc(const Skeleton& skeleton, const std::optional<Provenance>& provenance, std::ostream& out) {
  fmt::memory_buffer rows;
  fmt::format_to(std::back_inserter(rows), "# metres, +Y up; types: {} root, {} + branchOrder\n", kRootType,
                 kFirstType);
  if (provenance) {
    fmt::format_to(std::back_inserter(rows), "# ramify {}: engine {}, seed {}, steps {}. The config:\n",
                   provenance->version, provenance->engine, provenance->seed, provenance->steps);
    std::string_view config = provenance->config;
    while (!config.empty()) fmt::format_to(std::back_inserter(rows), "#   {}\n", next_line(config));
  }
  fmt::format_to(std::back_inserter(rows), "# {}\n", fmt::join(kNames, " "));
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    const bool is_root = skeleton.is_root(node);
    const Vec3& p = skeleton.position[node];
    fmt::format_to(std::back_inserter(rows), "{} {} {} {} {} {} {}\n", node + 1,
                   is_root ? kRootType : kFirstType + skeleton.order[node], p.x, p.y, p.z,
                   0.5 * skeleton.diameter[node],
                   is_root ? std::int64_t{-1} : static_cast<std::int64_t>(skeleton.parent[node]) + 1);
    if (rows.size() < kChunk) continue;
    out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
    rows.clear();
  }
  out.write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

Skeleton read_swc(std::string_view text, const std::string& name) {
  return SwcReader(text, name).read();
}

}  // namespace ramify
