#include "growth/shadow_grid.h"

#include <openvdb/openvdb.h>

#include <algorithm>

namespace ramify::growth {
namespace {

using Tree = openvdb::Int32Tree;
using Leaf = Tree::LeafNodeType;

constexpr int kLeafEdge = Leaf::DIM;  // voxels
constexpr int kLeafShift = Leaf::LOG2DIM;
static_assert(kLeafEdge == 8);

// The table takes 8 bytes a leaf of its box, in shadow or not: at most 32 MB. Beyond that leaves are looked
// up in the tree.
constexpr std::int64_t kMaxTableSize = 1 << 22;

// Voxel indices stay where sums of a few of them cannot overflow.
constexpr double kMaxIndex = 1 << 28;

Coord leaf_of(const Coord& voxel) {
  return {voxel.x >> kLeafShift, voxel.y >> kLeafShift, voxel.z >> kLeafShift};
}

std::size_t offset_in_leaf(const Coord& voxel) {
  const int mask = kLeafEdge - 1;
  return static_cast<std::size_t>(((voxel.x & mask) << (2 * kLeafShift)) + ((voxel.y & mask) << kLeafShift) +
                                  (voxel.z & mask));
}

openvdb::Coord leaf_origin(const Coord& leaf) {
  return {leaf.x << kLeafShift, leaf.y << kLeafShift, leaf.z << kLeafShift};
}

}  // namespace

struct ShadowGrid::Field {
  Tree tree{0};
  Coord low{0};  // the table's box, in leaves; empty at first
  Coord size{0};
  std::vector<Shadow*> table;  // buffers of leaves, nullptr where there is none

  std::int64_t index_of(const Coord& leaf) const {
    const Coord c = leaf - low;
    const bool is_inside = c.x >= 0 && c.y >= 0 && c.z >= 0 && c.x < size.x && c.y < size.y && c.z < size.z;
    return is_inside ? (static_cast<std::int64_t>(c.x) * size.y + c.y) * size.z + c.z : -1;
  }

  const Shadow* find(const Coord& leaf) const {
    const std::int64_t index = index_of(leaf);
    if (index >= 0) return table[static_cast<std::size_t>(index)];
    const Leaf* found = tree.probeConstLeaf(leaf_origin(leaf));
    return found ? found->buffer().data() : nullptr;
  }

  Shadow* touch(const Coord& leaf) {
    const std::int64_t index = index_of(leaf);
    if (index < 0) return tree.touchLeaf(leaf_origin(leaf))->buffer().data();
    Shadow*& buffer = table[static_cast<std::size_t>(index)];
    if (!buffer) buffer = tree.touchLeaf(leaf_origin(leaf))->buffer().data();
    return buffer;
  }

  /// Widens the table to hold the leaves from `first` to `last`, with room for some more steps.
  void reserve(const Coord& first, const Coord& last) {
    if (index_of(first) >= 0 && index_of(last) >= 0) return;
    const bool is_empty = table.empty();
    const Coord tight_low = is_empty ? first : glm::min(low, first);
    const Coord tight_size = (is_empty ? last : glm::max(low + size - 1, last)) - tight_low + 1;
    const Coord margin = tight_size / 4 + 1;
    const Coord new_low = tight_low - margin;
    const Coord new_size = tight_size + 2 * margin;
    const double volume = double(new_size.x) * double(new_size.y) * double(new_size.z);
    if (volume > double(kMaxTableSize)) return;
    low = new_low;
    size = new_size;
    table.assign(static_cast<std::size_t>(volume), nullptr);
    for (auto leaf = tree.beginLeaf(); leaf; ++leaf) {
      const openvdb::Coord origin = leaf->origin();
      const std::int64_t index = index_of(leaf_of({origin.x(), origin.y(), origin.z()}));
      if (index >= 0) table[static_cast<std::size_t>(index)] = leaf->buffer().data();
    }
  }

  /// Adds `amount` to a run of voxels along z.
  void add_row(const Coord& first, int length, Shadow amount) {
    Coord voxel = first;
    const int end = first.z + length;
    while (voxel.z < end) {
      const int stop = std::min(end, (voxel.z | (kLeafEdge - 1)) + 1);
      Shadow* values = touch(leaf_of(voxel)) + offset_in_leaf(voxel);
      for (int i = 0; i < stop - voxel.z; ++i) {
        // Unsigned, so that a sum past the largest shadow wraps instead of being undefined.
        values[i] =
            static_cast<Shadow>(static_cast<std::uint32_t>(values[i]) + static_cast<std::uint32_t>(amount));
      }
      voxel.z = stop;
    }
  }

  void read_row(const Coord& first, int length, Shadow* values) const {
    Coord voxel = first;
    const int end = first.z + length;
    while (voxel.z < end) {
      const int stop = std::min(end, (voxel.z | (kLeafEdge - 1)) + 1);
      const Shadow* leaf = find(leaf_of(voxel));
      if (leaf) {
        std::copy_n(leaf + offset_in_leaf(voxel), stop - voxel.z, values);
      } else {
        std::fill_n(values, stop - voxel.z, Shadow{0});
      }
      values += stop - voxel.z;
      voxel.z = stop;
    }
  }
};

ShadowGrid::ShadowGrid(const Penumbra& penumbra, double voxel_size)
    : voxel_size_(voxel_size), field_(std::make_unique<Field>()) {
  for (int q = 0; q <= penumbra.q_max; ++q) {
    levels_.push_back(static_cast<Shadow>(std::lround(penumbra.a * std::pow(penumbra.b, -q) / kShadowUnit)));
  }
}

ShadowGrid::~ShadowGrid() = default;

Coord ShadowGrid::voxel_of(const Vec3& point) const {
  const Vec3 index = glm::floor(point / voxel_size_ + 0.5);
  return Coord(glm::clamp(index, Vec3(-kMaxIndex), Vec3(kMaxIndex)));
}

void ShadowGrid::cast(std::span<const Coord> casters) {
  add(casters, 1);
}

void ShadowGrid::uncast(std::span<const Coord> casters) {
  add(casters, -1);
}

void ShadowGrid::add(std::span<const Coord> casters, Shadow sign) {
  if (casters.empty()) return;
  const int q_max = static_cast<int>(levels_.size()) - 1;
  Coord low = casters.front();
  Coord high = casters.front();
  for (const Coord& caster : casters) {
    low = glm::min(low, caster);
    high = glm::max(high, caster);
  }
  field_->reserve(leaf_of(low - q_max), leaf_of(high + q_max));

  for (const Coord& caster : casters) {
    for (int q = 0; q <= q_max; ++q) {
      const Shadow amount = sign * levels_[static_cast<std::size_t>(q)];
      for (int i = -q; i <= q; ++i) {
        field_->add_row({caster.x + i, caster.y - q, caster.z - q}, 2 * q + 1, amount);
      }
    }
  }
}

Shadow ShadowGrid::at(const Coord& voxel) const {
  const Shadow* leaf = field_->find(leaf_of(voxel));
  return leaf ? leaf[offset_in_leaf(voxel)] : 0;
}

void ShadowGrid::gather(const Coord& low, int edge, std::span<Shadow> values) const {
  Shadow* row = values.data();
  for (int i = 0; i < edge; ++i) {
    for (int j = 0; j < edge; ++j) {
      field_->read_row({low.x + i, low.y + j, low.z}, edge, row);
      row += edge;
    }
  }
}

VoxelLayer ShadowGrid::layer() const {
  VoxelLayer layer;
  layer.voxel_size = voxel_size_;
  for (auto leaf = field_->tree.cbeginLeaf(); leaf; ++leaf) {
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
