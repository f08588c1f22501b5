#include "growth/plant.h"

#include <bit>

#include "common/base/rng.h"

namespace ramify::growth {
namespace {

// Which values stay is hard to foretell, so the loops below do not branch on it.

/// Places numbered anew, without holes. A bit a place and a count for each 64 of them: so small that it stays
/// in the cache, whichever places are asked for.
class Numbering {
 public:
  template <class IsHole>
  Numbering(std::size_t count, const IsHole& is_hole) : words_(count / kBits + 1) {
    for (std::size_t i = 0; i < count; ++i) {
      words_[i / kBits].stays |= std::uint64_t{!is_hole(i)} << i % kBits;
    }
    for (std::size_t i = 1; i < words_.size(); ++i) {
      words_[i].before = words_[i - 1].before + count_of(words_[i - 1].stays);
    }
  }

  bool stays(std::size_t place) const { return (words_[place / kBits].stays >> place % kBits & 1) != 0; }

  /// The new number of a place that stays.
  std::uint32_t operator()(std::uint32_t place) const {
    const Word& word = words_[place / kBits];
    return word.before + count_of(word.stays & ((std::uint64_t{1} << place % kBits) - 1));
  }

 private:
  static constexpr std::size_t kBits = 64;
  struct Word {
    std::uint64_t stays = 0;   // a bit a place
    std::uint32_t before = 0;  // how many places stay before these
  };

  static std::uint32_t count_of(std::uint64_t bits) {
    return static_cast<std::uint32_t>(std::popcount(bits));
  }

  std::vector<Word> words_;
};

/// Leaves out what stands in the holes and puts `renewed` in place of the others.
template <class T, class Renewed>
void close_holes(std::vector<T>& values, const Numbering& numbering, const Renewed& renewed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[kept] = renewed(values[i]);
    kept += numbering.stays(i);
  }
  values.resize(kept);
}

template <class T>
void close_holes(std::vector<T>& values, const Numbering& numbering) {
  close_holes(values, numbering, [](const T& value) { return value; });
}

void close_nodes(Plant& plant) {
  // An axis is gone with its first node.
  const Numbering new_axis(plant.axes.size(),
                           [&](std::size_t i) { return plant.is_cut(plant.axes[i].first); });
  const Numbering new_node(plant.node_count(), [&](std::size_t node) { return plant.is_cut(node); });
  close_holes(plant.axes, new_axis, [&](Axis axis) {
    axis.first = new_node(axis.first);
    return axis;
  });
  close_holes(plant.position, new_node);
  close_holes(plant.parent, new_node,
              [&](std::uint32_t parent) { return parent == kNone ? kNone : new_node(parent); });
  close_holes(plant.axis, new_node, [&](std::uint32_t axis) { return new_axis(axis); });
  close_holes(plant.founds_axis, new_node);
  close_holes(plant.birth_step, new_node);
  close_holes(plant.lost_tips, new_node);
  close_holes(plant.id, new_node);
  for (Bud& bud : plant.buds) bud.node = new_node(bud.node);
  plant.cut_nodes = 0;
}

void close_buds(Plant& plant) {
  Bud* const buds = plant.buds.data();
  Vec3f* const direction = plant.bud_direction.data();
  const std::uint32_t* const parent = plant.parent.data();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const Bud bud = buds[i];
    const std::uint32_t node = bud.is_dead() ? 0 : bud.node;
    const bool is_cut = (node != 0) & (parent[node] == kNone);
    buds[kept] = bud;
    direction[kept] = direction[i];
    kept += !(bud.is_dead() | is_cut);
  }
  plant.buds.resize(kept);
  plant.bud_direction.resize(kept);
}

}  // namespace

Plant seedling(const TreePlace& place, Site site) {
  Plant plant;
  plant.position.push_back(place.position);
  plant.parent.push_back(kNone);
  plant.axis.push_back(0);
  plant.founds_axis.push_back(0);
  plant.birth_step.push_back(0);
  plant.lost_tips.push_back(0);

  Axis trunk;
  trunk.node_count = 1;
  const double azimuth = Rng::stream(place.seed, Stream::axis, 0).uniform(0.0, 2.0 * std::numbers::pi);
  trunk.reference = Vec3f(perpendicular_at(kUp, azimuth));
  plant.axes.push_back(trunk);
  plant.axes_founded = 1;
  plant.buds.push_back({.node = 0, .site = site, .is_terminal = true});
  plant.bud_direction.push_back(Vec3f(kUp));
  return plant;
}

void compact(Plant& plant, double share) {
  close_buds(plant);
  const bool has_many = double(plant.cut_nodes) >= share * double(plant.node_count());
  if (plant.cut_nodes > 0 && has_many) close_nodes(plant);
}

}  // namespace ramify::growth
