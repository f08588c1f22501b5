#include "growth/shadow_grid.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <tuple>

#include "common/base/large_pages.h"
#include "common/base/parallel.h"

namespace ramify::growth {
namespace {

// Nodes of 128 voxels above the leaves and none above those: a tree is not much wider.
using Voxels = openvdb::tree::Tree3<Shadow, 4, kLeafShift>::Type;
using Leaf = Voxels::LeafNodeType;
static_assert(Leaf::DIM == kLeafEdge && Leaf::SIZE == kLeafSize);

// Leaves in the same large page that are worth one: half of it.
constexpr std::uint32_t kLeavesToGather = 512;

// Casters that are worth more than one thread.
constexpr std::size_t kCastersToShare = 1024;

/// Casters that stand in one leaf: those that come from begin to before middle, those that go up to end.
struct Group {
  Coord leaf{0};
  Coord low{0};  // box of the casters
  Coord high{0};
  std::size_t begin = 0;
  std::size_t middle = 0;
  std::size_t end = 0;
};

/// Groups of leaves with one x, from begin to before end.
struct Column {
  int x = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Casters sorted by leaf, and leaves by x, z and y.
struct Groups {
  std::vector<Group> groups;
  std::vector<Coord> casters;

  std::span<const Group> of(const Column& column) const {
    return std::span(groups).subspan(column.begin, column.end - column.begin);
  }
  std::span<const Coord> added(const Group& group) const {
    return std::span(casters).subspan(group.begin, group.middle - group.begin);
  }
  std::span<const Coord> removed(const Group& group) const {
    return std::span(casters).subspan(group.middle, group.end - group.middle);
  }
};

/// Those that come, then those that go.
struct CasterList {
  std::span<const Coord> added;
  std::span<const Coord> removed;

  std::size_t size() const { return added.size() + removed.size(); }
  bool is_added(std::size_t i) const { return i < added.size(); }
  const Coord& operator[](std::size_t i) const { return is_added(i) ? added[i] : removed[i - added.size()]; }
};

Groups grouped(const CasterList& casters, const std::vector<std::uint32_t>& leaf_of_caster,
               std::uint32_t leaf_count) {
  Groups result;
  std::vector<std::uint32_t> group_of_leaf(leaf_count, 0);  // its place + 1
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const Coord& caster = casters[i];
    std::uint32_t& place = group_of_leaf[leaf_of_caster[i]];
    if (place == 0) {
      result.groups.push_back(
          {.leaf = leaf_of(caster), .low = caster, .high = caster, .begin = leaf_of_caster[i]});
      place = static_cast<std::uint32_t>(result.groups.size());
    }
    Group& group = result.groups[place - 1];
    group.low = glm::min(group.low, caster);
    group.high = glm::max(group.high, caster);
    group.middle += casters.is_added(i) ? 1 : 0;  // counts for now
    ++group.end;
  }
  std::sort(result.groups.begin(), result.groups.end(), [](const Group& a, const Group& b) {
    return std::tie(a.leaf.x, a.leaf.z, a.leaf.y) < std::tie(b.leaf.x, b.leaf.z, b.leaf.y);
  });
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < result.groups.size(); ++i) {
    Group& group = result.groups[i];
    group_of_leaf[group.begin] = i;  // begin held the leaf's number
    const std::size_t count = group.end;
    group.begin = group.end = next;
    group.middle += next;
    next += count;
  }
  result.casters.resize(casters.size());
  for (std::size_t i = 0; i < casters.size(); ++i) {
    result.casters[result.groups[group_of_leaf[leaf_of_caster[i]]].end++] = casters[i];
  }
  return result;
}

std::vector<Column> columns_of(const std::vector<Group>& groups) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (columns.empty() || columns.back().x != groups[i].leaf.x) columns.push_back({groups[i].leaf.x, i, i});
    columns.back().end = i + 1;
  }
  return columns;
}

// Voxels that are added to in one instruction. Unsigned, so that a sum past the largest shadow wraps instead
// of being undefined.
using Quad [[gnu::vector_size(kQuad * sizeof(Shadow))]] = std::uint32_t;

Quad load(const Shadow* values) {
  Quad quad;
  std::memcpy(&quad, values, sizeof quad);
  return quad;
}

void store(Shadow* values, const Quad& quad) {
  std::memcpy(values, &quad, sizeof quad);
}

/// What the casters of a group change in the shadow, gathered as differences along x and then added to the
/// leaves at once: a caster costs the edges of its shadow only.
class GroupShadow {
 public:
  explicit GroupShadow(const ShadowStencil& stencil, const LeafTable& leaves)
      : stencil_(stencil), leaves_(leaves) {}

  /// All leaves that it falls in must be there.
  void apply(const Groups& groups, const Group& group) {
    frame(group.low + stencil_.low(), group.high + stencil_.high());
    for (const Coord& caster : groups.added(group)) gather<true>(caster - low_);
    for (const Coord& caster : groups.removed(group)) gather<false>(caster - low_);
    for (int y = 0; y < size_.y; ++y) {
      for (int z = 0; z < size_.z; z += kQuad) sweep(y, z);
    }
  }

 private:
  void frame(const Coord& low, const Coord& high) {
    low_ = {low.x, low.y, low.z & -kQuad};
    size_ = high - low_ + 1;
    // Behind the last quad there is room for the zeros that fill a change up, behind the last x for its end.
    row_size_ = (size_.z + kQuad - 1) / kQuad * kQuad + kQuad;
    const auto count = static_cast<std::size_t>((size_.x + 1) * size_.y * row_size_);
    if (differences_.size() < count) differences_.resize(count, 0);

    first_leaf_ = leaf_of(low);
    last_leaf_ = leaf_of(high);
    buffers_.clear();
    for (int y = first_leaf_.y; y <= last_leaf_.y; ++y) {
      for (int z = first_leaf_.z; z <= last_leaf_.z; ++z) {
        for (int x = first_leaf_.x; x <= last_leaf_.x; ++x) {
          buffers_.push_back(leaves_.buffer(leaves_.find({x, y, z})));
        }
      }
    }
  }

  Shadow* difference_at(const Coord& place) {
    return differences_.data() + (place.y * (size_.x + 1) + place.x) * row_size_ + place.z;
  }

  /// The leaf that holds a voxel; those beyond it along x follow.
  Shadow* const* leaf_at(const Coord& voxel) const {
    const Coord place = leaf_of(voxel) - first_leaf_;
    const Coord size = last_leaf_ - first_leaf_ + 1;
    return buffers_.data() + (place.y * size.z + place.z) * size.x + place.x;
  }

  template <bool is_cast>
  void gather(const Coord& caster) {
    for (const ShadowStencil::Change& change : stencil_.changes()) {
      Shadow* values = difference_at(caster + change.first);
      for (std::size_t i = 0; i < change.amounts.size(); i += kQuad) {
        const Quad amount = load(change.amounts.data() + i);
        store(values + i, is_cast ? load(values + i) + amount : load(values + i) - amount);
      }
    }
  }

  /// Sums the differences in the rows of one y, a quad wide along z, adds the sums to the leaves and forgets
  /// the differences.
  void sweep(int y, int z) {
    constexpr int kNextRow = kLeafEdge * kLeafEdge;
    const Coord first = low_ + Coord(0, y, z);
    const std::uint32_t row = place_in_leaf({0, first.y, first.z});
    Shadow* const* leaf = leaf_at(first);
    Shadow* differences = difference_at({0, y, z});
    Quad sum{};
    for (int x = first.x; x < first.x + size_.x; ++leaf) {
      const int end = std::min(first.x + size_.x, (x | (kLeafEdge - 1)) + 1);
      for (Shadow* values = *leaf + row + (x & (kLeafEdge - 1)) * kNextRow; x < end; ++x) {
        sum += load(differences);
        store(differences, Quad{});
        store(values, load(values) + sum);
        differences += row_size_;
        values += kNextRow;
      }
    }
    store(differences, Quad{});
  }

  const ShadowStencil& stencil_;
  const LeafTable& leaves_;
  Coord low_{0};  // of the frame
  Coord size_{0};
  int row_size_ = 0;
  std::vector<Shadow> differences_;  // by y, x and z; all 0 between groups
  Coord first_leaf_{0};
  Coord last_leaf_{0};
  std::vector<Shadow*> buffers_;  // of the leaves, by y, z and x
};

}  // namespace

struct ShadowGrid::Tree {
  Voxels voxels{0};
};

ShadowGrid::ShadowGrid(const Penumbra& penumbra, double voxel_size)
    : voxel_size_(voxel_size), stencil_(penumbra), tree_(std::make_unique<Tree>()) {}

ShadowGrid::~ShadowGrid() = default;

std::uint32_t ShadowGrid::touch(const Coord& leaf) {
  const std::uint32_t number = leaves_.find(leaf);
  if (number != 0) return number;
  leaves_.reserve(leaf, leaf);
  const openvdb::Coord origin(leaf.x * kLeafEdge, leaf.y * kLeafEdge, leaf.z * kLeafEdge);
  Shadow* const buffer = tree_->voxels.touchLeaf(origin)->buffer().data();
  if (++leaves_in_page_[large_page_of(buffer)] == kLeavesToGather) gather_in_large_page(buffer);
  return leaves_.add(leaf, buffer);
}

void ShadowGrid::touch_all(const Coord& first, const Coord& last) {
  for (int x = first.x; x <= last.x; ++x) {
    for (int y = first.y; y <= last.y; ++y) {
      for (int z = first.z; z <= last.z; ++z) touch({x, y, z});
    }
  }
}

void ShadowGrid::change(std::span<const Coord> added, std::span<const Coord> removed) {
  const CasterList casters{added, removed};
  std::vector<std::uint32_t> leaf_of_caster(casters.size());
  for (std::size_t i = 0; i < casters.size(); ++i) leaf_of_caster[i] = touch(leaf_of(casters[i]));
  const Groups groups = grouped(casters, leaf_of_caster, leaves_.count());
  for (const Group& group : groups.groups) {
    touch_all(leaf_of(group.low + stencil_.low()), leaf_of(group.high + stencil_.high()));
  }

  // Columns so far apart that no two of them write to one leaf are done side by side.
  const std::vector<Column> columns = columns_of(groups.groups);
  const int apart = (stencil_.high().x - stencil_.low().x + 2 * (kLeafEdge - 1)) / kLeafEdge + 1;
  for (int phase = 0; phase < apart; ++phase) {
    std::vector<Column> of_phase;
    std::copy_if(columns.begin(), columns.end(), std::back_inserter(of_phase),
                 [&](const Column& column) { return (column.x % apart + apart) % apart == phase; });
    const std::size_t grain = casters.size() < kCastersToShare ? of_phase.size() + 1 : 1;
    parallel_for(of_phase.size(), grain, [&](std::size_t begin, std::size_t end) {
      GroupShadow shadow(stencil_, leaves_);
      for (std::size_t i = begin; i < end; ++i) {
        for (const Group& group : groups.of(of_phase[i])) shadow.apply(groups, group);
      }
    });
  }
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
