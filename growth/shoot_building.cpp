#include "growth/shoot_building.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "growth/phyllotaxis.h"

namespace ramify::growth {
namespace {

constexpr std::size_t kReadAhead = 8;
constexpr std::size_t kShootsPerTask = 512;

/// How long the arrays of a plant are, or how much longer they become.
struct Lengths {
  std::size_t nodes = 0;
  std::size_t axes = 0;
  std::size_t buds = 0;

  Lengths& operator+=(const Lengths& other) {
    nodes += other.nodes;
    axes += other.axes;
    buds += other.buds;
    return *this;
  }
};

/// How many axillary buds a tip gets beside its terminal one, which in sympodial trees is one of them.
std::size_t axillary_buds_of_tip(const TreeParameters& tree) {
  return buds_per_node(tree) - (tree.sympodial ? 1 : 0);
}

/// The node that a terminal bud leaves behind may get its axillary buds only when that grows.
bool adds_buds_at_start(const Shoot& shoot, const TreeParameters& tree) {
  return shoot.is_terminal && tree.tip_bud == TipBud::terminal;
}

/// What a shoot adds to the arrays.
Lengths added_by(const Shoot& shoot, const TreeParameters& tree) {
  if (shoot.made == 0) return {};
  const std::size_t of_tip = axillary_buds_of_tip(tree);
  Lengths added{.nodes = shoot.made, .axes = shoot.is_terminal ? 0u : 1u, .buds = 1};  // the terminal one
  added.buds += (shoot.made - 1) * buds_per_node(tree);
  if (tree.tip_bud == TipBud::both) added.buds += of_tip;
  // One of those takes the place of the spent bud.
  if (adds_buds_at_start(shoot, tree) && of_tip > 0) added.buds += of_tip - 1;
  return added;
}

/// Makes the arrays longer.
void extend(Plant& plant, const Lengths& more) {
  const auto lengthen = [](auto& values, std::size_t count) { set_size(values, values.size() + count); };
  lengthen(plant.position, more.nodes);
  lengthen(plant.parent, more.nodes);
  lengthen(plant.axis, more.nodes);
  lengthen(plant.founds_axis, more.nodes);
  lengthen(plant.birth_step, more.nodes);
  lengthen(plant.lost_tips, more.nodes);
  lengthen(plant.axes, more.axes);
  lengthen(plant.buds, more.buds);
  lengthen(plant.bud_direction, more.buds);
}

/// Builds some successive shoots into a part of the arrays that is theirs alone.
class Builder {
 public:
  Builder(Plant& plant, const Traces& traces, const Parameters& world, const TreeParameters& tree,
          const ShadowGrid& shadow, int step)
      : plant_(plant),
        traces_(traces),
        tree_(tree),
        shadow_(shadow),
        step_(static_cast<std::uint16_t>(step)),
        is_light_(world.environment == Environment::light),
        buds_cast_(is_light_ && world.casters == Casters::buds),
        metamers_cast_(is_light_ && world.casters == Casters::metamers),
        casts_from_start_(world.shadow == ShadowModel::multiplicative) {}

  /// `next`: where in the arrays theirs begin.
  void build_all(std::span<const Shoot> shoots, const Lengths& next) {
    next_ = next;
    for (std::size_t i = 0; i < shoots.size(); ++i) {
      if (i + kReadAhead < shoots.size()) prefetch(shoots[i + kReadAhead]);
      build(shoots[i]);
    }
  }

  const CasterChanges& changes() const { return changes_; }

  /// Gives those buds their sites whose voxels were in no leaf of the shadow yet.
  void settle(ShadowGrid& shadow) const {
    for (const auto& [bud, voxel] : unsettled_) plant_.buds[bud].site = shadow.site_of(voxel);
  }

 private:
  /// Begins to fetch what build() will read: the axes of successive shoots lie anywhere.
  void prefetch(const Shoot& shoot) const {
    __builtin_prefetch(&plant_.axes[plant_.axis[plant_.buds[shoot.bud].node]]);
  }

  void build(const Shoot& shoot) {
    const std::uint32_t base = plant_.buds[shoot.bud].node;
    const std::uint32_t bearer = plant_.axis[base];
    spend(shoot);
    if (shoot.made == 0) return;
    if (adds_buds_at_start(shoot, tree_)) add_axillary_buds(base, shoot.first, shoot.bud);

    const std::uint32_t axis = shoot.is_terminal ? bearer : found_axis(bearer, shoot.axis_id);
    std::uint32_t node = base;
    for (std::size_t slot = shoot.first + 1; slot <= shoot.first + shoot.made; ++slot) {
      node = add_node(axis, node, slot);
      const bool is_tip = slot == shoot.first + shoot.made;
      if (!is_tip) add_all_axillary_buds(node, slot);
      if (is_tip && tree_.tip_bud == TipBud::both) add_axillary_buds(node, slot, kNone);
    }
    add_terminal_bud(node, axis, shoot);
  }

  void spend(const Shoot& shoot) {
    plant_.buds[shoot.bud].node = kNone;
    if (buds_cast_) changes_.removed.push_back(traces_.voxel[shoot.first]);
  }

  std::uint32_t found_axis(std::uint32_t bearer, std::uint32_t id) {
    const auto place = static_cast<std::uint32_t>(next_.axes++);
    Axis& axis = plant_.axes[place];
    axis.node_count = 0;
    axis.first = static_cast<std::uint32_t>(next_.nodes);
    axis.id = id;
    axis.order = static_cast<std::uint16_t>(plant_.axes[bearer].order + 1);
    return place;
  }

  std::uint32_t add_node(std::uint32_t axis, std::uint32_t parent, std::size_t slot) {
    const std::size_t node = next_.nodes++;
    plant_.position[node] = traces_.position[slot];
    plant_.parent[node] = parent;
    plant_.axis[node] = axis;
    plant_.founds_axis[node] = plant_.axes[axis].node_count == 0;
    plant_.birth_step[node] = step_;
    ++plant_.axes[axis].node_count;
    if (metamers_cast_) changes_.added.push_back(traces_.voxel[casts_from_start_ ? slot - 1 : slot]);
    return static_cast<std::uint32_t>(node);
  }

  void add_terminal_bud(std::uint32_t node, std::uint32_t axis, const Shoot& shoot) {
    Vec3f direction = shoot.end_direction;
    Vec3f reference = shoot.end_reference;
    const std::size_t slot = shoot.first + shoot.made;
    if (tree_.sympodial) {
      // The tip's own bud dies; the first in the axils beside it goes on.
      direction = traces_.axillary[slot * traces_.buds_per_node];
      reference = Vec3f(transported(Vec3(reference), Vec3(shoot.end_direction), Vec3(direction)));
    }
    plant_.axes[axis].reference = reference;
    add_bud(node, true, direction, slot, kNone);
  }

  void add_all_axillary_buds(std::uint32_t node, std::size_t slot) {
    for (std::size_t i = 0; i < traces_.buds_per_node; ++i) add_axillary_bud(node, slot, i, kNone);
  }

  /// Of a tip: without the one that goes on in its stead. The first takes the place of the dead bud `spent`.
  void add_axillary_buds(std::uint32_t node, std::size_t slot, std::uint32_t spent) {
    for (std::size_t i = tree_.sympodial ? 1 : 0; i < traces_.buds_per_node; ++i) {
      add_axillary_bud(node, slot, i, spent);
      spent = kNone;
    }
  }

  void add_axillary_bud(std::uint32_t node, std::size_t slot, std::size_t i, std::uint32_t spent) {
    const Vec3f direction = traces_.axillary[slot * traces_.buds_per_node + i];
    add_bud(node, false, direction, slot, spent);
  }

  /// In the place of the dead bud `spent`, or behind all others.
  void add_bud(std::uint32_t node, bool is_terminal, const Vec3f& direction, std::size_t slot,
               std::uint32_t spent) {
    const Coord& voxel = traces_.voxel[slot];
    if (buds_cast_) changes_.added.push_back(voxel);
    const std::size_t place = spent == kNone ? next_.buds++ : spent;
    // Written where it stays: what is handed on in parts and read back whole waits until all parts are
    // written.
    Bud& bud = plant_.buds[place];
    bud.node = node;
    bud.site = is_light_ ? shadow_.known_site_of(voxel) : 0;
    bud.birth_step = step_;
    bud.is_terminal = is_terminal;
    bud.is_blind = false;
    plant_.bud_direction[place] = direction;
    if (is_light_ && bud.site == 0) unsettled_.push_back({static_cast<std::uint32_t>(place), voxel});
  }

  Plant& plant_;
  const Traces& traces_;
  const TreeParameters& tree_;
  const ShadowGrid& shadow_;
  std::uint16_t step_;
  bool is_light_;
  bool buds_cast_;
  bool metamers_cast_;
  bool casts_from_start_;
  Lengths next_;
  CasterChanges changes_;
  std::vector<std::pair<std::uint32_t, Coord>> unsettled_;  // buds and their voxels
};

}  // namespace

void build_shoots(Plant& plant, std::span<const Shoot> shoots, const Traces& traces, const Parameters& world,
                  const TreeParameters& tree, ShadowGrid& shadow, int step, CasterChanges& changes) {
  const std::size_t tasks = (shoots.size() + kShootsPerTask - 1) / kShootsPerTask;
  const auto of_task = [&](std::size_t task) {
    const std::size_t begin = task * kShootsPerTask;
    return shoots.subspan(begin, std::min(kShootsPerTask, shoots.size() - begin));
  };
  const Lengths before{plant.node_count(), plant.axes.size(), plant.buds.size()};
  std::vector<Lengths> starts;
  Lengths added;
  for (std::size_t task = 0; task < tasks; ++task) {
    starts.push_back(before);
    starts.back() += added;
    for (const Shoot& shoot : of_task(task)) {
      added += added_by(shoot, tree);
      if (!shoot.is_terminal && shoot.made > 0) plant.axes_founded = shoot.axis_id + 1;
    }
  }
  extend(plant, added);

  std::vector<Builder> builders(tasks, Builder(plant, traces, world, tree, shadow, step));
  parallel_for(tasks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) builders[task].build_all(of_task(task), starts[task]);
  });
  for (const Builder& builder : builders) {
    const CasterChanges& more = builder.changes();
    changes.added.insert(changes.added.end(), more.added.begin(), more.added.end());
    changes.removed.insert(changes.removed.end(), more.removed.begin(), more.removed.end());
    builder.settle(shadow);
  }
}

void sort_buds(Plant& plant) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < plant.buds.size(); ++i) {
    if (!plant.buds[i].is_dead()) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return plant.buds[a].node < plant.buds[b].node; });
  MappedVector<Bud> buds;
  MappedVector<Vec3f> direction;
  for (const std::uint32_t i : order) {
    buds.push_back(plant.buds[i]);
    direction.push_back(plant.bud_direction[i]);
  }
  plant.buds = std::move(buds);
  plant.bud_direction = std::move(direction);
}

void abort_buds(Plant& plant, const Parameters& world, const TreeParameters& tree, const ShadowGrid& shadow,
                int step, CasterChanges& changes) {
  const double lifespan = tree.bud_lifespan.at(step);
  if (lifespan <= 0.0) return;
  const bool buds_cast = world.environment == Environment::light && world.casters == Casters::buds;
  for (Bud& bud : plant.buds) {
    if (bud.is_dead() || step - bud.birth_step < lifespan) continue;
    if (buds_cast) changes.removed.push_back(shadow.voxel_of(plant.position[bud.node]));
    bud.node = kNone;
  }
}

}  // namespace ramify::growth
