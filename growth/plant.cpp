#include "growth/plant.h"

#include <algorithm>
#include <bit>
#include <type_traits>

#include "common/base/rng.h"

namespace ramify::growth {
namespace {

/// Places from begin to before end that all stay.
struct Run {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

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
    find_runs();
  }

  /// Between the holes, in order. Nodes of one branch go together, so most are long: they are moved at once.
  const std::vector<Run>& runs() const { return runs_; }

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

  void find_runs() {
    std::uint64_t last = 0;  // whether the place before stays
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::uint64_t stays = words_[i].stays;
      for (std::uint64_t edges = stays ^ (stays << 1 | last); edges != 0; edges &= edges - 1) {
        const auto place = static_cast<std::uint32_t>(i * kBits) + std::countr_zero(edges);
        if (runs_.empty() || runs_.back().end != 0) {
          runs_.push_back({.begin = place});
        } else {
          runs_.back().end = place;
        }
      }
      last = stays >> (kBits - 1);
    }
  }

  std::vector<Word> words_;
  std::vector<Run> runs_;
};

/// Leaves out what stands in the holes.
template <class Values>
void close_holes(Values& values, const Numbering& numbering) {
  if (values.empty()) return;
  auto end = values.begin();
  for (const Run& run : numbering.runs()) {
    const auto begin = values.begin() + run.begin;
    const auto run_end = values.begin() + run.end;
    end = begin == end ? run_end : std::copy(begin, run_end, end);
  }
  values.erase(end, values.end());
}

/// Likewise, and puts `renewed` in place of the others.
template <class Values, class Renewed>
void close_holes(Values& values, const Numbering& numbering, const Renewed& renewed) {
  auto end = values.begin();
  for (const Run& run : numbering.runs())
    end = std::transform(values.begin() + run.begin, values.begin() + run.end, end, renewed);
  values.erase(end, values.end());
}

void close_nodes(Plant& plant) {
  // An axis is gone with its first node.
  const Numbering new_axis(plant.axes.size(),
                           [&](std::size_t i) { return plant.is_cut(plant.axes[i].first); });
  const Numbering new_node(plant.node_count(), [&](std::size_t node) { return plant.is_cut(node); });
  close_holes(plant.axes, new_axis);
  close_holes(plant.position, new_node);
  close_holes(plant.parent, new_node,
              [&](std::uint32_t parent) { return parent == kNone ? kNone : new_node(parent); });
  close_holes(plant.axis, new_node, [&](std::uint32_t axis) { return new_axis(axis); });
  close_holes(plant.founds_axis, new_node);
  close_holes(plant.birth_step, new_node);
  close_holes(plant.lost_tips, new_node);
  close_holes(plant.id, new_node);
  for (Axis& axis : plant.axes) axis.first = new_node(axis.first);
  for (Bud& bud : plant.buds) bud.node = new_node(bud.node);
  plant.cut_nodes = 0;
}

void close_buds(Plant& plant) {
  Bud* const buds = plant.buds.data();
  Vec3f* const direction = plant.bud_direction.data();
  const std::uint32_t* const parent = plant.parent.data();
  std::size_t kept = 0;
  // Which of them stay is hard to foretell, so this does not branch on it.
  for (std::size_t i = 0; i < plant.buds.size(); ++i) {
    const bool is_dead = buds[i].is_dead();
    const std::uint32_t node = is_dead ? 0 : buds[i].node;
    const bool is_cut = (node != 0) & (parent[node] == kNone);
    buds[kept] = buds[i];
    direction[kept] = direction[i];
    kept += !(is_dead | is_cut);
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
