#include "common/skeleton/skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace ramify {
namespace {

template <class T>
std::vector<T> picked(const std::vector<T>& values, const std::vector<std::uint32_t>& nodes) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(nodes.size());
  for (const std::uint32_t node : nodes) result.push_back(values[node]);
  return result;
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Collects sentences up to a limit.
class Findings {
 public:
  explicit Findings(std::size_t limit) : limit_(limit) {}
  template <class... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    if (!full()) sentences_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  bool full() const { return sentences_.size() >= limit_; }
  bool any() const { return !sentences_.empty(); }
  std::vector<std::string> take() { return std::move(sentences_); }

 private:
  std::size_t limit_;
  std::vector<std::string> sentences_;
};

void check_sizes(const Skeleton& s, Findings& found) {
  const std::size_t count = s.node_count();
  const auto check = [&](const char* name, std::size_t size, bool may_be_empty) {
    if (size == count || (may_be_empty && size == 0)) return;
    found.add("skeleton: {} has {} entries (one a node: {})", name, size, count);
  };
  check("parent", s.parent.size(), false);
  check("diameter", s.diameter.size(), false);
  check("axis", s.axis.size(), false);
  check("order", s.order.size(), false);
  check("kind", s.kind.size(), false);
  check("birth_step", s.birth_step.size(), true);
  check("shed_step", s.shed_step.size(), true);
  check("level", s.level.size(), true);
  check("light", s.light.size(), true);
  check("vigour", s.vigour.size(), true);
  for (const auto& [name, values] : s.channels) check(name.c_str(), values.size(), false);
}

void check_node(const Skeleton& s, std::size_t node, std::size_t roots, Findings& found) {
  if (!is_finite(s.position[node])) found.add("skeleton node {}: position is not finite", node);
  if (!std::isfinite(s.diameter[node]) || s.diameter[node] <= 0) {
    found.add("skeleton node {}: diameter {} (must be greater than 0)", node, s.diameter[node]);
  }
  if (node < roots) return;

  const std::uint32_t parent = s.parent[node];
  if (parent == kNoParent) {
    found.add("skeleton node {}: a root after internodes (roots come first)", node);
    return;
  }
  if (parent >= node) {
    found.add("skeleton node {}: parent {} is not before it (nodes follow their parent)", node, parent);
    return;
  }
  if (parent >= roots && s.axis[node] != s.axis[parent] && s.order[node] == 0) {
    found.add("skeleton node {}: order 0 on a lateral axis (only the trunk has order 0)", node);
  }
  if (s.axis[node] == s.axis[parent] && s.order[node] != s.order[parent]) {
    found.add("skeleton node {}: order {} on an axis of order {} (one order an axis)", node, s.order[node],
              s.order[parent]);
  }
  if (!s.birth_step.empty() && s.birth_step[node] < s.birth_step[parent]) {
    found.add("skeleton node {}: born at step {}, before its parent {} at step {}", node, s.birth_step[node],
              parent, s.birth_step[parent]);
  }
  if (s.is_shed(parent) && (!s.is_shed(node) || s.shed_step[node] > s.shed_step[parent])) {
    found.add("skeleton node {}: outlives its parent {}, shed at step {}", node, parent, s.shed_step[parent]);
  }
}

/// An axis is a chain: no node has two children on its own axis.
void check_chains(const Skeleton& s, std::size_t roots, Findings& found) {
  std::vector<bool> continued(s.node_count(), false);
  for (std::size_t node = roots; node < s.node_count(); ++node) {
    const std::uint32_t parent = s.parent[node];
    if (s.axis[node] != s.axis[parent]) continue;
    if (continued[parent]) {
      found.add("skeleton node {}: a second continuation of axis {} at node {} (an axis is a chain)", node,
                s.axis[node], parent);
    }
    continued[parent] = true;
  }
}

}  // namespace

std::size_t Skeleton::root_count() const {
  const auto first =
      std::find_if(parent.begin(), parent.end(), [](std::uint32_t p) { return p != kNoParent; });
  return static_cast<std::size_t>(first - parent.begin());
}

std::size_t Skeleton::axis_count() const {
  // An internode founds an axis where its parent is a root or of another axis; a root node's axis is the
  // trunk's, which is counted at its first internode.
  std::unordered_set<std::uint32_t> axes;
  for (std::size_t node = root_count(); node < node_count(); ++node) {
    if (is_root(parent[node]) || axis[node] != axis[parent[node]]) axes.insert(axis[node]);
  }
  return axes.size();
}

double Skeleton::start_radius(std::size_t node) const {
  const auto channel = channels.find(kStartRadius);
  if (channel != channels.end()) return channel->second[node];
  const bool founds_axis = is_root(parent[node]) || axis[node] != axis[parent[node]];
  return 0.5 * diameter[founds_axis ? node : parent[node]];
}

Skeleton gathered(const Skeleton& skeleton, const std::vector<std::uint32_t>& nodes) {
  Skeleton result;
  result.position = picked(skeleton.position, nodes);
  result.diameter = picked(skeleton.diameter, nodes);
  result.axis = picked(skeleton.axis, nodes);
  result.order = picked(skeleton.order, nodes);
  result.kind = picked(skeleton.kind, nodes);
  result.birth_step = picked(skeleton.birth_step, nodes);
  result.shed_step = picked(skeleton.shed_step, nodes);
  result.level = picked(skeleton.level, nodes);
  result.light = picked(skeleton.light, nodes);
  result.vigour = picked(skeleton.vigour, nodes);
  for (const auto& [name, values] : skeleton.channels) result.channels[name] = picked(values, nodes);
  result.pipe_model = skeleton.pipe_model;
  return result;
}

Skeleton subset(const Skeleton& skeleton, const std::vector<bool>& keep) {
  std::vector<std::uint32_t> nodes;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    if (keep[node]) nodes.push_back(static_cast<std::uint32_t>(node));
  }
  Skeleton result = gathered(skeleton, nodes);

  std::vector<std::uint32_t> renumbered(skeleton.node_count(), kNoParent);
  std::uint32_t next = 0;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    if (!keep[node]) continue;
    renumbered[node] = next++;
    result.parent.push_back(skeleton.is_root(node) ? kNoParent : renumbered[skeleton.parent[node]]);
  }
  return result;
}

Skeleton joined(const std::vector<Skeleton>& trees) {
  if (trees.empty()) return {};
  // Where each tree's nodes go: roots to the front, the others behind all roots.
  std::size_t next_root = 0;
  std::size_t next = 0;
  for (const Skeleton& tree : trees) next += tree.root_count();
  std::vector<std::vector<std::uint32_t>> new_index(trees.size());
  for (std::size_t i = 0; i < trees.size(); ++i) {
    for (std::size_t node = 0; node < trees[i].node_count(); ++node) {
      new_index[i].push_back(static_cast<std::uint32_t>(trees[i].is_root(node) ? next_root++ : next++));
    }
  }

  Skeleton result;
  const auto put = [&](auto column_of, const auto& value) {
    auto& target = column_of(result);
    target.resize(column_of(trees.front()).empty() ? 0 : next);
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const auto& source = column_of(trees[i]);
      for (std::size_t node = 0; node < source.size(); ++node) {
        target[new_index[i][node]] = value(i, source[node]);
      }
    }
  };
  const auto same = [](std::size_t, const auto& value) { return value; };
  const auto count = static_cast<std::uint32_t>(trees.size());
  put(
      [](auto& s) -> auto& { return s.position; }, same);
  put(
      [](auto& s) -> auto& { return s.parent; },
      [&](std::size_t i, std::uint32_t parent) {
        return parent == kNoParent ? parent : new_index[i][parent];
      });
  put(
      [](auto& s) -> auto& { return s.diameter; }, same);
  put(
      [](auto& s) -> auto& { return s.axis; },
      [&](std::size_t i, std::uint32_t axis) { return axis * count + static_cast<std::uint32_t>(i); });
  put(
      [](auto& s) -> auto& { return s.order; }, same);
  put(
      [](auto& s) -> auto& { return s.kind; }, same);
  put(
      [](auto& s) -> auto& { return s.birth_step; }, same);
  put(
      [](auto& s) -> auto& { return s.shed_step; }, same);
  put(
      [](auto& s) -> auto& { return s.level; }, same);
  put(
      [](auto& s) -> auto& { return s.light; }, same);
  put(
      [](auto& s) -> auto& { return s.vigour; }, same);
  for (const auto& [name, values] : trees.front().channels) {
    put(
        [&name = name](auto& s) -> auto& {
          if constexpr (std::is_const_v<std::remove_reference_t<decltype(s)>>) {
            return s.channels.at(name);
          } else {
            return s.channels[name];
          }
        },
        same);
  }
  result.pipe_model = trees.front().pipe_model;
  return result;
}

std::vector<std::string> violations(const Skeleton& skeleton, std::size_t limit) {
  Findings found(limit);
  check_sizes(skeleton, found);
  if (found.any()) return found.take();
  if (skeleton.node_count() == 0) {
    found.add("skeleton: no nodes (there is at least a root)");
    return found.take();
  }
  const std::size_t roots = skeleton.root_count();
  if (roots == 0) found.add("skeleton: node 0 has a parent (roots come first)");
  for (std::size_t node = 0; node < skeleton.node_count() && !found.full(); ++node) {
    check_node(skeleton, node, roots, found);
  }
  if (!found.any()) check_chains(skeleton, roots, found);
  return found.take();
}

}  // namespace ramify
