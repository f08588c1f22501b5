#include "pathplan/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/parallel.h"
#include "common/base/rng.h"
#include "pathplan/lifespans.h"
#include "pathplan/orientation.h"
#include "pathplan/subgraph_volume.h"

namespace ramify::pathplan {
namespace {

// Graphs that are planned before their branches go into the tree, and nodes a task.
constexpr std::size_t kGraphsAtOnce = 512;
constexpr std::size_t kNodesPerTask = 4096;

/// A graph of a later level, before it is planned.
struct Base {
  std::uint32_t node;  // of the tree: its root
  int lifespan;        // of that endpoint
  std::size_t row;     // of the levels, from 0
  Vec3 v_g;
  int b;
  std::uint64_t seed;
};

class LevelPlanner {
 public:
  LevelPlanner(const LevelPlan& plan, const Vec3& root, const Surroundings& surroundings,
               const RunContext& context, Stopwatch& watch)
      : plan_(plan),
        surroundings_(surroundings),
        context_(context),
        watch_(watch),
        patterns_(plan.levels.size()) {
    tree_.skeleton.position = {root};
    tree_.skeleton.parent = {kNoParent};
    tree_.skeleton.level = {1};
  }

  PlannedTree run() {
    plan_first_level();
    for (std::size_t level = 2; level <= plan_.levels.size() && tree_.is_complete; ++level) {
      deal_level(level - 1);
      plan_level(level);
      watch_.lap("levels");
    }
    return std::move(tree_);
  }

 private:
  void plan_first_level() {
    const Level& row = plan_.levels.front();
    const Vec3& root = tree_.skeleton.position.front();
    std::optional<RefinedCrown> crown;
    if (plan_.refine.spheres > 0) crown.emplace(row, plan_.refine, root, plan_.seed);
    const Volume& volume = crown ? crown->volume() : row.volume;
    const bool has_region =
        row.endpoints == EndpointKind::shell || (row.endpoints == EndpointKind::region && !crown);
    std::optional<Solid> region;
    if (has_region) region.emplace(endpoint_region(row));

    BranchingHooks hooks{
        .stop = context_.stop, .graph = &tree_.first, .wants_guided_costs = context_.wants("graph")};
    hooks.on_nodes = [&](double done, double total) { context_.report({"nodes", done, total, "node"}); };
    hooks.on_stage = [&](std::string_view finished) {
      watch_.lap(finished);
      if (finished == "nodes") context_.report({.stage = "graph"});
      if (finished == "graph") context_.report({.stage = "paths"});
    };
    const Pattern pattern(row, volume, root, surroundings_.volume_taken_of(volume));
    const Site site{.axis = plan_.axis,
                    .b = row.b,
                    .seed = plan_.seed,
                    .region = region ? &*region : nullptr,
                    .crown = crown ? &*crown : nullptr};
    const Branching branching = plan_branching(pattern, site, surroundings_, hooks);
    tree_.is_complete = !context_.stop.stop_requested();
    if (!tree_.is_complete) return;
    tree_.first.unreachable = branching.counts.unreachable;
    tree_.tips.emplace_back();
    add(branching, 0, static_cast<int>(plan_.levels.size()));
  }

  /// Lifespans and endpoint counts for the graphs around a level's endpoints.
  void deal_level(std::size_t level) {
    std::vector<Tip>& tips = tree_.tips[level - 1];
    std::vector<Sprout> sprouts(tips.size());
    for (std::size_t i = 0; i < tips.size(); ++i) {
      sprouts[i] = {.v_g = direction(plan_.levels[level], level, i), .lifespan = tips[i].lifespan};
    }
    deal_lifespans(plan_.lifespan, plan_.light, level, plan_.seed, sprouts);
    for (std::size_t i = 0; i < tips.size(); ++i) {
      tips[i].lifespan = sprouts[i].lifespan;
      tips[i].b_factor = sprouts[i].b_factor;
    }
  }

  void plan_level(std::size_t level) {
    const std::vector<Base> bases = bases_of(level);
    for (const Base& base : bases) prepare_pattern(base.row);
    std::vector<Branching> planned(bases.size());
    const std::string stage = fmt::format("level {}", level);
    for (std::size_t first = 0; first < bases.size(); first += kGraphsAtOnce) {
      context_.report({stage, static_cast<double>(first), static_cast<double>(bases.size()), "graph"});
      const std::size_t count = std::min(kGraphsAtOnce, bases.size() - first);
      const auto nodes = static_cast<std::size_t>(plan_.levels[bases[first].row].nodes);
      parallel_for(count, 1 + kNodesPerTask / nodes, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = first + begin; i < first + end; ++i) planned[i] = branch_at(bases[i]);
      });
      tree_.is_complete = !context_.stop.stop_requested();
      if (!tree_.is_complete) return;
    }
    tree_.tips.emplace_back();
    for (std::size_t i = 0; i < bases.size(); ++i) add(planned[i], bases[i].node, bases[i].lifespan);
  }

  /// The graphs of a level: around the endpoints that have a lifespan left.
  std::vector<Base> bases_of(std::size_t level) const {
    const bool is_around_all = plan_.levels[level - 1].around == Around::all;
    std::vector<Base> bases;
    for (std::size_t from = is_around_all ? 1 : level - 1; from < level; ++from) {
      for (std::size_t i = 0; i < tree_.tips[from - 1].size(); ++i) {
        const Tip& tip = tree_.tips[from - 1][i];
        const std::size_t row = row_of(level, tip.lifespan);
        const int b = static_cast<int>(std::lround(plan_.levels[row].b * tip.b_factor));
        if (tip.lifespan == 0 || b == 0) continue;
        bases.push_back({.node = tip.node,
                         .lifespan = tip.lifespan,
                         .row = row,
                         .v_g = direction(plan_.levels[row], from, i),
                         .b = b,
                         .seed = Rng::stream(plan_.seed, Stream::subgraph, level, (from << 32) + i).next()});
      }
    }
    return bases;
  }

  std::size_t row_of(std::size_t level, int lifespan) const {
    if (plan_.lifespan.row_by == RowBy::level || lifespan == 0) return level - 1;
    return plan_.levels.size() - static_cast<std::size_t>(lifespan);
  }

  /// v_g of the graph around the i-th endpoint of a level.
  Vec3 direction(const Level& row, std::size_t level, std::size_t i) const {
    const Tip& tip = tree_.tips[level - 1][i];
    Rng rng = Rng::stream(plan_.seed, Stream::v_g, level, i);
    const Vec3 outwards = glm::normalize(tree_.skeleton.position[tip.node] - tip.origin);
    return subgraph_direction(row, plan_.light, outwards, rng);
  }

  void prepare_pattern(std::size_t row) {
    if (patterns_[row]) return;
    const Level& level = plan_.levels[row];
    const double radius = subgraph_radius(level, row + 1);
    patterns_[row].emplace(level, subgraph_volume(level, radius), Vec3(0.0));
  }

  Branching branch_at(const Base& base) const {
    const Pattern& pattern = *patterns_[base.row];
    const bool is_shell = pattern.row.endpoints == EndpointKind::shell;
    const Site site{.frame = frame_along(tree_.skeleton.position[base.node], base.v_g),
                    .b = base.b,
                    .seed = base.seed,
                    .region = is_shell ? &pattern.solid : nullptr,
                    .must_be_complete = !surroundings_.has_obstacles()};
    return plan_branching(pattern, site, surroundings_, {.stop = context_.stop});
  }

  /// Joins branches to the tree at the root of their graph, which has the lifespan given.
  void add(const Branching& branching, std::uint32_t base, int lifespan) {
    Skeleton& tree = tree_.skeleton;
    const auto offset = static_cast<std::uint32_t>(tree.node_count()) - 1;
    const auto in_tree = [&](std::uint32_t node) { return node == 0 ? base : node + offset; };
    const Vec3 origin = tree.position[base];
    for (std::size_t i = 1; i < branching.position.size(); ++i) {
      tree.position.push_back(branching.position[i]);
      tree.parent.push_back(in_tree(branching.parent[i]));
      tree.level.push_back(static_cast<std::uint16_t>(tree_.tips.size()));
    }
    for (const std::uint32_t tip : branching.tips) {
      tree_.tips.back().push_back({.node = in_tree(tip), .origin = origin, .lifespan = lifespan});
    }
    tree_.counts.add(branching.counts);
  }

  const LevelPlan& plan_;
  const Surroundings& surroundings_;
  const RunContext& context_;
  Stopwatch& watch_;
  std::vector<std::optional<Pattern>> patterns_;  // of later levels, by row
  PlannedTree tree_;
};

}  // namespace

PlannedTree plan_levels(const LevelPlan& plan, const Vec3& root, const Surroundings& surroundings,
                        const RunContext& context, Stopwatch& watch) {
  return LevelPlanner(plan, root, surroundings, context, watch).run();
}

}  // namespace ramify::pathplan
