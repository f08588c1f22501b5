#include "pathplan/yao_graph.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "common/base/parallel.h"
#include "pathplan/near_nodes.h"
#include "pathplan/point_grid.h"
#include "pathplan/yao_sectors.h"

namespace ramify::pathplan {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

// Layers of cells a task: enough that the one that is gone through twice does not show.
constexpr std::size_t kGrain = 16;

// If there is but one sector, nearly all nodes have another within this distance, in spacings.
constexpr double kFirstReach = 1.2;

// Rounding must not put nodes two cells apart that are within the first reach of each other.
constexpr double kCellSlack = 1.0 + 1e-9;

/// The nearest node of a sector so far: the square of its distance in single precision, whose bits compare
/// like the number that they stand for, then its place.
using Nearest = std::uint64_t;
constexpr Nearest kNothing = ~Nearest{0};  // not a number, near to none

Nearest nearest_at(float square, std::uint32_t place) {
  return Nearest{std::bit_cast<std::uint32_t>(square)} << 32 | place;
}

std::uint32_t place_of(Nearest nearest) {
  return static_cast<std::uint32_t>(nearest);
}

float square_of(Nearest nearest) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(nearest >> 32));
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
        rounded_(nodes, grid_),
        way_error_(rounded_.way_error()),
        square_error_(rounded_.square_error(first_reach_)),
        doubt_(3.0f * square_error_) {}

  /// By node.
  std::unique_ptr<const Targets[]> run(const std::stop_token& stop) const {
    auto targets = std::make_unique_for_overwrite<Targets[]>(nodes_.size());
    const std::size_t window = std::bit_ceil(grid_.places_ahead() + kLanes);
    parallel_for(grid_.cell_count(), kGrain * grid_.cells_ahead(), [&](std::size_t begin, std::size_t end) {
      NearNodes near(rounded_);
      NearestAhead nearest(window);
      for (std::size_t cell = begin - std::min(begin, grid_.cells_ahead()); cell < end; ++cell) {
        const bool is_stopped = stop.stop_requested();
        if (!is_stopped) compare_from(cell, near, nearest);
        // The nodes of this cell have met all others now.
        const std::uint32_t first = first_place(cell);
        for (std::uint32_t place = first; place < first + grid_.ids_in(cell).size(); ++place) {
          const Sides sides = nearest.take(place);
          if (cell < begin) continue;
          targets[grid_.order()[place]] = is_stopped ? no_targets() : targets_of(place, sides, near);
        }
      }
    });
    return targets;
  }

 private:
  using Sides = std::array<Nearest, Sectors::kCount>;

  /// What is nearest to the nodes that pairs are being met of: those from a cell on to its last neighbour. So
  /// few stay in the processor's cache.
  class NearestAhead {
   public:
    /// Places, a power of 2.
    explicit NearestAhead(std::size_t size) : sides_(size, nothing()) {}
    Sides& operator[](std::uint32_t place) { return sides_[place & (sides_.size() - 1)]; }
    Sides take(std::uint32_t place) { return std::exchange((*this)[place], nothing()); }

   private:
    static Sides nothing() {
      Sides nothing;
      nothing.fill(kNothing);
      return nothing;
    }
    std::vector<Sides> sides_;
  };

  static double first_reach(double spacing) {
    // All sectors are as large, and share the volume.
    return kFirstReach * std::cbrt(double{Sectors::kCount}) * spacing;
  }

  static Targets no_targets() {
    Targets targets;
    targets.fill(kNone);
    return targets;
  }

  std::uint32_t first_place(std::size_t cell) const {
    return static_cast<std::uint32_t>(grid_.ids_in(cell).data() - grid_.order().data());
  }

  /// Offers the nodes of a cell and those ahead of them to each other that are within the first reach,
  /// whatever the rules allow.
  void compare_from(std::size_t cell, NearNodes& near, NearestAhead& nearest) const {
    const std::size_t count = grid_.ids_in(cell).size();
    if (count == 0) return;
    near.gather_ahead(cell);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t place = first_place(cell) + i;
      Sides& sides = nearest[place];
      for (const std::uint32_t other : near.ahead_of(i, first_reach_)) {
        Sides& sides_of_other = nearest[other];
        const Lanes way = rounded_.way(place, other);
        const float square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
        Sector sector = Sectors::of_rounded(way, way_error_);
        Sector opposite = Sectors::opposite(sector);
        if (sector == kInDoubt) [[unlikely]] {
          const Vec3 d = position_of(other) - position_of(place);
          if (glm::dot(d, d) == 0.0) continue;
          sector = Sectors::of(d);
          opposite = Sectors::of(-d);
        }
        offer(sides[sector], square, place, other);
        offer(sides_of_other[opposite], square, other, place);
      }
    }
  }

  const Vec3& position_of(std::uint32_t place) const { return nodes_[grid_.order()[place]]; }

  /// `other`, at a distance from the node at `place`, for its nearest.
  void offer(Nearest& nearest, float square, std::uint32_t place, std::uint32_t other) const {
    const Nearest offered = nearest_at(square, other);
    if (std::abs(square - square_of(nearest)) <= doubt_) [[unlikely]] {
      if (is_before(other, place, place_of(nearest))) nearest = offered;
      return;
    }
    // Which of two is nearer cannot be foreseen, so this is no branch.
    nearest = std::min(nearest, offered);
  }

  /// Whether `other` comes before the nearest one so far, when looked at closely.
  bool is_before(std::uint32_t other, std::uint32_t place, std::uint32_t nearest) const {
    const std::uint64_t rank = rank_of(square_between(place, other));
    const std::uint64_t nearest_rank = rank_of(square_between(place, nearest));
    return rank < nearest_rank || (rank == nearest_rank && grid_.order()[other] < grid_.order()[nearest]);
  }

  double square_between(std::uint32_t place, std::uint32_t other) const {
    const Vec3 d = position_of(other) - position_of(place);
    return glm::dot(d, d);
  }

  /// What the pairs have shown; where that is nothing sure, or not allowed, a sector is looked at on its own.
  Targets targets_of(std::uint32_t place, const Sides& sides, NearNodes& near) const {
    const std::uint32_t node = grid_.order()[place];
    const bool is_all = first_reach_ == rules_.max_length();
    // Of what is farther, some is not within the first reach.
    const auto sure = static_cast<float>(first_reach_ * first_reach_) - 2.0f * square_error_;
    Targets targets;
    for (Sector sector = 0; sector < Sectors::kCount; ++sector) {
      const std::uint32_t nearest = place_of(sides[sector]);
      targets[sector] = nearest == kNone ? kNone : grid_.order()[nearest];
      if (nearest == kNone ? is_all
                           : square_of(sides[sector]) <= sure && rules_.allows(node, targets[sector])) {
        continue;
      }
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
      const Sector rounded = Sectors::of_rounded(rounded_.way(place, other), way_error_);
      if (rounded != sector && rounded != kInDoubt) continue;
      const Vec3 d = position_of(other) - position;
      const double square = glm::dot(d, d);
      if (square > reach * reach || square == 0.0 || Sectors::of(d) != sector) continue;
      if (nearest != kNone && !is_before(other, place, nearest)) continue;
      if (rules_.allows(grid_.order()[place], grid_.order()[other])) nearest = other;
    }
    return nearest == kNone ? kNone : grid_.order()[nearest];
  }

  std::span<const Vec3> nodes_;
  const EdgeRules& rules_;
  double first_reach_;
  PointGrid grid_;
  RoundedNodes rounded_;
  float way_error_;     // of a rounded coordinate
  float square_error_;  // of the square of a rounded distance
  float doubt_;         // two such squares must differ by more, to tell which distance is shorter
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
