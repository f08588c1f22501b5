#include "common/format/row_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "common/base/errors.h"

namespace ramify {
namespace {

[[noreturn]] void fail(const std::string& file, std::size_t line, const std::string& problem) {
  throw InputError(fmt::format("{}:{}: {}", file, line, problem));
}

}  // namespace

void RowLinks::add(std::int64_t row_id, std::int64_t row_parent, std::size_t row_line) {
  id.push_back(row_id);
  parent.push_back(row_parent);
  line.push_back(row_line);
}

std::vector<std::uint32_t> parent_rows(const RowLinks& links, const std::string& file) {
  // Sorted, not hashed: a file may choose its numbers so that they all collide.
  using Numbered = std::pair<std::int64_t, std::uint32_t>;
  std::vector<Numbered> rows;
  for (std::size_t i = 0; i < links.id.size(); ++i) {
    rows.emplace_back(links.id[i], static_cast<std::uint32_t>(i));
  }
  std::sort(rows.begin(), rows.end());
  const auto twin = std::adjacent_find(
      rows.begin(), rows.end(), [](const Numbered& a, const Numbered& b) { return a.first == b.first; });
  if (twin != rows.end()) {
    fail(file, links.line[(twin + 1)->second],
         fmt::format("{}: {} stands in line {} too", links.id_name, twin->first, links.line[twin->second]));
  }

  std::vector<std::uint32_t> parents(links.id.size(), kNoParent);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (links.parent[i] == links.no_parent) continue;
    const auto found = std::lower_bound(rows.begin(), rows.end(), Numbered{links.parent[i], 0});
    if (found == rows.end() || found->first != links.parent[i]) {
      fail(file, links.line[i],
           fmt::format("{}: {} is no row's {} ({} for none)", links.parent_name, links.parent[i],
                       links.id_name, links.no_parent));
    }
    parents[i] = found->second;
  }
  return parents;
}

std::vector<std::uint32_t> parents_first(const RowLinks& links, std::span<const std::uint32_t> parents,
                                         const std::string& file) {
  enum class State : std::uint8_t { waiting, asked_for, placed };
  std::vector<State> state(parents.size(), State::waiting);
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> ancestors;  // that must be placed before the row at hand
  for (std::uint32_t first = 0; first < parents.size(); ++first) {
    for (std::uint32_t row = first; row != kNoParent && state[row] != State::placed; row = parents[row]) {
      if (state[row] == State::asked_for) {
        fail(file, links.line[row],
             fmt::format("{}: {} leads round to this row (a tree has no circle)", links.parent_name,
                         links.parent[row]));
      }
      state[row] = State::asked_for;
      ancestors.push_back(row);
    }
    for (; !ancestors.empty(); ancestors.pop_back()) {
      state[ancestors.back()] = State::placed;
      order.push_back(ancestors.back());
    }
  }
  return order;
}

NodeLayout lay_out(const RowLinks& links, std::span<const Vec3> start, const std::string& file) {
  if (links.id.empty()) throw InputError(fmt::format("{}: no internodes", file));
  const std::vector<std::uint32_t> parents = parent_rows(links, file);
  const std::vector<std::uint32_t> order = parents_first(links, parents, file);

  NodeLayout layout;
  std::vector<std::uint32_t> node_before(order.size());  // of each row: its parent's node, or its root's
  std::map<std::array<double, 3>, std::uint32_t> roots;
  for (const std::uint32_t row : order) {
    if (parents[row] != kNoParent) continue;
    const Vec3& p = start[row];
    const auto next = static_cast<std::uint32_t>(roots.size());
    const auto [entry, is_new] = roots.try_emplace({p.x, p.y, p.z}, next);
    if (is_new) layout.row.push_back(row);
    node_before[row] = entry->second;
  }
  layout.root_count = layout.row.size();
  layout.parent.assign(layout.root_count, kNoParent);

  std::vector<std::uint32_t> node_of(order.size());
  for (const std::uint32_t row : order) {
    node_of[row] = static_cast<std::uint32_t>(layout.row.size());
    layout.row.push_back(row);
    layout.parent.push_back(parents[row] == kNoParent ? node_before[row] : node_of[parents[row]]);
  }
  return layout;
}

}  // namespace ramify
