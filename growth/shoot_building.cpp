#include "growth/shoot_building.h"

#include <algorithm>

namespace ramify::growth {
namespace {

constexpr std::size_t kReadAhead = 8;

class Builder {
 public:
  Builder(Plant& plant, const Traces& traces, const Parameters& world, const TreeParameters& tree,
          ShadowGrid& shadow, int step, CasterChanges& changes)
      : plant_(plant),
        traces_(traces),
        tree_(tree),
        shadow_(shadow),
        step_(static_cast<std::uint16_t>(step)),
        is_light_(world.environment == Environment::light),
        buds_cast_(is_light_ && world.casters == Casters::buds),
        metamers_cast_(is_light_ && world.casters == Casters::metamers),
        casts_from_start_(world.shadow == ShadowModel::multiplicative),
        changes_(changes) {}

  void make_room_for(std::size_t shoots) {
    const std::size_t nodes = traces_.position.size();
    make_room(plant_.position, nodes);
    make_room(plant_.parent, nodes);
    make_room(plant_.axis, nodes);
    make_room(plant_.founds_axis, nodes);
    make_room(plant_.birth_step, nodes);
    make_room(plant_.lost_tips, nodes);
    make_room(plant_.axes, shoots);
    make_room(plant_.buds, nodes * traces_.buds_per_node + shoots);
    make_room(plant_.bud_direction, nodes * traces_.buds_per_node + shoots);
  }

  /// Begins to fetch what build() will read: the axes of successive shoots lie anywhere.
  void prefetch(const Shoot& shoot) const {
    __builtin_prefetch(&plant_.axes[plant_.axis[plant_.buds[shoot.bud].node]]);
  }

  void build(const Shoot& shoot) {
    const Bud bud = plant_.buds[shoot.bud];
    const std::uint32_t bearer = plant_.axis[bud.node];
    spend(shoot);
    if (shoot.made == 0) return;
    // The node that a terminal bud leaves behind may get its axillary buds only now.
    if (bud.is_terminal && tree_.tip_bud == TipBud::terminal) {
      add_axillary_buds(bud.node, shoot.first, shoot.bud);
    }

    const std::uint32_t axis = bud.is_terminal ? bearer : found_axis(bearer, shoot.axis_id);
    std::uint32_t node = bud.node;
    for (std::size_t slot = shoot.first + 1; slot <= shoot.first + shoot.made; ++slot) {
      node = add_node(axis, node, slot);
      const bool is_tip = slot == shoot.first + shoot.made;
      if (!is_tip) add_all_axillary_buds(node, slot);
      if (is_tip && tree_.tip_bud == TipBud::both) add_axillary_buds(node, slot, kNone);
    }
    add_terminal_bud(node, axis, shoot);
  }

 private:
  void spend(const Shoot& shoot) {
    plant_.buds[shoot.bud].node = kNone;
    if (buds_cast_) changes_.removed.push_back(traces_.voxel[shoot.first]);
  }

  std::uint32_t found_axis(std::uint32_t bearer, std::uint32_t id) {
    Axis axis;
    axis.first = static_cast<std::uint32_t>(plant_.node_count());
    axis.id = id;
    axis.order = static_cast<std::uint16_t>(plant_.axes[bearer].order + 1);
    plant_.axes.push_back(axis);
    plant_.axes_founded = id + 1;
    return static_cast<std::uint32_t>(plant_.axes.size() - 1);
  }

  std::uint32_t add_node(std::uint32_t axis, std::uint32_t parent, std::size_t slot) {
    plant_.position.push_back(traces_.position[slot]);
    plant_.parent.push_back(parent);
    plant_.axis.push_back(axis);
    plant_.founds_axis.push_back(plant_.axes[axis].node_count == 0);
    plant_.birth_step.push_back(step_);
    plant_.lost_tips.push_back(0);
    ++plant_.axes[axis].node_count;
    if (metamers_cast_) changes_.added.push_back(traces_.voxel[casts_from_start_ ? slot - 1 : slot]);
    return static_cast<std::uint32_t>(plant_.node_count() - 1);
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
    // Written where it stays: what is handed on in parts and read back whole waits until all parts are
    // written.
    Bud& bud = spent == kNone ? plant_.buds.emplace_back() : plant_.buds[spent];
    bud.node = node;
    bud.site = is_light_ ? shadow_.site_of(voxel) : 0;
    bud.birth_step = step_;
    bud.is_terminal = is_terminal;
    bud.is_blind = false;
    (spent == kNone ? plant_.bud_direction.emplace_back() : plant_.bud_direction[spent]) = direction;
  }

  Plant& plant_;
  const Traces& traces_;
  const TreeParameters& tree_;
  ShadowGrid& shadow_;
  std::uint16_t step_;
  bool is_light_;
  bool buds_cast_;
  bool metamers_cast_;
  bool casts_from_start_;
  CasterChanges& changes_;
};

}  // namespace

void build_shoots(Plant& plant, std::span<const Shoot> shoots, const Traces& traces, const Parameters& world,
                  const TreeParameters& tree, ShadowGrid& shadow, int step, CasterChanges& changes) {
  Builder builder(plant, traces, world, tree, shadow, step, changes);
  builder.make_room_for(shoots.size());
  for (std::size_t i = 0; i < shoots.size(); ++i) {
    if (i + kReadAhead < shoots.size()) builder.prefetch(shoots[i + kReadAhead]);
    builder.build(shoots[i]);
  }
}

void sort_buds(Plant& plant) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < plant.buds.size(); ++i) {
    if (!plant.buds[i].is_dead()) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return plant.buds[a].node < plant.buds[b].node; });
  std::vector<Bud> buds;
  std::vector<Vec3f> direction;
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
