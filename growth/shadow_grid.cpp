#include "growth/shadow_grid.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>

#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

using Leaf = openvdb::Int32Tree::LeafNodeType;
static_assert(Leaf::DIM == kLeafEdge && Leaf::SIZE == kLeafSize);

// Casters that are worth a task of their own: fewer are done on one thread.
constexpr std::size_t kCastersPerTask = 1024;

// More tasks than threads, that all are done at about the same time; each has its own slab of the world.
constexpr std::size_t kMaxTasks = 16;

/// Casters that stand in one leaf.
struct Group {
  Coord leaf{0};
  Coord low{0};  // box of the casters
  Coord high{0};
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Casters sorted by leaf, and leaves along x, z and y: what is added one after the other lies near each
/// other.
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
  std::stable_sort(result.groups.begin(), result.groups.end(), [](const Group& a, const Group& b) {
    return std::tie(a.leaf.y, a.leaf.z, a.leaf.x) < std::tie(b.leaf.y, b.leaf.z, b.leaf.x);
  });
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

/// Where the slabs of the tasks end: each has about as many casters. The last has no end.
std::vector<int> slab_ends(const std::vector<Group>& groups, std::size_t caster_count) {
  const std::size_t tasks = std::clamp<std::size_t>(caster_count / kCastersPerTask, 1, kMaxTasks);
  std::map<int, std::size_t> casters_at;  // by x of their leaf
  for (const Group& group : groups) casters_at[group.leaf.x] += group.end - group.begin;
  std::vector<int> ends;
  std::size_t count = 0;
  for (const auto& [x, casters] : casters_at) {
    count += casters;
    if (count * tasks >= caster_count * (ends.size() + 1)) ends.push_back(x + 1);
  }
  ends.back() = std::numeric_limits<int>::max();
  return ends;
}

/// The leaves that the shadows of a group fall in.
class Window {
 public:
  /// All of them must be there.
  void open(const LeafTable& leaves, const Coord& first, const Coord& last) {
    first_ = first;
    size_ = last - first + 1;
    buffers_.clear();
    for (int x = first.x; x <= last.x; ++x) {
      for (int y = first.y; y <= last.y; ++y) {
        for (int z = first.z; z <= last.z; ++z) buffers_.push_back(leaves.buffer(leaves.find({x, y, z})));
      }
    }
  }

  /// The leaf that holds `voxel`; those beyond it along z follow.
  Shadow* const* leaf(const Coord& voxel) const {
    const Coord c = leaf_of(voxel) - first_;
    return buffers_.data() + (c.x * size_.y + c.y) * size_.z + c.z;
  }

 private:
  Coord first_{0};
  Coord size_{0};
  std::vector<Shadow*> buffers_;
};

// Voxels that are added to in one instruction. Unsigned, so that a sum past the largest shadow wraps instead
// of being undefined. The compiler does not find this by itself: it cannot know that shadows and amounts are
// apart.
using Four [[gnu::vector_size(16)]] = std::uint32_t;

/// A leaf's edge, each voxel added to or taken from.
template <bool is_cast>
void add_edge(Shadow* values, const Shadow* amounts) {
  for (int i = 0; i < kLeafEdge; i += 4) {
    Four sum;
    Four amount;
    std::memcpy(&sum, values + i, sizeof sum);
    std::memcpy(&amount, amounts + i, sizeof amount);
    sum = is_cast ? sum + amount : sum - amount;
    std::memcpy(values + i, &sum, sizeof sum);
  }
}

/// Adds the rows of a level that lie in the leaves of one x, `first` being the first row's place and amounts,
/// or takes them away. `wide` leaves side by side, known to the compiler where `known_wide` is not 0.
template <bool is_cast, int known_wide>
void add_rows(Shadow* const* leaves, std::uint32_t place, const Shadow* const* amounts, int count, int wide) {
  constexpr std::uint32_t kNextRow = kLeafEdge * kLeafEdge;
  for (int i = 0; i < count; ++i) {
    for (int z = 0; z < (known_wide > 0 ? known_wide : wide); ++z) {
      add_edge<is_cast>(leaves[z] + place, amounts[i] + z * kLeafEdge);
    }
    place += kNextRow;
  }
}

/// Adds what a caster's shadow has from x = `begin` to before `end`, or takes it away.
template <bool is_cast>
void add_shadow(const ShadowStencil& stencil, const Coord& caster, int begin, int end, const Window& window) {
  const int z = caster.z + stencil.low().z;
  const int wide = stencil.leaves_wide();
  for (const ShadowStencil::Level& level : stencil.levels()) {
    const int y = caster.y + level.y;
    const int first_x = caster.x + level.first_x;
    const int end_x = std::min(first_x + level.row_count(), end);
    const Shadow* const* amounts = level.amounts_at(caster.z & (kLeafEdge - 1));
    int x = std::max(first_x, begin);
    while (x < end_x) {
      const int stop = std::min(end_x, (x | (kLeafEdge - 1)) + 1);
      Shadow* const* leaves = window.leaf({x, y, z});
      const std::uint32_t place = place_in_leaf({x, y, 0});
      wide == 2 ? add_rows<is_cast, 2>(leaves, place, amounts + (x - first_x), stop - x, wide)
                : add_rows<is_cast, 0>(leaves, place, amounts + (x - first_x), stop - x, wide);
      x = stop;
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
  const auto first_leaf = [&](const Group& group) { return leaf_of(group.low + stencil_.low()); };
  const auto last_leaf = [&](const Group& group) {
    Coord last = leaf_of(group.high + stencil_.high());
    last.z = leaf_of(group.high + stencil_.low()).z + stencil_.leaves_wide() - 1;
    return last;
  };
  for (const Group& group : groups.groups) touch_all(first_leaf(group), last_leaf(group));

  // Each task has a slab of leaves of its own: no two write to one voxel.
  const std::vector<int> ends = slab_ends(groups.groups, casters.size());
  parallel_for(ends.size(), 1, [&](std::size_t first_task, std::size_t last_task) {
    Window window;
    for (std::size_t task = first_task; task < last_task; ++task) {
      const int begin = task == 0 ? std::numeric_limits<int>::min() : ends[task - 1] * kLeafEdge;
      const int end = task + 1 == ends.size() ? std::numeric_limits<int>::max() : ends[task] * kLeafEdge;
      for (const Group& group : groups.groups) {
        if (group.high.x + stencil_.high().x < begin || group.low.x + stencil_.low().x >= end) continue;
        window.open(leaves_, first_leaf(group), last_leaf(group));
        for (std::size_t i = group.begin; i < group.end; ++i) {
          add_shadow<is_cast>(stencil_, groups.casters[i], begin, end, window);
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
