// The tree that both engines make and everything after them reads: nodes with a parent each, as a structure
// of arrays. An internode is a node that has a parent; it runs from the parent's position to its own.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/geometry.h"

namespace ramify {

enum class Kind : std::uint8_t { stem, root };

inline constexpr std::uint32_t kNoParent = 0xffffffff;
inline constexpr std::uint32_t kAlive = 0;  // a shed_step of 0: steps count from 1

/// The channel of a skeleton made of cylinders, as laser-scanned trees are: the radius with which each
/// internode starts, metres.
inline constexpr const char* kStartRadius = "start_radius";

/// How an engine's widths were made, where by the pipe model: d^exponent = sum of the children's d^exponent.
struct PipeModel {
  double exponent = 2.5;
  double tip_diameter = 0.01;  // of an internode that never bore another, metres
};

/// Root nodes come first, then every node after its parent: a loop forward goes from the roots to the tips,
/// a loop backward from the tips to the roots. Arrays have one entry a node, or none where an engine has
/// nothing to say (birth_step, shed_step, level, light, vigour).
struct Skeleton {
  std::vector<Vec3> position;         // metres; of an internode, where it ends
  std::vector<std::uint32_t> parent;  // kNoParent for a root node
  std::vector<double> diameter;       // metres, at the node
  std::vector<std::uint32_t> axis;    // the name of the axis the internode belongs to
  std::vector<std::uint16_t> order;   // of the axis; 0 is the trunk
  std::vector<Kind> kind;
  std::vector<std::uint32_t> birth_step;  // growth: the step that made the internode; 0 for roots
  std::vector<std::uint32_t> shed_step;   // growth: the step that shed it, or kAlive
  std::vector<std::uint16_t> level;       // pathplan: the level of the graph that made it, from 1
  std::vector<float> light;               // growth: light exposure Q of the internode's subtree, last step
  std::vector<float> vigour;              // growth: resource v that entered it, last step
  std::map<std::string, std::vector<double>> channels;  // more attributes, by name

  std::optional<PipeModel> pipe_model;  // set if diameters follow it over the history

  std::size_t node_count() const { return position.size(); }
  std::size_t root_count() const;
  std::size_t internode_count() const { return node_count() - root_count(); }
  std::size_t axis_count() const;
  bool is_root(std::size_t node) const { return parent[node] == kNoParent; }
  bool is_shed(std::size_t node) const { return !shed_step.empty() && shed_step[node] != kAlive; }

  /// Of an internode: from its parent to itself, metres.
  Vec3 along(std::size_t node) const { return position[node] - position[parent[node]]; }
  double length(std::size_t node) const { return glm::length(along(node)); }
  /// Of an internode, metres: its start_radius where that channel is; else its parent's, but its own where it
  /// founds an axis or starts at a root, whose width no table knows.
  double start_radius(std::size_t node) const;
};

/// The part of `skeleton` for which keep[node] is true, in the same order, all attributes with it. A kept
/// node's parent must be kept. O(n).
Skeleton subset(const Skeleton& skeleton, const std::vector<bool>& keep);

/// All attributes but `parent`, which is left empty, of nodes[i] as those of node i. O(n).
Skeleton gathered(const Skeleton& skeleton, const std::vector<std::uint32_t>& nodes);

/// Several trees as one: all root nodes first, then the internodes tree by tree. Axis j of tree i of n
/// becomes axis j * n + i. All must have the same attributes. O(n).
Skeleton joined(const std::vector<Skeleton>& trees);

/// What is wrong with the skeleton, one sentence each, naming index, value and limit; empty if it is sound.
/// Stops after `limit` sentences. O(n).
std::vector<std::string> violations(const Skeleton& skeleton, std::size_t limit = 10);

}  // namespace ramify
