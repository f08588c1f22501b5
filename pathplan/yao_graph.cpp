#include "pathplan/yao_graph.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "common/base/parallel.h"
#include "pathplan/point_grid.h"

namespace ramify::pathplan {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

// Cells a task: enough that starting one does not show.
constexpr std::size_t kGrain = 256;

// So few nodes are looked at faster than sorted into cells.
constexpr std::size_t kOneCellUpTo = 160;

/// `condition ? yes : no`, of which the compiler would make a branch.
std::uint64_t picked(bool condition, std::uint64_t yes, std::uint64_t no) {
  return no ^ ((yes ^ no) & (std::uint64_t{0} - std::uint64_t{condition}));
}

// As wide as a coordinate: the compiler then works out two at a time.
using Sector = std::uint64_t;

struct Octants {
  static constexpr int kCount = 8;
  static Sector of(const Vec3& d) {
    return Sector{d.x < 0.0} + 2 * Sector{d.y < 0.0} + 4 * Sector{d.z < 0.0};
  }
  /// On which side of the node the sector lies along an axis: -1, 1, or 0 for both.
  static int side(Sector sector, int axis) { return (sector >> axis & 1) != 0 ? -1 : 1; }
};

struct CubeFaces {
  static constexpr int kCount = 6;
  static Sector of(const Vec3& d) {
    const Vec3 a = glm::abs(d);
    const bool is_x = (a.x >= a.y) & (a.x >= a.z);
    const bool is_y = a.y >= a.z;
    const Sector along_x{d.x < 0.0};
    const Sector along_y = 2 + Sector{d.y < 0.0};
    const Sector along_z = 4 + Sector{d.z < 0.0};
    return picked(is_x, along_x, picked(is_y, along_y, along_z));
  }
  static int side(Sector sector, int axis) {
    return static_cast<Sector>(axis) != sector / 2 ? 0 : (sector % 2 != 0 ? -1 : 1);
  }
};

/// The directions to a cube's faces, numbered as above, and to its corners, numbered as octants: that which
/// is nearest by angle, a face's if two are.
struct FacesAndCorners {
  static constexpr int kCount = CubeFaces::kCount + Octants::kCount;
  static Sector of(const Vec3& d) {
    const Vec3 a = glm::abs(d);
    const double most = std::max({a.x, a.y, a.z});
    const double sum = a.x + a.y + a.z;
    // The cosine to a face is most / |d|, to a corner sum / (sqrt(3) |d|).
    const bool is_corner = sum * sum > 3.0 * most * most;
    return picked(is_corner, CubeFaces::kCount + Octants::of(d), CubeFaces::of(d));
  }
  static int side(Sector sector, int axis) {
    return sector < CubeFaces::kCount ? CubeFaces::side(sector, axis)
                                      : Octants::side(sector - CubeFaces::kCount, axis);
  }
};

/// The best node found for a sector so far.
struct Nearest {
  double square;  // of its distance, or of the greatest allowed one
  std::uint32_t node = kNone;

  bool is_beaten_by(double other_square, std::uint32_t other) const {
    return other_square < square || (other_square == square && other < node);
  }
};

/// Sorts numbers that are all different.
class Sorter {
 public:
  /// All numbers are less than `bound`.
  explicit Sorter(std::size_t bound) : words_(bound / 64 + 1) {}

  void sort(std::vector<std::uint32_t>& ids) {
    if (std::is_sorted(ids.begin(), ids.end())) return;
    if (words_ > kWordsPerNumber * ids.size()) return std::sort(ids.begin(), ids.end());
    marks_.resize(words_, 0);
    for (const std::uint32_t id : ids) marks_[id / 64] |= std::uint64_t{1} << id % 64;
    ids.clear();
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      for (; marks_[i] != 0; marks_[i] &= marks_[i] - 1) {
        ids.push_back(static_cast<std::uint32_t>(64 * i) +
                      static_cast<std::uint32_t>(std::countr_zero(marks_[i])));
      }
    }
  }

 private:
  // Words looked through for each number: comparing numbers takes longer.
  static constexpr std::size_t kWordsPerNumber = 8;

  std::size_t words_;
  std::vector<std::uint64_t> marks_;  // a bit a number
};

/// The nodes of a cell and of those around it, by rising number, and how they lie to one node.
struct Block {
  explicit Block(std::size_t nodes) : sorter(nodes) {}

  Sorter sorter;
  PointGrid::Cells cells;
  Box seen;  // all nodes in it are in the block
  std::vector<std::uint32_t> ids;
  std::vector<double> x, y, z;
  std::vector<std::uint64_t> keys;  // see Search::nearest_in()
  std::vector<Sector> sectors;

  void gather(const PointGrid& grid, std::size_t cell, std::span<const Vec3> nodes) {
    cells = grid.around(cell);
    seen = grid.covered_by(cells);
    ids.clear();
    grid.for_each_run(
        cells, [&](std::span<const std::uint32_t> run) { ids.insert(ids.end(), run.begin(), run.end()); });
    // Many nodes are numbered in the order of cells, all but the root, and sorted already; few are not.
    sorter.sort(ids);
    for (std::vector<double>* axis : {&x, &y, &z}) axis->resize(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Vec3& node = nodes[ids[i]];
      x[i] = node.x;
      y[i] = node.y;
      z[i] = node.z;
    }
    keys.resize(ids.size());
    sectors.resize(ids.size());
  }

  Vec3 way_to(std::size_t i, const Vec3& from) const { return {x[i] - from.x, y[i] - from.y, z[i] - from.z}; }
};

/// The nearest allowed node in each sector, for any node.
template <class Sectors>
class Search {
 public:
  using Targets = std::array<std::uint32_t, Sectors::kCount>;  // kNone in an empty sector

  Search(std::span<const Vec3> nodes, const EdgeRules& rules, double spacing)
      : nodes_(nodes), rules_(rules), grid_(nodes, cell_edge(nodes.size(), spacing)) {}

  std::size_t cell_count() const { return grid_.cell_count(); }

  /// Sets targets[node] for all nodes in a range of cells.
  void run(std::size_t cell_begin, std::size_t cell_end, std::span<Targets> targets) const {
    Block block(nodes_.size());
    for (std::size_t cell = cell_begin; cell < cell_end; ++cell) {
      const std::span<const std::uint32_t> own = grid_.ids_in(cell);
      if (own.empty()) continue;
      block.gather(grid_, cell, nodes_);
      for (const std::uint32_t node : own) targets[node] = targets_of(node, block);
    }
  }

 private:
  static double cell_edge(std::size_t nodes, double spacing) {
    return nodes <= kOneCellUpTo ? std::numeric_limits<double>::infinity() : kCellSpacings * spacing;
  }

  /// All sectors at once in the block; then each on its own that may have a nearer node farther out, or
  /// whose node is not allowed.
  Targets targets_of(std::uint32_t node, Block& block) const {
    std::array<Nearest, Sectors::kCount> nearest = nearest_in(block, nodes_[node]);
    Targets targets;
    for (Sector sector = 0; sector < Sectors::kCount; ++sector) {
      Nearest& best = nearest[sector];
      if (best.node != kNone && !rules_.allows(node, best.node)) {
        best = none();
        look_farther(node, sector, {}, best);
      } else {
        const double reach = seen_reach(block.seen, nodes_[node], sector);
        if (best.square >= reach * reach) look_farther(node, sector, block.cells, best);
      }
      targets[sector] = best.node;
    }
    return targets;
  }

  Nearest none() const { return {.square = rules_.max_length() * rules_.max_length()}; }

  /// The nearest node in each sector around `position`, one just there left out, whatever the rules allow.
  std::array<Nearest, Sectors::kCount> nearest_in(Block& block, const Vec3& position) const {
    // Squares of distances compare as the whole numbers with the same bits do. Less 1, so that 0, which the
    // node itself has, becomes the greatest. The last bits, some part in 10^12, make room for the place in
    // the block: numbers rise, so that the lower of equals is the lesser.
    const std::size_t count = block.ids.size();
    const std::uint64_t place_bits = std::bit_ceil(count + 1) - 1;
    std::uint64_t* const keys = block.keys.data();
    Sector* const sectors = block.sectors.data();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 d = block.way_to(i, position);
      keys[i] = ((std::bit_cast<std::uint64_t>(glm::dot(d, d)) - 1) & ~place_bits) | i;
      sectors[i] = Sectors::of(d);
    }

    // Which of two is nearer cannot be foreseen, so this loop has no branch.
    const std::uint64_t farthest = std::bit_cast<std::uint64_t>(none().square) | place_bits;
    std::array<std::uint64_t, Sectors::kCount> least;
    least.fill(farthest);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint64_t& best = least[sectors[i]];
      best = picked(keys[i] < best, keys[i], best);
    }

    std::array<Nearest, Sectors::kCount> nearest;
    nearest.fill(none());
    for (int sector = 0; sector < Sectors::kCount; ++sector) {
      if (least[sector] == farthest) continue;
      const std::size_t place = least[sector] & place_bits;
      const Vec3 d = block.way_to(place, position);
      const double square = glm::dot(d, d);
      if (square <= none().square) nearest[sector] = {square, block.ids[place]};
    }
    return nearest;
  }

  /// How far all of a sector has been seen.
  static double seen_reach(const Box& seen, const Vec3& position, Sector sector) {
    double reach = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const int side = Sectors::side(sector, axis);
      if (side >= 0) reach = std::min(reach, seen.high[axis] - position[axis]);
      if (side <= 0) reach = std::min(reach, position[axis] - seen.low[axis]);
    }
    return reach;
  }

  /// The sector's part of the box that can hold a better node than the best so far, without cells that have
  /// been seen.
  void look_farther(std::uint32_t node, Sector sector, const PointGrid::Cells& seen, Nearest& best) const {
    const Vec3 position = nodes_[node];
    const double reach = std::sqrt(best.square) * (1.0 + 1e-12);  // rounding must not hide a node
    Box box{position, position};
    for (int axis = 0; axis < 3; ++axis) {
      const int side = Sectors::side(sector, axis);
      if (side >= 0) box.high[axis] += reach;
      if (side <= 0) box.low[axis] -= reach;
    }
    grid_.for_each_run_outside(seen, grid_.touching(box), [&](std::span<const std::uint32_t> run) {
      for (const std::uint32_t other : run) {
        const Vec3 d = nodes_[other] - position;
        if (Sectors::of(d) != sector || other == node) continue;
        const double square = glm::dot(d, d);
        if (best.is_beaten_by(square, other) && rules_.allows(node, other)) best = {square, other};
      }
    });
  }

  std::span<const Vec3> nodes_;
  const EdgeRules& rules_;
  PointGrid grid_;
};

template <class Sectors>
std::vector<Edge> edges_of(std::span<const Vec3> nodes, const EdgeRules& rules, double spacing,
                           const std::stop_token& stop) {
  const Search<Sectors> search(nodes, rules, spacing);
  typename Search<Sectors>::Targets none;
  none.fill(kNone);
  std::vector<typename Search<Sectors>::Targets> targets(nodes.size(), none);
  parallel_for(search.cell_count(), kGrain, [&](std::size_t begin, std::size_t end) {
    if (!stop.stop_requested()) search.run(begin, end, targets);
  });

  // Two nodes that chose each other share one edge, the lower one's.
  const auto has_chosen = [&](std::uint32_t a, std::uint32_t b) {
    return std::find(targets[a].begin(), targets[a].end(), b) != targets[a].end();
  };
  std::vector<Edge> edges;
  edges.reserve(nodes.size() * Sectors::kCount * 3 / 4);
  for (std::uint32_t node = 0; node < nodes.size(); ++node) {
    for (const std::uint32_t target : targets[node]) {
      if (target == kNone || (target < node && has_chosen(target, node))) continue;
      edges.push_back({node, target});
    }
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
