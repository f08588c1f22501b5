#include "common/analysis/anatomy.h"

namespace ramify {

Anatomy::Anatomy(const Skeleton& skeleton) : skeleton_(skeleton) {
  const std::size_t count = skeleton.node_count();
  const std::size_t roots = skeleton.root_count();

  child_ = grouped(skeleton.parent, roots, count);
  axis_of_.assign(count, kNoParent);
  path_lengths_.assign(count, 0.0);
  root_of_.resize(count);
  std::uint32_t axes = 0;
  for (std::size_t node = 0; node < count; ++node) {
    if (node < roots) {
      root_of_[node] = static_cast<std::uint32_t>(node);
      continue;
    }
    const std::uint32_t parent = skeleton.parent[node];
    const bool continues = parent >= roots && skeleton.axis[node] == skeleton.axis[parent];
    axis_of_[node] = continues ? axis_of_[parent] : axes++;
    path_lengths_[node] = path_lengths_[parent] + skeleton.length(node);
    root_of_[node] = root_of_[parent];
    if (children(node).empty()) tips_.push_back(static_cast<std::uint32_t>(node));
  }
  axis_ = grouped(axis_of_, roots, axes);
}

std::uint32_t Anatomy::bearer(std::size_t index) const {
  const std::uint32_t parent = skeleton_.parent[axis(index).front()];
  return skeleton_.is_root(parent) ? kNoParent : parent;
}

Anatomy::Lists Anatomy::grouped(std::span<const std::uint32_t> key, std::size_t begin, std::size_t lists) {
  Lists result;
  result.first.assign(lists + 1, 0);
  for (std::size_t node = begin; node < key.size(); ++node) ++result.first[key[node] + 1];
  for (std::size_t list = 0; list < lists; ++list) result.first[list + 1] += result.first[list];
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  result.nodes.resize(result.first.back());
  for (std::size_t node = begin; node < key.size(); ++node) {
    result.nodes[next[key[node]]++] = static_cast<std::uint32_t>(node);
  }
  return result;
}

}  // namespace ramify
