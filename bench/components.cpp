#include "bench/components.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/plain_growth.h"
#include "bench/trees.h"
#include "common/base/parallel.h"
#include "growth/allocation.h"
#include "growth/engine.h"
#include "growth/simulation.h"

namespace ramify::bench {
namespace {

using namespace growth;

constexpr int kRepetitions = 3;

/// When the internodes of a tree, one each, began and ceased to cast shadow.
struct CasterHistory {
  std::vector<Coord> voxel;
  std::vector<std::uint32_t> birth_step;  // not falling
  std::vector<std::uint32_t> shed_step;   // or kAlive
};

/// Casters in the order in which a step takes them.
struct CasterSteps {
  std::vector<std::vector<Coord>> added;
  std::vector<std::vector<Coord>> removed;
};

/// What is measured on; made when first asked for.
class Subjects {
 public:
  explicit Subjects(int steps) : parameters_(trial_parameters({fmt::format("steps={}", steps)})) {}

  int steps() const { return parameters_.steps; }
  const Parameters& parameters() const { return parameters_; }
  ShadowGrid empty_grid() const { return ShadowGrid(penumbra(), parameters_.voxel_edge()); }
  PlainShadow empty_plain_shadow() const { return PlainShadow(penumbra(), parameters_.voxel_edge()); }

  /// The tree after the last step, its light sensed.
  const GrowingTree& tree() {
    if (!simulation_) {
      simulation_ = std::make_unique<Simulation>(parameters_);
      while (simulation_->step() < parameters_.steps) simulation_->advance();
      simulation_->sense();
    }
    return simulation_->trees().front();
  }

  PlainTree& plain_tree() {
    if (!plain_tree_) {
      plain_tree_ = std::make_unique<PlainTree>(parameters_);
      plain_tree_->grow();
    }
    return *plain_tree_;
  }

  const CasterHistory& casters() {
    if (casters_.voxel.empty()) {
      RunContext context;
      context.wants_history = true;
      const Skeleton history = Engine::run(parameters_, context).skeleton;
      const ShadowGrid grid = empty_grid();
      for (std::size_t node = 1; node < history.node_count(); ++node) {
        casters_.voxel.push_back(grid.voxel_of(history.position[node]));
        casters_.birth_step.push_back(history.birth_step[node]);
        casters_.shed_step.push_back(history.shed_step[node]);
      }
    }
    return casters_;
  }

 private:
  Penumbra penumbra() const { return {.a = parameters_.a, .b = parameters_.b, .q_max = parameters_.q_max}; }

  Parameters parameters_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<PlainTree> plain_tree_;
  CasterHistory casters_;
};

std::vector<Coord> casters_after(const CasterHistory& history, std::uint32_t step) {
  std::vector<Coord> casters;
  for (std::size_t i = 0; i < history.voxel.size() && history.birth_step[i] <= step; ++i) {
    const std::uint32_t shed = history.shed_step[i];
    if (shed == kAlive || shed > step) casters.push_back(history.voxel[i]);
  }
  return casters;
}

CasterSteps caster_steps(const CasterHistory& history, int steps) {
  const std::size_t count = static_cast<std::size_t>(steps) + 1;
  CasterSteps changes{std::vector<std::vector<Coord>>(count), std::vector<std::vector<Coord>>(count)};
  for (std::size_t i = 0; i < history.voxel.size(); ++i) {
    changes.added[history.birth_step[i]].push_back(history.voxel[i]);
    if (history.shed_step[i] != kAlive) changes.removed[history.shed_step[i]].push_back(history.voxel[i]);
  }
  return changes;
}

Outcome cast_grid(Subjects& subjects) {
  const std::vector<Coord> casters = casters_after(subjects.casters(), kAlive - 1);
  ShadowGrid grid = subjects.empty_grid();
  return timed([&] { grid.cast(casters); });
}

Outcome cast_accessor(Subjects& subjects) {
  const std::vector<Coord> casters = casters_after(subjects.casters(), kAlive - 1);
  PlainShadow shadow = subjects.empty_plain_shadow();
  return timed([&] {
    for (const Coord& caster : casters) shadow.cast(caster);
  });
}

Outcome cast_changes(Subjects& subjects) {
  const CasterSteps changes = caster_steps(subjects.casters(), subjects.steps());
  ShadowGrid grid = subjects.empty_grid();
  return timed([&] {
    for (std::size_t step = 1; step < changes.added.size(); ++step) {
      grid.change(changes.added[step], changes.removed[step]);
    }
  });
}

Outcome cast_anew(Subjects& subjects) {
  const CasterHistory& casters = subjects.casters();
  return timed([&] {
    for (int step = 1; step <= subjects.steps(); ++step) {
      ShadowGrid grid = subjects.empty_grid();
      grid.cast(casters_after(casters, static_cast<std::uint32_t>(step)));
    }
  });
}

template <class Allocate>
Outcome pass_flat(Subjects& subjects, const Allocate& allocate) {
  const GrowingTree& tree = subjects.tree();
  LightSums sums = tree.sums;
  MappedVector<double> vigour = tree.vigour;
  return timed([&] {
    sum_light(tree.plant, tree.light, sums);
    allocate(tree.plant, tree.light, sums, tree.place, subjects.steps() + 1, vigour);
  });
}

Outcome pass_recursive(Subjects& subjects) {
  PlainTree& tree = subjects.plain_tree();
  return timed([&] {
    tree.sum_light();
    tree.share_resource();
  });
}

}  // namespace

void register_components(Results& results, int steps) {
  const auto subjects = std::make_shared<Subjects>(steps);
  const auto add = [&](const char* name, auto work) {
    register_work(results, name, kRepetitions, [subjects, work] {
      const ThreadLimit limit(1);
      return work(*subjects);
    });
  };
  add(component::kCastGrid, cast_grid);
  add(component::kCastAccessor, cast_accessor);
  add(component::kCastChanges, cast_changes);
  add(component::kCastAnew, cast_anew);
  add(component::kPassesFlat, [](Subjects& s) { return pass_flat(s, allocate_borchert_honda); });
  add(component::kPassesRecursive, pass_recursive);
  add(component::kAllocatePriority, [](Subjects& s) { return pass_flat(s, allocate_priority); });
}

void add_components(GoalTable& table, const Results& results) {
  using namespace component;
  // What the prototypes of this project reached.
  table.add("casting all shadows, ShadowGrid against ValueAccessor", results.ratio(kCastAccessor, kCastGrid),
            "x", Goal{.reach = 5.5, .is_limit = false});
  table.add("shadows of all steps, changes only against all anew", results.ratio(kCastAnew, kCastChanges),
            "x", Goal{.reach = 2.0, .stretch = 19.0, .is_limit = false});
  table.add("light sums and Borchert-Honda, flat arrays against recursion",
            results.ratio(kPassesRecursive, kPassesFlat), "x", Goal{.reach = 7.0, .is_limit = false});
  table.add("light sums and allocation, priority against Borchert-Honda, same plant",
            results.ratio(kAllocatePriority, kPassesFlat), "x");
}

}  // namespace ramify::bench
