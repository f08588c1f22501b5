#include "pathplan/yao_graph.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "common/base/parallel.h"
#include "pathplan/near_nodes.h"
#include "pathplan/point_grid.h"
#include "pathplan/yao_sectors.h"

namespace ramify::pathplan {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

// Cells or nodes a task: enough that starting one does not show.
constexpr std::size_t kGrain = 256;

// If there is but one sector, nearly all nodes have another within this distance, in spacings.
constexpr double kFirstReach = 1.3;

// Rounding must not put nodes two cells apart that are within the first reach of each other.
constexpr double kCellSlack = 1.0 + 1e-9;

/// The nearest node of a sector so far: the upper half of the square of its distance, as whole numbers
/// compare like the numbers that have the same bits, and its place.
using Nearest = std::uint64_t;
constexpr Nearest kNothing = ~Nearest{0};

std::uint32_t place_of(Nearest nearest) {
  return static_cast<std::uint32_t>(nearest);
}

Nearest nearest_at(double square, std::uint32_t place) {
  // Rounded, so that what is equal but for rounding seldom differs, and less 1, so that 0 becomes the
  // greatest.
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 31;
  return ((std::bit_cast<std::uint64_t>(square) - kHalf) & ~std::uint64_t{kNone}) | place;
}

/// Orders squares of distances as they are; equal ones, to a part in 10^13, alike.
std::uint64_t rank_of(double square) {
  constexpr std::uint64_t kHalf = 1 << 7;
  return (std::bit_cast<std::uint64_t>(square) + kHalf) / (2 * kHalf);
}

/// The nearest allowed node in each sector, for all nodes.
template <class Sectors>
class Search {
 public:
  using Targets = std::array<std::uint32_t, Sectors::kCount>;  // kNone in an empty sector

  Search(std::span<const Vec3> nodes, const EdgeRules& rules, double spacing)
      : nodes_(nodes),
        rules_(rules),
        first_reach_(std::min(first_reach(spacing), rules.max_length())),
        grid_(nodes, first_reach_ * kCellSlack),
        rounded_(nodes, grid_) {}

  std::vector<Targets> run(const std::stop_token& stop) {
    compare_pairs(stop);
    std::vector<Targets> targets(nodes_.size());
    parallel_for(nodes_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      NearNodes near(rounded_);
      for (auto place = static_cast<std::uint32_t>(begin); place < end; ++place) {
        targets[grid_.order()[place]] = stop.stop_requested() ? no_targets() : targets_of(place, near);
      }
    });
    return targets;
  }

 private:
  using Sides = std::array<Nearest, Sectors::kCount>;

  static double first_reach(double spacing) {
    // All sectors are as large, and share the volume.
    return kFirstReach * std::cbrt(double{Sectors::kCount}) * spacing;
  }

  static Targets no_targets() {
    Targets targets;
    targets.fill(kNone);
    return targets;
  }

  /// Finds what is nearest among all that is within the first reach, whatever the rules allow.
  void compare_pairs(const std::stop_token& stop) {
    Sides nothing;
    nothing.fill(kNothing);
    nearest_.assign(nodes_.size(), nothing);
    // Pairs reach into the next slab at most, so that every other one can be worked on at once.
    const std::size_t slab = std::max(kGrain, grid_.cells_ahead());
    const std::size_t slabs = (grid_.cell_count() + slab - 1) / slab;
    for (const std::size_t first : {0, 1}) {
      parallel_for((slabs + 1 - first) / 2, 1, [&](std::size_t begin, std::size_t end) {
        NearNodes near(rounded_);
        for (std::size_t i = begin; i < end && !stop.stop_requested(); ++i) {
          const std::size_t cell_begin = (2 * i + first) * slab;
          const std::size_t cell_end = std::min(cell_begin + slab, grid_.cell_count());
          for (std::size_t cell = cell_begin; cell < cell_end; ++cell) compare_from(cell, near);
        }
      });
    }
  }

  void compare_from(std::size_t cell, NearNodes& near) {
    const std::size_t count = grid_.ids_in(cell).size();
    if (count == 0) return;
    const auto first = static_cast<std::uint32_t>(grid_.ids_in(cell).data() - grid_.order().data());
    near.gather_ahead(cell);
    const double limit = first_reach_ * first_reach_;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t place = first + i;
      const Vec3 position = position_of(place);
      Sides& sides = nearest_[place];
      for (const std::uint32_t other : near.ahead_of(i, first_reach_)) {
        const Vec3 d = position_of(other) - position;
        const double square = glm::dot(d, d);
        if (square > limit) continue;
        offer(sides[Sectors::of(d)], square, place, other);
        offer(nearest_[other][Sectors::of(-d)], square, other, place);
      }
    }
  }

  const Vec3& position_of(std::uint32_t place) const { return nodes_[grid_.order()[place]]; }

  /// `other`, at a distance from the node at `place`, for its nearest.
  void offer(Nearest& nearest, double square, std::uint32_t place, std::uint32_t other) {
    const Nearest offered = nearest_at(square, other);
    if ((offered ^ nearest) >> 32 == 0) [[unlikely]] {
      if (is_before(square, other, place, place_of(nearest))) nearest = offered;
      return;
    }
    // Which of two is nearer cannot be foreseen, so this is no branch.
    nearest = std::min(nearest, offered);
  }

  /// Whether `other` comes before the nearest one so far, if there is one, when looked at closely.
  bool is_before(double square, std::uint32_t other, std::uint32_t place, std::uint32_t nearest) const {
    if (nearest == kNone) return false;
    const Vec3 d = position_of(nearest) - position_of(place);
    const std::uint64_t rank = rank_of(square);
    const std::uint64_t nearest_rank = rank_of(glm::dot(d, d));
    return rank < nearest_rank || (rank == nearest_rank && grid_.order()[other] < grid_.order()[nearest]);
  }

  /// What the pairs have shown; where that is nothing, or not allowed, a sector is looked at on its own.
  Targets targets_of(std::uint32_t place, NearNodes& near) const {
    const std::uint32_t node = grid_.order()[place];
    const bool is_all = first_reach_ == rules_.max_length();
    Targets targets;
    for (Sector sector = 0; sector < Sectors::kCount; ++sector) {
      const std::uint32_t nearest = place_of(nearest_[place][sector]);
      targets[sector] = nearest == kNone ? kNone : grid_.order()[nearest];
      if (nearest == kNone ? is_all : rules_.allows(node, targets[sector])) continue;
      targets[sector] = nearest_in(sector, place, near);
    }
    return targets;
  }

  /// The nearest allowed node of a sector, kNone if there is none.
  std::uint32_t nearest_in(Sector sector, std::uint32_t place, NearNodes& near) const {
    const double farthest = std::min(rules_.max_length(), rounded_.longest());
    for (double reach = 2.0 * first_reach_;; reach *= 2.0) {
      const std::uint32_t nearest = nearest_within(std::min(reach, farthest), sector, place, near);
      if (nearest != kNone || reach >= farthest) return nearest;
    }
  }

  std::uint32_t nearest_within(double reach, Sector sector, std::uint32_t place, NearNodes& near) const {
    const Vec3 position = position_of(place);
    Box box{position, position};
    for (int axis = 0; axis < 3; ++axis) {
      const int side = Sectors::side(sector, axis);
      if (side >= 0) box.high[axis] += reach;
      if (side <= 0) box.low[axis] -= reach;
    }
    std::uint32_t nearest = kNone;
    for (const std::uint32_t other : near.among(grid_.touching(box), position, reach)) {
      const Vec3 d = position_of(other) - position;
      const double square = glm::dot(d, d);
      if (square > reach * reach || square == 0.0 || Sectors::of(d) != sector) continue;
      if (nearest != kNone && !is_before(square, other, place, nearest)) continue;
      if (rules_.allows(grid_.order()[place], grid_.order()[other])) nearest = other;
    }
    return nearest == kNone ? kNone : grid_.order()[nearest];
  }

  std::span<const Vec3> nodes_;
  const EdgeRules& rules_;
  double first_reach_;
  PointGrid grid_;
  RoundedNodes rounded_;
  std::vector<Sides> nearest_;  // by place
};

template <class Sectors>
std::vector<Edge> edges_of(std::span<const Vec3> nodes, const EdgeRules& rules, double spacing,
                           const std::stop_token& stop) {
  const auto targets = Search<Sectors>(nodes, rules, spacing).run(stop);

  // Two nodes that chose each other share one edge, the lower one's. No branch: which do cannot be foreseen.
  const auto has_chosen = [&](std::uint32_t a, std::uint32_t b) {
    std::uint32_t found = 0;
#pragma GCC unroll 1  // unrolled, the compiler would not compare four at a time
    for (const std::uint32_t target : targets[a]) found += target == b ? 1 : 0;
    return found != 0;
  };
  std::vector<Edge> edges;
  edges.reserve(nodes.size() * Sectors::kCount * 3 / 4);
  for (std::uint32_t node = 0; node < nodes.size(); ++node) {
    std::size_t count = edges.size();
    edges.resize(count + Sectors::kCount);
    for (const std::uint32_t target : targets[node]) {
      edges[count] = {node, target};
      const std::uint32_t other = target == kNone ? node : target;
      count += (target != kNone) & ((target > node) | !has_chosen(other, node));
    }
    edges.resize(count);
  }
  return edges;
}

}  // namespace

std::vector<Edge> yao_edges(std::span<const Vec3> nodes, const EdgeRules& rules, int sectors, double spacing,
                            std::stop_token stop) {
  assert(sectors == 6 || sectors == 8 || sectors == 14);
  if (sectors == 6) return edges_of<CubeFaces>(nodes, rules, spacing, stop);
  if (sectors == 14) return edges_of<FacesAndCorners>(nodes, rules, spacing, stop);
  return edges_of<Octants>(nodes, rules, spacing, stop);
}

}  // namespace ramify::pathplan
