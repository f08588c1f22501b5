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
template <class T>
T picked(bool condition, T yes, T no) {
  return no ^ ((yes ^ no) & (T{0} - static_cast<T>(condition)));
}

struct Octants {
  static constexpr int kCount = 8;
  static int of(const Vec3& d) { return (d.x < 0.0 ? 1 : 0) + (d.y < 0.0 ? 2 : 0) + (d.z < 0.0 ? 4 : 0); }
  /// On which side of the node the sector lies along an axis: -1, 1, or 0 for both.
  static int side(int sector, int axis) { return (sector >> axis & 1) != 0 ? -1 : 1; }
};

struct CubeFaces {
  static constexpr int kCount = 6;
  static int of(const Vec3& d) {
    const Vec3 a = glm::abs(d);
    const bool is_x = (a.x >= a.y) & (a.x >= a.z);
    const bool is_y = a.y >= a.z;
    const int along_x = d.x < 0.0 ? 1 : 0;
    const int along_y = d.y < 0.0 ? 3 : 2;
    const int along_z = d.z < 0.0 ? 5 : 4;
    return picked(is_x, along_x, picked(is_y, along_y, along_z));
  }
  static int side(int sector, int axis) { return axis != sector / 2 ? 0 : (sector % 2 != 0 ? -1 : 1); }
};

/// The directions to a cube's faces, numbered as above, and to its corners, numbered as octants: that which
/// is nearest by angle, a face's if two are.
struct FacesAndCorners {
  static constexpr int kCount = CubeFaces::kCount + Octants::kCount;
  static int of(const Vec3& d) {
    const Vec3 a = glm::abs(d);
    const double most = std::max({a.x, a.y, a.z});
    const double sum = a.x + a.y + a.z;
    // The cosine to a face is most / |d|, to a corner sum / (sqrt(3) |d|).
    const bool is_corner = sum * sum > 3.0 * most * most;
    return picked(is_corner, CubeFaces::kCount + Octants::of(d), CubeFaces::of(d));
  }
  static int side(int sector, int axis) {
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

/// The nodes of a cell and of those around it, by rising number.
struct Block {
  std::vector<std::uint32_t> ids;
  std::vector<Vec3> points;

  void gather(const PointGrid& grid, const PointGrid::Cells& cells, std::span<const Vec3> nodes) {
    ids.clear();
    grid.for_each_run(
        cells, [&](std::span<const std::uint32_t> run) { ids.insert(ids.end(), run.begin(), run.end()); });
    // Nodes that are numbered in the order of cells are sorted already, all but the root.
    if (!std::is_sorted(ids.begin(), ids.end())) std::sort(ids.begin(), ids.end());
    points.resize(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) points[i] = nodes[ids[i]];
  }
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
    Block block;
    for (std::size_t cell = cell_begin; cell < cell_end; ++cell) {
      const std::span<const std::uint32_t> own = grid_.ids_in(cell);
      if (own.empty()) continue;
      const PointGrid::Cells around = grid_.around(cell);
      const Box seen = grid_.covered_by(around);
      block.gather(grid_, around, nodes_);
      for (const std::uint32_t node : own) targets[node] = targets_of(node, block, seen);
    }
  }

 private:
  static double cell_edge(std::size_t nodes, double spacing) {
    return nodes <= kOneCellUpTo ? std::numeric_limits<double>::infinity() : kCellSpacings * spacing;
  }

  /// All sectors at once in the block; then each on its own that may have a nearer node farther out, or
  /// whose node is not allowed.
  Targets targets_of(std::uint32_t node, const Block& block, const Box& seen) const {
    std::array<Nearest, Sectors::kCount> nearest = nearest_in(block, nodes_[node]);
    Targets targets;
    for (int sector = 0; sector < Sectors::kCount; ++sector) {
      Nearest& best = nearest[sector];
      const bool is_allowed = best.node == kNone || rules_.allows(node, best.node);
      if (!is_allowed) best = none();
      const double reach = seen_reach(seen, nodes_[node], sector);
      if (!is_allowed || best.square >= reach * reach) look_farther(node, sector, best);
      targets[sector] = best.node;
    }
    return targets;
  }

  Nearest none() const { return {.square = rules_.max_length() * rules_.max_length()}; }

  /// The nearest node in each sector around `position`, one just there left out, whatever the rules allow.
  /// Which of two is nearer cannot be foreseen, so the loop has no branch: 1.8 times as fast.
  std::array<Nearest, Sectors::kCount> nearest_in(const Block& block, const Vec3& position) const {
    // Squares of distances compare as the whole numbers with the same bits do. Less 1, so that 0, which the
    // node itself has, becomes the greatest; numbers rise, so that the lower of equals stays.
    std::array<std::uint64_t, Sectors::kCount> key;
    std::array<std::uint32_t, Sectors::kCount> place;
    key.fill(std::bit_cast<std::uint64_t>(none().square));
    place.fill(kNone);
    for (std::uint32_t i = 0; i < block.points.size(); ++i) {
      const Vec3 d = block.points[i] - position;
      const std::uint64_t new_key = std::bit_cast<std::uint64_t>(glm::dot(d, d)) - 1;
      const int sector = Sectors::of(d);
      const bool is_nearer = new_key < key[sector];
      key[sector] = picked(is_nearer, new_key, key[sector]);
      place[sector] = picked(is_nearer, i, place[sector]);
    }

    std::array<Nearest, Sectors::kCount> nearest;
    nearest.fill(none());
    for (int sector = 0; sector < Sectors::kCount; ++sector) {
      if (place[sector] == kNone) continue;
      nearest[sector] = {std::bit_cast<double>(key[sector] + 1), block.ids[place[sector]]};
    }
    return nearest;
  }

  /// How far all of a sector has been seen.
  static double seen_reach(const Box& seen, const Vec3& position, int sector) {
    double reach = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const int side = Sectors::side(sector, axis);
      if (side >= 0) reach = std::min(reach, seen.high[axis] - position[axis]);
      if (side <= 0) reach = std::min(reach, position[axis] - seen.low[axis]);
    }
    return reach;
  }

  /// The sector's part of the box that can hold a better node than the best so far.
  void look_farther(std::uint32_t node, int sector, Nearest& best) const {
    const Vec3 position = nodes_[node];
    const double reach = std::sqrt(best.square) * (1.0 + 1e-12);  // rounding must not hide a node
    Box box{position, position};
    for (int axis = 0; axis < 3; ++axis) {
      const int side = Sectors::side(sector, axis);
      if (side >= 0) box.high[axis] += reach;
      if (side <= 0) box.low[axis] -= reach;
    }
    grid_.for_each_run(grid_.touching(box), [&](std::span<const std::uint32_t> run) {
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
