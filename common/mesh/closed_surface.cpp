#include "common/mesh/closed_surface.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <memory>
#include <numeric>
#include <optional>
#include <span>

#include "common/base/errors.h"
#include "common/base/parallel.h"

namespace ramify {
namespace {

using Grid = openvdb::FloatTree;
using Leaf = Grid::LeafNodeType;
using Accessor = openvdb::tree::ValueAccessor<const Grid, false>;

constexpr int kLeafSide = 8;
constexpr int kBlockSide = 4;  // cones too far to matter are left out block by block
constexpr int kWindow = kLeafSide + 1;

// Values are cut off here, in voxels: beyond what is active.
constexpr double kClampVoxels = 3.0;

// A blend of cones can change a little faster than the distance does.
constexpr double kForkSteepness = 1.5;

// Vertices stay so far, in voxels, from the walls of their cell, so that no triangle is too thin for floats.
constexpr double kCellMargin = 0.05;

// What a voxel is set to that is filled to keep the surface a manifold, in voxels.
constexpr double kFilled = -0.05;

// Of gradients by differences, in voxels.
constexpr double kDifference = 0.1;

// Cosine of the greatest angle between a vertex's normal and its triangles'.
constexpr float kFacing = 0.5f;

constexpr std::uint32_t kNoVertex = 0xffffffff;
constexpr std::uint32_t kOnEdge = 0x80000000;  // an index among a leaf's own edge vertices

openvdb::Coord leaf_corner(const Coord& leaf) {
  return {leaf.x * kLeafSide, leaf.y * kLeafSide, leaf.z * kLeafSide};
}

/// Where the voxel of an index stands: between whole multiples of its size, so that a flat end at the origin
/// is not in a row of voxels.
Vec3 place_of(const openvdb::Coord& voxel, double size) {
  return (Vec3(voxel.x(), voxel.y(), voxel.z()) + 0.5) * size;
}

/// Cones and forks under one number: cones first.
class Items {
 public:
  explicit Items(const WoodField& field)
      : field_(field), cone_count_(static_cast<std::uint32_t>(field.cones.size())) {}

  std::size_t size() const { return cone_count_ + field_.forks.size(); }
  bool is_cone(std::uint32_t item) const { return item < cone_count_; }
  const RoundCone& cone(std::uint32_t item) const { return field_.cones[item]; }
  const Fork& fork(std::uint32_t item) const { return field_.forks[item - cone_count_]; }

  double distance(std::uint32_t item, const Vec3& point) const {
    return is_cone(item) ? cone(item).distance(point).value : field_.distance(fork(item), point);
  }

  Box bounds(std::uint32_t item) const {
    if (is_cone(item)) return cone(item).bounds();
    Box box;
    box.include(fork(item).center - fork(item).zone);
    box.include(fork(item).center + fork(item).zone);
    return box;
  }

  /// Whether the item can shape the surface within `radius` of `center`.
  bool can_matter(std::uint32_t item, const Vec3& center, double radius) const {
    if (is_cone(item)) return cone(item).distance(center).value <= radius;
    const bool is_in_zone = glm::length(center - fork(item).center) <= fork(item).zone + radius;
    return is_in_zone && distance(item, center) <= kForkSteepness * radius;
  }

  double union_distance(std::span<const std::uint32_t> items, const Vec3& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t item : items) least = std::min(least, distance(item, point));
    return least;
  }

  /// Of the cones among `items`.
  std::uint32_t nearest_internode(std::span<const std::uint32_t> items, const Vec3& point) const {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (const std::uint32_t item : items) {
      if (!is_cone(item)) continue;
      const double value = cone(item).distance(point).value;
      if (value < least) {
        least = value;
        nearest = cone(item).internode();
      }
    }
    return nearest;
  }

  /// The field and its gradient from four differences; the gradient is a unit vector.
  Distance sample(std::span<const std::uint32_t> items, const Vec3& point, double step) const {
    static const std::array<Vec3, 4> kCorners = {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1),
                                                 Vec3(-1, -1, 1)};
    Vec3 gradient(0.0);
    double sum = 0.0;
    for (const Vec3& corner : kCorners) {
      const double value = union_distance(items, point + corner * step);
      gradient += corner * value;
      sum += value;
    }
    return {0.25 * sum, normalized_or(gradient, kUp, 1e-300)};
  }

 private:
  const WoodField& field_;
  std::uint32_t cone_count_;
};

/// The items that touch each leaf of the grid.
struct Touched {
  std::vector<Coord> leaves;         // in units of leaves
  std::vector<std::size_t> first;    // of each leaf's items; one more at the end
  std::vector<std::uint32_t> items;  // in ascending order for each leaf

  std::span<const std::uint32_t> of(std::size_t leaf) const {
    return std::span(items).subspan(first[leaf], first[leaf + 1] - first[leaf]);
  }
};

struct Touch {
  std::uint64_t leaf;
  std::uint32_t item;
  friend auto operator<=>(const Touch&, const Touch&) = default;
};

constexpr int kKeyBits = 21;
constexpr int kKeyBias = 1 << (kKeyBits - 1);

std::uint64_t key_of(const Coord& leaf) {
  const auto part = [](int value) { return static_cast<std::uint64_t>(value + kKeyBias); };
  return (part(leaf.x) << (2 * kKeyBits)) | (part(leaf.y) << kKeyBits) | part(leaf.z);
}

Coord leaf_of(std::uint64_t key) {
  const auto part = [&](int shift) {
    return static_cast<int>((key >> shift) & ((1u << kKeyBits) - 1)) - kKeyBias;
  };
  return {part(2 * kKeyBits), part(kKeyBits), part(0)};
}

/// Finds leaves by halves: a cube of them that an item cannot reach is left out as a whole.
class LeafFinder {
 public:
  LeafFinder(const Items& items, double voxel_size) : items_(items), voxel_size_(voxel_size) {}

  void add(std::uint32_t item, std::vector<Touch>& touches) const {
    const Box box = items_.bounds(item);
    const double margin = kBandVoxels * voxel_size_;
    const Coord low = leaf_at(box.low - margin);
    const Coord high = leaf_at(box.high + margin);
    for (int x = low.x; x <= high.x; x += kCube) {
      for (int y = low.y; y <= high.y; y += kCube) {
        for (int z = low.z; z <= high.z; z += kCube) add_cube(item, {x, y, z}, high, touches);
      }
    }
  }

  Vec3 center(const Coord& leaf, int cube = 1) const {
    const Vec3 corner = Vec3(leaf) * static_cast<double>(kLeafSide);
    return (corner + 0.5 * kLeafSide * cube) * voxel_size_;
  }

  /// Of the ball about a cube of leaves, with the band beyond it.
  double radius(int cube = 1) const {
    return (0.5 * std::numbers::sqrt3 * kLeafSide * cube + kBandVoxels) * voxel_size_;
  }

 private:
  static constexpr int kCube = 4;

  Coord leaf_at(const Vec3& point) const { return Coord(glm::floor(point / (voxel_size_ * kLeafSide))); }

  void add_cube(std::uint32_t item, const Coord& first, const Coord& high,
                std::vector<Touch>& touches) const {
    if (!items_.can_matter(item, center(first, kCube), radius(kCube))) return;
    const Coord last = glm::min(first + (kCube - 1), high);
    for (int x = first.x; x <= last.x; ++x) {
      for (int y = first.y; y <= last.y; ++y) {
        for (int z = first.z; z <= last.z; ++z) {
          const Coord leaf(x, y, z);
          if (items_.can_matter(item, center(leaf), radius())) touches.push_back({key_of(leaf), item});
        }
      }
    }
  }

  const Items& items_;
  double voxel_size_;
};

/// Every cone that reaches a leaf, deep inside it too; then the leaves that lie deep inside a cone are left
/// out.
Touched touched_leaves(const Items& items, double voxel_size) {
  constexpr std::size_t kChunk = 256;
  const LeafFinder finder(items, voxel_size);
  std::vector<std::vector<Touch>> chunks((items.size() + kChunk - 1) / kChunk);
  parallel_for(chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      const std::size_t last = std::min(items.size(), (chunk + 1) * kChunk);
      for (std::size_t item = chunk * kChunk; item < last; ++item) {
        finder.add(static_cast<std::uint32_t>(item), chunks[chunk]);
      }
    }
  });
  std::vector<Touch> touches;
  for (std::vector<Touch>& chunk : chunks) {
    touches.insert(touches.end(), chunk.begin(), chunk.end());
    chunk = {};
  }
  std::sort(touches.begin(), touches.end());

  Touched result;
  for (std::size_t begin = 0, end = 0; begin < touches.size(); begin = end) {
    const Coord leaf = leaf_of(touches[begin].leaf);
    const Vec3 center = finder.center(leaf);
    double depth = 0.0;
    for (end = begin; end < touches.size() && touches[end].leaf == touches[begin].leaf; ++end) {
      depth = std::min(depth, items.distance(touches[end].item, center));
    }
    if (depth < -finder.radius() * kForkSteepness) continue;
    result.leaves.push_back(leaf);
    result.first.push_back(result.items.size());
    for (std::size_t i = begin; i < end; ++i) result.items.push_back(touches[i].item);
  }
  result.first.push_back(result.items.size());
  return result;
}

/// The values of a leaf's voxels.
class Rasteriser {
 public:
  Rasteriser(const Items& items, double voxel_size) : items_(items), voxel_size_(voxel_size) {}

  /// Returns how many voxels are active.
  std::size_t fill(Leaf& leaf, std::span<const std::uint32_t> touching) const {
    std::size_t active = 0;
    std::vector<std::uint32_t> near;
    for (int x = 0; x < kLeafSide; x += kBlockSide) {
      for (int y = 0; y < kLeafSide; y += kBlockSide) {
        for (int z = 0; z < kLeafSide; z += kBlockSide) {
          active += fill_block(leaf, leaf.origin().offsetBy(x, y, z), touching, near);
        }
      }
    }
    return active;
  }

 private:
  std::size_t fill_block(Leaf& leaf, const openvdb::Coord& corner, std::span<const std::uint32_t> touching,
                         std::vector<std::uint32_t>& near) const {
    const Vec3 center = place_of(corner, voxel_size_) + 0.5 * (kBlockSide - 1) * voxel_size_;
    const double radius = (0.5 * std::numbers::sqrt3 * (kBlockSide - 1) + kClampVoxels) * voxel_size_;
    near.clear();
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t item : touching) {
      if (items_.is_cone(item)) nearest = std::min(nearest, items_.cone(item).distance(center).value);
    }
    // A cone farther than the nearest one everywhere in the block does not shape it.
    const double reach = nearest + 2.0 * (radius - kClampVoxels * voxel_size_);
    for (const std::uint32_t item : touching) {
      const bool is_cone = items_.is_cone(item);
      if (is_cone && items_.cone(item).distance(center).value > reach) continue;
      if (!is_cone && !items_.can_matter(item, center, radius)) continue;
      near.push_back(item);
    }
    std::size_t active = 0;
    const double limit = kClampVoxels * voxel_size_;
    for (int i = 0; i < kBlockSide * kBlockSide * kBlockSide; ++i) {
      const openvdb::Coord voxel = corner.offsetBy(i / 16, i / 4 % 4, i % 4);
      const double value = items_.union_distance(near, place_of(voxel, voxel_size_));
      active += std::abs(value) < kBandVoxels * voxel_size_;
      leaf.setValueOnly(voxel, static_cast<float>(std::clamp(value, -limit, limit)));
    }
    return active;
  }

  const Items& items_;
  double voxel_size_;
};

/// The voxels of a leaf and their neighbours on the upper sides.
struct Window {
  std::array<float, kWindow * kWindow * kWindow> values;

  static constexpr int index(int x, int y, int z) { return (x * kWindow + y) * kWindow + z; }
  float at(int x, int y, int z) const { return values[static_cast<std::size_t>(index(x, y, z))]; }

  Window(const Leaf& leaf, const Accessor& voxels) {
    for (int x = 0; x < kWindow; ++x) {
      for (int y = 0; y < kWindow; ++y) {
        for (int z = 0; z < kWindow; ++z) {
          const bool is_inside = x < kLeafSide && y < kLeafSide && z < kLeafSide;
          values[static_cast<std::size_t>(index(x, y, z))] =
              is_inside ? leaf.getValue(static_cast<openvdb::Index>((x * kLeafSide + y) * kLeafSide + z))
                        : voxels.getValue(leaf.origin().offsetBy(x, y, z));
        }
      }
    }
  }
};

/// The eight corners of a cell, corner i at (i / 4, i / 2 % 2, i % 2).
using Corners = std::array<float, 8>;

Corners corners_of(const Window& window, int x, int y, int z) {
  Corners corners{};
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] = window.at(x + i / 4, y + i / 2 % 2, z + i % 2);
  return corners;
}

unsigned signs_of(const Corners& corners) {
  unsigned signs = 0;
  for (unsigned i = 0; i < 8; ++i) signs |= static_cast<unsigned>(corners[i] < 0.0f) << i;
  return signs;
}

/// The corners outside that meet only at an edge or a corner with what they separate: filling one mends the
/// cell. 0 if the cell is well-composed.
constexpr unsigned ambiguous_corners(unsigned signs) {
  unsigned result = 0;
  for (unsigned low = 0; low < 8; ++low) {
    for (const auto& [b, c] : {std::pair(1u, 2u), std::pair(1u, 4u), std::pair(2u, 4u)}) {
      if ((low & b) != 0 || (low & c) != 0) continue;
      const unsigned diagonal = (1u << low) | (1u << (low | b | c));
      const unsigned other = (1u << (low | b)) | (1u << (low | c));
      const unsigned face = signs & (diagonal | other);
      if (face == diagonal) result |= other;
      if (face == other) result |= diagonal;
    }
  }
  for (unsigned corner = 0; corner < 4; ++corner) {
    const unsigned diagonal = (1u << corner) | (1u << (7 - corner));
    if (signs == diagonal) result |= 0xffu & ~diagonal;
    if (signs == (0xffu & ~diagonal)) result |= diagonal;
  }
  return result;
}

constexpr auto kAmbiguous = [] {
  std::array<unsigned, 256> table{};
  for (unsigned signs = 0; signs < 256; ++signs) table[signs] = ambiguous_corners(signs);
  return table;
}();

/// One vertex a cell, at most four triangles a grid edge.
class Contour {
 public:
  Contour(const WoodField& field, double voxel_size)
      : items_(field), voxel_size_(voxel_size), touched_(touched_leaves(items_, voxel_size)) {}

  ClosedSurface surface() {
    rasterise();
    fill_ambiguous();
    mark_cells();
    place_vertices();
    join_vertices();
    return std::move(surface_);
  }

 private:
  /// Vertices on grid edges, and triangles, of one leaf.
  struct LeafPart {
    std::vector<Vec3> edge_vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
  };

  template <class Body>
  void for_each_leaf(Body body) const {
    parallel_for(leaves_.size(), 16, [&](std::size_t begin, std::size_t end) {
      const Accessor voxels(*grid_);
      for (std::size_t i = begin; i < end; ++i) body(i, voxels);
    });
  }

  void rasterise() {
    const auto background = static_cast<float>(kClampVoxels * voxel_size_);
    grid_ = std::make_unique<Grid>(background);
    leaves_.resize(touched_.leaves.size());
    std::vector<std::size_t> active(leaves_.size(), 0);
    const Rasteriser rasteriser(items_, voxel_size_);
    parallel_for(leaves_.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        leaves_[i] = new Leaf(leaf_corner(touched_.leaves[i]), background, true);  // the grid will own it
        active[i] = rasteriser.fill(*leaves_[i], touched_.of(i));
      }
    });
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      leaves_[i]->setTransientData(static_cast<openvdb::Index32>(i));
      grid_->addLeaf(leaves_[i]);
    }
    surface_.active_voxels = std::accumulate(active.begin(), active.end(), std::size_t{0});
    openvdb::tools::signedFloodFill(*grid_);
  }

  /// Fills voxels, nearest to the surface first, until no two parts of the inside or of the outside touch at
  /// an edge or a corner alone: then the surface has one sheet in each cell.
  void fill_ambiguous() {
    std::vector<std::vector<openvdb::Coord>> found(leaves_.size());
    for_each_leaf([&](std::size_t i, const Accessor& voxels) {
      const Window window(*leaves_[i], voxels);
      for_each_cell([&](int x, int y, int z) {
        if (kAmbiguous[signs_of(corners_of(window, x, y, z))] == 0) return;
        found[i].push_back(leaves_[i]->origin().offsetBy(x, y, z));
      });
    });
    std::deque<openvdb::Coord> cells;
    for (const auto& list : found) cells.insert(cells.end(), list.begin(), list.end());
    openvdb::tree::ValueAccessor<Grid, false> voxels(*grid_);
    while (!cells.empty()) {
      const openvdb::Coord cell = cells.front();
      cells.pop_front();
      const std::optional<openvdb::Coord> filled = fill_one(cell, voxels);
      if (!filled) continue;
      for (int i = 0; i < 8; ++i) cells.push_back(filled->offsetBy(-(i / 4), -(i / 2 % 2), -(i % 2)));
    }
  }

  template <class AnyAccessor>
  std::optional<openvdb::Coord> fill_one(const openvdb::Coord& cell, AnyAccessor& voxels) const {
    Corners corners{};
    const auto corner = [&](unsigned i) {
      return cell.offsetBy(static_cast<int>(i / 4), static_cast<int>(i / 2 % 2), static_cast<int>(i % 2));
    };
    for (unsigned i = 0; i < 8; ++i) corners[i] = voxels.getValue(corner(i));
    const unsigned ambiguous = kAmbiguous[signs_of(corners)];
    if (ambiguous == 0) return std::nullopt;
    unsigned best = 8;
    for (unsigned i = 0; i < 8; ++i) {
      const bool is_candidate = (ambiguous >> i & 1u) != 0;
      if (is_candidate && (best == 8 || corners[i] < corners[best])) best = i;
    }
    voxels.setValueOnly(corner(best), static_cast<float>(kFilled * voxel_size_));
    return corner(best);
  }

  template <class Body>
  static void for_each_cell(Body body) {
    for (int x = 0; x < kLeafSide; ++x) {
      for (int y = 0; y < kLeafSide; ++y) {
        for (int z = 0; z < kLeafSide; ++z) body(x, y, z);
      }
    }
  }

  /// From here on a leaf's mask says which of its cells have a vertex.
  void mark_cells() {
    std::vector<Leaf::NodeMaskType> masks(leaves_.size());
    for_each_leaf([&](std::size_t i, const Accessor& voxels) {
      const Window window(*leaves_[i], voxels);
      for_each_cell([&](int x, int y, int z) {
        const unsigned signs = signs_of(corners_of(window, x, y, z));
        if (signs != 0 && signs != 0xff) masks[i].setOn(Leaf::coordToOffset(openvdb::Coord(x, y, z)));
      });
    });
    first_vertex_.assign(leaves_.size() + 1, 0);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      leaves_[i]->setValueMask(masks[i]);
      first_vertex_[i + 1] = first_vertex_[i] + masks[i].countOn();
    }
    if (first_vertex_.back() >= kOnEdge)
      throw RunError("watertight: more than 2^31 vertices (larger voxels)");
  }

  std::uint32_t vertex_of(const openvdb::Coord& cell, const Accessor& voxels) const {
    const Leaf* leaf = voxels.probeConstLeaf(cell);
    const openvdb::Index offset = Leaf::coordToOffset(cell);
    const auto& mask = leaf->valueMask();
    std::uint32_t rank = 0;
    for (openvdb::Index word = 0; word < offset / 64; ++word) {
      rank += static_cast<std::uint32_t>(std::popcount(mask.getWord<openvdb::Index64>(word)));
    }
    const openvdb::Index64 below = (openvdb::Index64{1} << (offset % 64)) - 1;
    rank += static_cast<std::uint32_t>(std::popcount(mask.getWord<openvdb::Index64>(offset / 64) & below));
    return static_cast<std::uint32_t>(first_vertex_[leaf->transientData()]) + rank;
  }

  void set_vertex(std::size_t vertex, const Vec3& at, std::span<const std::uint32_t> near) {
    surface_.positions[vertex] = Vec3f(at);
    surface_.normals[vertex] = Vec3f(items_.sample(near, at, kDifference * voxel_size_).gradient);
    surface_.internodes[vertex] = items_.nearest_internode(near, at);
  }

  void resize_vertices(std::size_t count) {
    surface_.positions.resize(count);
    surface_.normals.resize(count);
    surface_.internodes.resize(count);
  }

  /// Amid the places where the surface crosses the cell's edges, then moved onto the surface.
  void place_vertices() {
    resize_vertices(first_vertex_.back());
    for_each_leaf([&](std::size_t i, const Accessor& voxels) {
      const Window window(*leaves_[i], voxels);
      std::size_t vertex = first_vertex_[i];
      for (auto cell = leaves_[i]->beginValueOn(); cell; ++cell) {
        const openvdb::Coord local = Leaf::offsetToLocalCoord(cell.pos());
        const Vec3 corner = place_of(cell.getCoord(), voxel_size_);
        Vec3 at = corner + amid_crossings(corners_of(window, local.x(), local.y(), local.z())) * voxel_size_;
        for (int step = 0; step < 2; ++step) {
          const Distance here = items_.sample(touched_.of(i), at, kDifference * voxel_size_);
          const Vec3 moved = (at - here.gradient * here.value - corner) / voxel_size_;
          at = corner + glm::clamp(moved, kCellMargin, 1.0 - kCellMargin) * voxel_size_;
        }
        set_vertex(vertex++, at, touched_.of(i));
      }
    });
  }

  /// In voxels from the cell's first corner.
  static Vec3 amid_crossings(const Corners& corners) {
    Vec3 sum(0.0);
    int crossings = 0;
    for (unsigned low = 0; low < 8; ++low) {
      for (const unsigned bit : {1u, 2u, 4u}) {
        if ((low & bit) != 0 || (corners[low] < 0.0f) == (corners[low | bit] < 0.0f)) continue;
        const double t = corners[low] / (static_cast<double>(corners[low]) - corners[low | bit]);
        Vec3 at(low / 4, low / 2 % 2, low % 2);
        at[bit == 4 ? 0 : (bit == 2 ? 1 : 2)] = t;
        sum += at;
        ++crossings;
      }
    }
    return sum / static_cast<double>(crossings);
  }

  void join_vertices() {
    std::vector<LeafPart> parts(leaves_.size());
    for_each_leaf([&](std::size_t i, const Accessor& voxels) {
      const Window window(*leaves_[i], voxels);
      for_each_cell([&](int x, int y, int z) {
        for (int axis = 0; axis < 3; ++axis) add_quad(i, {x, y, z}, axis, window, voxels, parts[i]);
      });
    });
    std::vector<std::size_t> first_triangle(parts.size() + 1, 0);
    std::vector<std::size_t> first_on_edge(parts.size() + 1, first_vertex_.back());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      first_triangle[i + 1] = first_triangle[i] + parts[i].triangles.size();
      first_on_edge[i + 1] = first_on_edge[i] + parts[i].edge_vertices.size();
    }
    resize_vertices(first_on_edge.back());
    surface_.triangles.resize(first_triangle.back());
    parallel_for(parts.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t e = 0; e < parts[i].edge_vertices.size(); ++e) {
          set_vertex(first_on_edge[i] + e, parts[i].edge_vertices[e], touched_.of(i));
        }
        std::size_t next = first_triangle[i];
        for (auto triangle : parts[i].triangles) {
          for (std::uint32_t& vertex : triangle) {
            if ((vertex & kOnEdge) == 0) continue;
            vertex = static_cast<std::uint32_t>(first_on_edge[i] + (vertex & ~kOnEdge));
          }
          surface_.triangles[next++] = triangle;
        }
      }
    });
  }

  /// The triangles about the grid edge that leaves a voxel along `axis`, if the surface crosses it.
  void add_quad(std::size_t leaf, const Coord& voxel, int axis, const Window& window, const Accessor& voxels,
                LeafPart& part) const {
    Coord step(0);
    step[axis] = 1;
    const float from = window.at(voxel.x, voxel.y, voxel.z);
    const float to = window.at(voxel.x + step.x, voxel.y + step.y, voxel.z + step.z);
    if ((from < 0.0f) == (to < 0.0f)) return;

    // The four cells around the edge, counter-clockwise seen from its end: from outside, if that is there.
    const openvdb::Coord last = leaves_[leaf]->origin().offsetBy(voxel.x, voxel.y, voxel.z);
    openvdb::Coord b(0, 0, 0);
    openvdb::Coord c(0, 0, 0);
    b[(axis + 1) % 3] = 1;
    c[(axis + 2) % 3] = 1;
    std::array<std::uint32_t, 4> ring = {vertex_of(last - b - c, voxels), vertex_of(last - c, voxels),
                                         vertex_of(last, voxels), vertex_of(last - b, voxels)};
    if (to < 0.0f) std::swap(ring[1], ring[3]);
    const Vec3 start = place_of(last, voxel_size_);
    const Vec3 end = start + Vec3(step) * voxel_size_;
    const std::optional<int> diagonal = safe_diagonal(ring, start, end);
    if (diagonal) {
      const auto d = static_cast<std::size_t>(*diagonal);
      part.triangles.push_back({ring[d], ring[d + 1], ring[d + 2]});
      part.triangles.push_back({ring[d], ring[d + 2], ring[(d + 3) % 4]});
      return;
    }
    const double t = std::clamp(from / (static_cast<double>(from) - to), kCellMargin, 1.0 - kCellMargin);
    const std::uint32_t middle = kOnEdge | static_cast<std::uint32_t>(part.edge_vertices.size());
    part.edge_vertices.push_back(start + (end - start) * t);
    for (std::size_t i = 0; i < 4; ++i) part.triangles.push_back({middle, ring[i], ring[(i + 1) % 4]});
  }

  /// The shorter of the diagonals (0: from the ring's first vertex, 1: from the second) whose triangles stay
  /// within the four tetrahedra about the grid edge, which no other quad enters: those that pass between the
  /// edge and one of the other two vertices.
  std::optional<int> safe_diagonal(const std::array<std::uint32_t, 4>& ring, const Vec3& start,
                                   const Vec3& end) const {
    std::array<Vec3, 4> at;
    for (std::size_t i = 0; i < 4; ++i) at[i] = Vec3(surface_.positions[ring[i]]);
    const auto passes = [&](const Vec3& from, const Vec3& to, const Vec3& side) {
      const double a = glm::dot(glm::cross(start - from, end - from), to - from);
      const double b = glm::dot(glm::cross(end - from, side - from), to - from);
      const double c = glm::dot(glm::cross(side - from, start - from), to - from);
      return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
    };
    std::optional<int> best;
    double shortest = std::numeric_limits<double>::infinity();
    for (int d = 0; d < 2; ++d) {
      const auto i = static_cast<std::size_t>(d);
      const Vec3& from = at[i];
      const Vec3& to = at[i + 2];
      const double length = glm::length(to - from);
      const bool is_safe = passes(from, to, at[i + 1]) || passes(from, to, at[(i + 3) % 4]);
      if (!is_safe || length >= shortest) continue;
      best = d;
      shortest = length;
    }
    return best;
  }

  Items items_;
  double voxel_size_;
  Touched touched_;
  std::unique_ptr<Grid> grid_;
  std::vector<Leaf*> leaves_;
  std::vector<std::size_t> first_vertex_;  // of each leaf; one more at the end
  ClosedSurface surface_;
};

/// Of a triangle, twice its area long.
Vec3 facing(const ClosedSurface& surface, const std::array<std::uint32_t, 3>& triangle) {
  const Vec3 a(surface.positions[triangle[0]]);
  return glm::cross(Vec3(surface.positions[triangle[1]]) - a, Vec3(surface.positions[triangle[2]]) - a);
}

/// Drops the pieces that enclose a hollow: those whose volume is negative.
void fill_hollows(ClosedSurface& surface) {
  std::vector<std::uint32_t> leader(surface.positions.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  for (const auto& triangle : surface.triangles) {
    const std::uint32_t first = find(triangle[0]);
    leader[find(triangle[1])] = first;
    leader[find(triangle[2])] = first;
  }
  std::vector<double> volume(surface.positions.size(), 0.0);
  for (const auto& triangle : surface.triangles) {
    volume[find(triangle[0])] += glm::dot(Vec3(surface.positions[triangle[0]]), facing(surface, triangle));
  }
  if (std::none_of(volume.begin(), volume.end(), [](double v) { return v < 0.0; })) return;
  auto& triangles = surface.triangles;
  const auto is_hollow = [&](const auto& triangle) { return volume[find(triangle[0])] < 0.0; };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_hollow), triangles.end());
  drop_unused_vertices(surface);
}

/// In a crease the field has no one gradient: there a vertex faces as its triangles do.
void mend_normals(ClosedSurface& surface) {
  BulkVector<Vec3f> sums(surface.positions.size(), Vec3f(0.0f));
  for (const auto& triangle : surface.triangles) {
    const Vec3f outwards(facing(surface, triangle));
    for (const std::uint32_t vertex : triangle) sums[vertex] += outwards;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const float length = glm::length(sums[v]);
    if (length > 0.0f && glm::dot(surface.normals[v], sums[v]) < kFacing * length)
      surface.normals[v] = sums[v] / length;
  }
}

}  // namespace

ClosedSurface closed_surface(const WoodField& field, double voxel_size) {
  Box bounds;
  for (const RoundCone& cone : field.cones) bounds.include(cone.bounds());
  const double farthest = std::max(glm::length(bounds.low), glm::length(bounds.high));
  if (farthest / (voxel_size * kLeafSide) > kKeyBias - 8) {
    throw RunError(
        fmt::format("watertight: voxels of {} m are too small for a tree that reaches {} m from the "
                    "origin (larger voxels)",
                    voxel_size, farthest));
  }
  openvdb::initialize();
  ClosedSurface surface = Contour(field, voxel_size).surface();
  fill_hollows(surface);
  mend_normals(surface);
  return surface;
}

std::vector<std::uint32_t> drop_unused_vertices(ClosedSurface& surface) {
  std::vector<std::uint32_t> place(surface.positions.size(), kNoVertex);
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t vertex : triangle) place[vertex] = 0;
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == kNoVertex) continue;
    place[v] = static_cast<std::uint32_t>(kept.size());
    surface.positions[kept.size()] = surface.positions[v];
    surface.normals[kept.size()] = surface.normals[v];
    surface.internodes[kept.size()] = surface.internodes[v];
    kept.push_back(v);
  }
  surface.positions.resize(kept.size());
  surface.normals.resize(kept.size());
  surface.internodes.resize(kept.size());
  for (auto& triangle : surface.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = place[vertex];
  }
  return kept;
}

}  // namespace ramify
