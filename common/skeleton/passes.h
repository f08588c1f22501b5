// Passes over a skeleton: one loop forward or backward each, O(n), no recursion.
#pragma once

#include <cstdint>
#include <vector>

#include "common/skeleton/skeleton.h"

namespace ramify {

/// Sets `axis` and `order` from the widths: at each node the continuation is the child with the greatest
/// diameter, then the greatest length of its subtree, then the lower index; every other child founds an axis
/// of order + 1. Axes are numbered in the order of their first internodes.
void assign_axes(Skeleton& skeleton);

/// The same, where a child goes on as its parent's axis only if both have the same number in `run`, one a
/// node: of measured trees, where the branch or the branch order is known. Orders are counted, a lateral's is
/// its parent's + 1.
void assign_axes_along(Skeleton& skeleton, const std::vector<std::int64_t>& run);

/// Sets `order` from `axis` alone: 0 for the axes that start at a root node and go on as its axis, a
/// lateral's is its parent's + 1.
void assign_orders(Skeleton& skeleton);

/// Strahler's order of each node: a tip has 1; elsewhere the maximum over the children, + 1 if at least two
/// children have it (Horton 1945, Strahler 1952).
std::vector<std::uint16_t> strahler_orders(const Skeleton& skeleton);

/// Sets `diameter` by the pipe model (Shinozaki et al. 1964; Palubicki et al. 2009, 4.4) over all nodes of
/// the skeleton, shed ones included: a branch never gets thinner. A root node is as wide as its children
/// together. `lost_tips`, if given, has one entry a node: tips of children that are no longer in the
/// skeleton. Remembers the model in the skeleton. Throws InputError if model.exponent <= 0.
void assign_pipe_diameters(Skeleton& skeleton, const PipeModel& model,
                           const std::vector<std::uint32_t>& lost_tips = {});

/// The tree as it stood after `step`: internodes born by then and not yet shed, with the widths of that step
/// where the pipe model made them. Light and vigour, the last step's, are left out. `with_shed` keeps those
/// that had been shed by then. Needs birth_step.
Skeleton cut_at_step(const Skeleton& history, std::uint32_t step, bool with_shed = false);

/// What a path-planned tree has of the levels up to `level`, with the widths of the whole tree. Needs
/// Skeleton::level.
Skeleton cut_at_level(const Skeleton& skeleton, std::uint32_t level);

/// The last step in which something grew or was shed or, of a tree without steps, its last level; 0 where the
/// tree has neither.
std::uint32_t last_step(const Skeleton& skeleton);

/// cut_at_step() or, of a tree without steps, cut_at_level(). Needs birth_step or level.
Skeleton cut_at(const Skeleton& skeleton, std::uint32_t step);

/// The living part of a history, light and vigour kept.
Skeleton living(const Skeleton& history);

}  // namespace ramify
