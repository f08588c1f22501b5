#include "common/skeleton/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/base/errors.h"

namespace ramify {
namespace {

/// Length of all internodes from each node on, its own included; metres.
std::vector<double> subtree_lengths(const Skeleton& skeleton) {
  std::vector<double> lengths(skeleton.node_count(), 0.0);
  for (std::size_t node = skeleton.node_count(); node-- > 0;) {
    if (skeleton.is_root(node)) continue;
    lengths[node] += skeleton.length(node);
    lengths[skeleton.parent[node]] += lengths[node];
  }
  return lengths;
}

/// Sets axis and order: of a node's children for which may_continue(child) holds, one goes on as its axis.
template <class MayContinue>
void assign_axes_where(Skeleton& skeleton, MayContinue may_continue) {
  const std::size_t count = skeleton.node_count();
  const std::vector<double> length = subtree_lengths(skeleton);
  std::vector<std::uint32_t> continuation(count, kNoParent);
  for (std::size_t node = 0; node < count; ++node) {
    if (skeleton.is_root(node) || !may_continue(node)) continue;
    std::uint32_t& best = continuation[skeleton.parent[node]];
    const bool leads = best == kNoParent || skeleton.diameter[node] > skeleton.diameter[best] ||
                       (skeleton.diameter[node] == skeleton.diameter[best] && length[node] > length[best]);
    if (leads) best = static_cast<std::uint32_t>(node);
  }

  skeleton.axis.assign(count, 0);
  skeleton.order.assign(count, 0);
  std::uint32_t next_axis = 0;
  for (std::size_t node = 0; node < count; ++node) {
    if (skeleton.is_root(node)) {
      skeleton.axis[node] = next_axis++;
      continue;
    }
    const std::uint32_t parent = skeleton.parent[node];
    const bool continues = continuation[parent] == node;
    skeleton.axis[node] = continues ? skeleton.axis[parent] : next_axis++;
    skeleton.order[node] = static_cast<std::uint16_t>(skeleton.order[parent] + (continues ? 0 : 1));
  }
}

}  // namespace

void assign_axes(Skeleton& skeleton) {
  assign_axes_where(skeleton, [](std::size_t) { return true; });
}

void assign_axes_along(Skeleton& skeleton, const std::vector<std::int64_t>& run) {
  assign_axes_where(skeleton, [&](std::size_t node) { return run[node] == run[skeleton.parent[node]]; });
}

void assign_orders(Skeleton& skeleton) {
  skeleton.order.assign(skeleton.node_count(), 0);
  for (std::size_t node = skeleton.root_count(); node < skeleton.node_count(); ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    const bool continues = skeleton.axis[node] == skeleton.axis[parent];
    skeleton.order[node] = static_cast<std::uint16_t>(skeleton.order[parent] + (continues ? 0 : 1));
  }
}

std::vector<std::uint16_t> strahler_orders(const Skeleton& skeleton) {
  const std::size_t count = skeleton.node_count();
  std::vector<std::uint16_t> highest(count, 0);  // among the children
  std::vector<bool> is_shared(count, false);     // by at least two of them
  std::vector<std::uint16_t> order(count, 0);
  for (std::size_t node = count; node-- > 0;) {
    order[node] = static_cast<std::uint16_t>(std::max<int>(1, highest[node] + (is_shared[node] ? 1 : 0)));
    if (skeleton.is_root(node)) continue;
    const std::uint32_t parent = skeleton.parent[node];
    if (order[node] == highest[parent]) is_shared[parent] = true;
    if (order[node] > highest[parent]) {
      highest[parent] = order[node];
      is_shared[parent] = false;
    }
  }
  return order;
}

void assign_pipe_diameters(Skeleton& skeleton, const PipeModel& model,
                           const std::vector<std::uint32_t>& lost_tips) {
  if (!(model.exponent > 0)) {
    throw InputError(fmt::format("pipe model: exponent {} (must be greater than 0)", model.exponent));
  }
  // In units of a tip's d^n the sums are counts of the tips ever borne: whole numbers, so exact in any order.
  std::vector<std::uint32_t> tips = lost_tips;
  tips.resize(skeleton.node_count(), 0);
  for (std::size_t node = skeleton.node_count(); node-- > 0;) {
    tips[node] = std::max<std::uint32_t>(tips[node], 1);
    if (!skeleton.is_root(node)) tips[skeleton.parent[node]] += tips[node];
  }
  const auto diameter_of = [&](double count) {
    return model.tip_diameter * std::pow(count, 1.0 / model.exponent);
  };
  // Most nodes bear few.
  std::array<double, 256> diameter_of_few;
  for (std::size_t count = 0; count < diameter_of_few.size(); ++count)
    diameter_of_few[count] = diameter_of(double(count));
  skeleton.diameter.resize(skeleton.node_count());
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    const std::uint32_t count = tips[node];
    skeleton.diameter[node] = count < diameter_of_few.size() ? diameter_of_few[count] : diameter_of(count);
  }
  skeleton.pipe_model = model;
}

Skeleton cut_at_step(const Skeleton& history, std::uint32_t step, bool with_shed) {
  const std::size_t count = history.node_count();
  std::vector<bool> is_born(count);
  for (std::size_t node = 0; node < count; ++node) is_born[node] = history.birth_step[node] <= step;

  Skeleton past = subset(history, is_born);
  for (std::uint32_t& shed : past.shed_step) {
    if (shed > step) shed = kAlive;
  }
  past.light.clear();
  past.vigour.clear();
  if (past.pipe_model) assign_pipe_diameters(past, *past.pipe_model);
  return with_shed ? past : living(past);
}

Skeleton cut_at_level(const Skeleton& skeleton, std::uint32_t level) {
  std::vector<bool> is_planned(skeleton.node_count());
  for (std::size_t node = 0; node < is_planned.size(); ++node) {
    // What grows from a later level goes with it.
    is_planned[node] =
        skeleton.is_root(node) || (skeleton.level[node] <= level && is_planned[skeleton.parent[node]]);
  }
  return subset(skeleton, is_planned);
}

std::uint32_t last_step(const Skeleton& skeleton) {
  std::uint32_t last = 0;
  for (const std::vector<std::uint32_t>* steps : {&skeleton.birth_step, &skeleton.shed_step}) {
    for (const std::uint32_t step : *steps) last = std::max(last, step);
  }
  if (!skeleton.birth_step.empty()) return last;
  for (const std::uint16_t level : skeleton.level) last = std::max<std::uint32_t>(last, level);
  return last;
}

Skeleton cut_at(const Skeleton& skeleton, std::uint32_t step) {
  return skeleton.birth_step.empty() ? cut_at_level(skeleton, step) : cut_at_step(skeleton, step);
}

Skeleton living(const Skeleton& history) {
  if (history.shed_step.empty()) return history;
  std::vector<bool> is_alive(history.node_count());
  for (std::size_t node = 0; node < history.node_count(); ++node) is_alive[node] = !history.is_shed(node);
  return subset(history, is_alive);
}

}  // namespace ramify
