#include "growth/shadow_grid.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

using Leaf = openvdb::Int32Tree::LeafNodeType;
static_assert(Leaf::DIM == kLeafEdge && Leaf::SIZE == kLeafSize);

// Casters that are worth more than one thread.
constexpr std::size_t kMinParallelCasters = 512;

// Leaves of one x that the widest stencil falls in: q_max 32, sheared by the lowest sun.
constexpr std::size_t kMaxWindow = 256;

/// Casters that stand in one leaf.
struct Group {
  Coord leaf{0};
  Coord low{0};  // box of the casters
  Coord high{0};
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Casters sorted by leaf, and leaves by x: what is added one after the other lies near each other.
struct Groups {
  std::vector<Group> groups;
  std::vector<Coord> casters;
};

Groups grouped(std::span<const Coord> casters, const std::vector<std::uint32_t>& leaf_of_caster,
               std::uint32_t leaf_count) {
  Groups result;
  std::vector<std::uint32_t> group_of_leaf(leaf_count, 0);  // its place + 1
  for (std::size_t i = 0; i < casters.size(); ++i) {
    std::uint32_t& place = group_of_leaf[leaf_of_caster[i]];
    if (place == 0) {
      result.groups.push_back({leaf_of(casters[i]), casters[i], casters[i], leaf_of_caster[i], 0});
      place = static_cast<std::uint32_t>(result.groups.size());
    }
    Group& group = result.groups[place - 1];
    group.low = glm::min(group.low, casters[i]);
    group.high = glm::max(group.high, casters[i]);
    ++group.end;  // a count for now
  }
  std::stable_sort(result.groups.begin(), result.groups.end(),
                   [](const Group& a, const Group& b) { return a.leaf.x < b.leaf.x; });
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < result.groups.size(); ++i) {
    Group& group = result.groups[i];
    group_of_leaf[group.begin] = i;  // begin held the leaf's number
    const std::size_t count = group.end;
    group.begin = group.end = next;
    next += count;
  }
  result.casters.resize(casters.size());
  for (std::size_t i = 0; i < casters.size(); ++i) {
    result.casters[result.groups[group_of_leaf[leaf_of_caster[i]]].end++] = casters[i];
  }
  return result;
}

/// The x of all leaves that shadows fall in, rising.
std::vector<int> columns_of(const std::vector<Group>& groups, const ShadowStencil& stencil) {
  std::vector<int> columns;
  for (const Group& group : groups) {
    const int last = leaf_of(group.high + stencil.high()).x;
    for (int x = leaf_of(group.low + stencil.low()).x; x <= last; ++x) columns.push_back(x);
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

/// Eight voxels at once, each added to or taken from. Unsigned, so that a sum past the largest shadow wraps
/// instead of being undefined; by way of copies, so that the compiler may do all eight together.
template <bool is_cast>
void add_edge(Shadow* values, const Shadow* amounts) {
  std::array<std::uint32_t, kLeafEdge> sum;
  std::array<std::uint32_t, kLeafEdge> amount;
  std::memcpy(sum.data(), values, sizeof sum);
  std::memcpy(amount.data(), amounts, sizeof amount);
  for (std::size_t i = 0; i < kLeafEdge; ++i) sum[i] = is_cast ? sum[i] + amount[i] : sum[i] - amount[i];
  std::memcpy(values, sum.data(), sizeof sum);
}

/// Adds what a caster's shadow has in the leaves of one x, or takes it away. All leaves must be there.
template <bool is_cast>
void add_slice(const ShadowStencil& stencil, const Coord& caster, int leaf_x, const LeafTable& leaves) {
  const Coord low = leaf_of(caster + stencil.low());
  const int last_y = leaf_of(caster + stencil.high()).y;
  const int wide = stencil.leaves_wide();
  std::array<Shadow*, kMaxWindow> window;
  std::size_t count = 0;
  for (int y = low.y; y <= last_y; ++y) {
    for (int z = low.z; z < low.z + wide; ++z) window[count++] = leaves.buffer(leaves.find({leaf_x, y, z}));
  }

  const int place = caster.z & (kLeafEdge - 1);
  const int low_x = leaf_x * kLeafEdge;
  for (const ShadowStencil::Level& level : stencil.levels()) {
    const int y = caster.y + level.y;
    Shadow* const* buffers = window.data() + ((y >> kLeafShift) - low.y) * wide;
    const int first_x = caster.x + level.first_x;
    const int end_x = std::min(first_x + static_cast<int>(level.patterns.size()), low_x + kLeafEdge);
    for (int x = std::max(first_x, low_x); x < end_x; ++x) {
      const std::uint32_t offset = place_in_leaf({x, y, 0});
      const Shadow* amounts = stencil.amounts(level.patterns[static_cast<std::size_t>(x - first_x)], place);
      for (int z = 0; z < wide; ++z) add_edge<is_cast>(buffers[z] + offset, amounts + z * kLeafEdge);
    }
  }
}

}  // namespace

struct ShadowGrid::Tree {
  openvdb::Int32Tree voxels{0};
};

ShadowGrid::ShadowGrid(const Penumbra& penumbra, double voxel_size)
    : voxel_size_(voxel_size), stencil_(penumbra), tree_(std::make_unique<Tree>()) {}

ShadowGrid::~ShadowGrid() = default;

std::uint32_t ShadowGrid::touch(const Coord& leaf) {
  const std::uint32_t number = leaves_.find(leaf);
  if (number != 0) return number;
  leaves_.reserve(leaf, leaf);
  const openvdb::Coord origin(leaf.x * kLeafEdge, leaf.y * kLeafEdge, leaf.z * kLeafEdge);
  return leaves_.add(leaf, tree_->voxels.touchLeaf(origin)->buffer().data());
}

void ShadowGrid::touch_all(const Coord& first, const Coord& last) {
  for (int x = first.x; x <= last.x; ++x) {
    for (int y = first.y; y <= last.y; ++y) {
      for (int z = first.z; z <= last.z; ++z) touch({x, y, z});
    }
  }
}

void ShadowGrid::cast(std::span<const Coord> casters) {
  add<true>(casters);
}

void ShadowGrid::uncast(std::span<const Coord> casters) {
  add<false>(casters);
}

template <bool is_cast>
void ShadowGrid::add(std::span<const Coord> casters) {
  if (casters.empty()) return;
  std::vector<std::uint32_t> leaf_of_caster(casters.size());
  for (std::size_t i = 0; i < casters.size(); ++i) leaf_of_caster[i] = touch(leaf_of(casters[i]));
  const Groups groups = grouped(casters, leaf_of_caster, leaves_.count());
  for (const Group& group : groups.groups) {
    Coord last = leaf_of(group.high + stencil_.high());
    last.z = leaf_of(group.high + stencil_.low()).z + stencil_.leaves_wide() - 1;
    touch_all(leaf_of(group.low + stencil_.low()), last);
  }

  // Each thread has columns of leaves of its own: no two write to one voxel.
  const std::vector<int> columns = columns_of(groups.groups, stencil_);
  const std::size_t grain = casters.size() < kMinParallelCasters ? columns.size() : 1;
  parallel_for(columns.size(), grain, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const int x = columns[i] * kLeafEdge;
      const int first_leaf = leaf_of(Coord(x) - stencil_.high()).x;
      const int last_leaf = leaf_of(Coord(x + kLeafEdge - 1) - stencil_.low()).x;
      auto group = std::lower_bound(groups.groups.begin(), groups.groups.end(), first_leaf,
                                    [](const Group& g, int leaf_x) { return g.leaf.x < leaf_x; });
      for (; group != groups.groups.end() && group->leaf.x <= last_leaf; ++group) {
        for (std::size_t j = group->begin; j < group->end; ++j) {
          const Coord& caster = groups.casters[j];
          const bool is_reached =
              caster.x + stencil_.low().x < x + kLeafEdge && caster.x + stencil_.high().x >= x;
          if (is_reached) add_slice<is_cast>(stencil_, caster, columns[i], leaves_);
        }
      }
    }
  });
}

void ShadowGrid::darken(std::span<const Coord> voxels, Shadow amount) {
  for (const Coord& voxel : voxels) leaves_.buffer(touch(leaf_of(voxel)))[place_in_leaf(voxel)] += amount;
}

Site ShadowGrid::site_of(const Coord& voxel) {
  return touch(leaf_of(voxel)) * kLeafSize + place_in_leaf(voxel);
}

VoxelLayer ShadowGrid::layer() const {
  VoxelLayer layer;
  layer.voxel_size = voxel_size_;
  for (auto leaf = tree_->voxels.cbeginLeaf(); leaf; ++leaf) {
    const Shadow* values = leaf->buffer().data();
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
      if (values[i] == 0) continue;
      const openvdb::Coord voxel = leaf->offsetToGlobalCoord(i);
      layer.voxels.emplace_back(voxel.x(), voxel.y(), voxel.z());
      layer.values.push_back(static_cast<float>(values[i] * kShadowUnit));
    }
  }
  return layer;
}

}  // namespace ramify::growth
