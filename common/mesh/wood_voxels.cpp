#include "common/mesh/wood_voxels.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>

#include "common/mesh/leaf_field.h"

namespace ramify {

struct VoxelGrid {
  openvdb::FloatTree tree;
  std::vector<openvdb::FloatTree::LeafNodeType*> leaves;  // their transient data are their numbers
};

struct VoxelReader::Access {
  const VoxelGrid& grid;
  openvdb::tree::ValueAccessor<const openvdb::FloatTree, false> tree;
};

namespace {

using VoxelLeaf = openvdb::FloatTree::LeafNodeType;
using VoxelWriter = openvdb::tree::ValueAccessor<openvdb::FloatTree, false>;

openvdb::Coord in_grid(const Coord& voxel) {
  return openvdb::Coord(voxel.x, voxel.y, voxel.z);
}

// Along a block's side, a leaf's half: blocks that the surface does not come near are not looked at.
constexpr int kBlockSide = 4;
static_assert(kBlockSide * kBlockSide * kBlockSide == kBatch);

// Values are cut off here, in voxels: beyond what is active.
constexpr float kClamp = 3.0f;

// What a voxel is set to that is filled to keep the surface a manifold, in voxels.
constexpr float kFilled = -0.05f;

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
  std::array<std::uint8_t, 256> table{};
  for (unsigned signs = 0; signs < 256; ++signs) {
    table[signs] = static_cast<std::uint8_t>(ambiguous_corners(signs));
  }
  return table;
}();

/// The values of leaves' voxels, block by block.
class Rasteriser {
 public:
  /// The field must be that near the leaf. Returns how many voxels are active.
  std::size_t fill(VoxelLeaf& leaf, LeafField& field) {
    std::size_t active = 0;
    for (int x = 0; x < kLeafSide; x += kBlockSide) {
      for (int y = 0; y < kLeafSide; y += kBlockSide) {
        for (int z = 0; z < kLeafSide; z += kBlockSide) active += fill_block(leaf, {x, y, z}, field);
      }
    }
    return active;
  }

 private:
  std::size_t fill_block(VoxelLeaf& leaf, const Coord& corner, LeafField& field) {
    const Vec3f first = Vec3f(corner) + (0.5f - 0.5f * kLeafSide);
    const float half = 0.5f * (kBlockSide - 1);
    field.focus(first + half, std::numbers::sqrt3_v<float> * half);
    const bool is_outside = field.least() > kClamp;
    if (is_outside || field.greatest() < -kClamp) {
      batch_.value.fill(is_outside ? kClamp : -kClamp);
    } else {
      for (int i = 0; i < kBatch; ++i) {
        batch_.x[i] = first.x + static_cast<float>(i / 16);
        batch_.y[i] = first.y + static_cast<float>(i / 4 % 4);
        batch_.z[i] = first.z + static_cast<float>(i % 4);
      }
      field.values(batch_);
    }
    float* values = leaf.buffer().data();
    std::size_t active = 0;
    for (int i = 0; i < kBatch; ++i) {
      const float value = std::clamp(batch_.value[i], -kClamp, kClamp);
      const int x = corner.x + i / 16;
      const int y = corner.y + i / 4 % 4;
      const int z = corner.z + i % 4;
      values[(x * kLeafSide + y) * kLeafSide + z] = value;
      active += std::abs(value) < static_cast<float>(kBandVoxels);
    }
    return active;
  }

  Batch batch_;
};

void rasterise(const FieldItems& items, WoodVoxels& voxels) {
  const std::size_t count = voxels.touched.leaves.size();
  voxels.grid = std::make_shared<VoxelGrid>(VoxelGrid{openvdb::FloatTree(kClamp), {}});
  auto& leaves = voxels.grid->leaves;
  leaves.resize(count);
  std::vector<std::size_t> active(count, 0);
  parallel_for(count, 16, [&](std::size_t begin, std::size_t end) {
    LeafField field;
    Rasteriser rasteriser;
    for (std::size_t i = begin; i < end; ++i) {
      field.reset(items, voxels.touched.of(i), voxels.middle_of(i), voxels.voxel_size);
      // The grid will own it.
      leaves[i] = new VoxelLeaf(in_grid(voxels.origin_of(i)), kClamp, true);
      active[i] = rasteriser.fill(*leaves[i], field);
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    leaves[i]->setTransientData(static_cast<openvdb::Index32>(i));
    voxels.grid->tree.addLeaf(leaves[i]);
  }
  voxels.active_voxels = std::accumulate(active.begin(), active.end(), std::size_t{0});
  openvdb::tools::signedFloodFill(voxels.grid->tree);
}

/// Fills one corner of an ambiguous cell; returns which.
std::optional<openvdb::Coord> fill_one(const openvdb::Coord& cell, VoxelWriter& voxels) {
  CellCorners corners{};
  const auto corner = [&](unsigned i) {
    return cell.offsetBy(static_cast<int>(i / 4), static_cast<int>(i / 2 % 2), static_cast<int>(i % 2));
  };
  for (unsigned i = 0; i < 8; ++i) corners[i] = voxels.getValue(corner(i));
  unsigned signs = 0;
  for (unsigned i = 0; i < 8; ++i) signs |= static_cast<unsigned>(corners[i] < 0.0f) << i;
  const unsigned ambiguous = kAmbiguous[signs];
  if (ambiguous == 0) return std::nullopt;
  unsigned best = 8;
  for (unsigned i = 0; i < 8; ++i) {
    const bool is_candidate = (ambiguous >> i & 1u) != 0;
    if (is_candidate && (best == 8 || corners[i] < corners[best])) best = i;
  }
  voxels.setValueOnly(corner(best), kFilled);
  return corner(best);
}

void fill_ambiguous(WoodVoxels& voxels) {
  std::vector<std::vector<openvdb::Coord>> found(voxels.touched.leaves.size());
  for_each_leaf(voxels, [&](std::size_t i, const VoxelReader& reader) {
    const LeafSigns signs(i, reader);
    for_each_crossed_cell(signs, [&](int x, int y, int z) {
      unsigned corners = 0;
      for (int c = 0; c < 4; ++c) corners |= (signs.row(x + c / 2, y + c % 2) >> z & 3u) << (2 * c);
      if (kAmbiguous[corners] == 0) return;
      found[i].push_back(in_grid(voxels.origin_of(i) + Coord(x, y, z)));
    });
  });
  std::deque<openvdb::Coord> cells;
  for (const auto& list : found) cells.insert(cells.end(), list.begin(), list.end());
  VoxelWriter writer(voxels.grid->tree);
  while (!cells.empty()) {
    const openvdb::Coord cell = cells.front();
    cells.pop_front();
    const std::optional<openvdb::Coord> filled = fill_one(cell, writer);
    if (!filled) continue;
    for (int i = 0; i < 8; ++i) cells.push_back(filled->offsetBy(-(i / 4), -(i / 2 % 2), -(i % 2)));
  }
}

}  // namespace

VoxelReader::VoxelReader(const WoodVoxels& voxels)
    : access_(new Access{*voxels.grid, decltype(Access::tree)(voxels.grid->tree)}) {}

VoxelReader::~VoxelReader() = default;

float VoxelReader::value(const Coord& voxel) const {
  return access_->tree.getValue(in_grid(voxel));
}

std::optional<std::size_t> VoxelReader::leaf_at(const Coord& voxel) const {
  const VoxelLeaf* leaf = access_->tree.probeConstLeaf(in_grid(voxel));
  if (leaf == nullptr) return std::nullopt;
  return leaf->transientData();
}

LeafSigns::LeafSigns(std::size_t number, const VoxelReader& reader) {
  const VoxelLeaf& leaf = *reader.access_->grid.leaves[number];
  const auto& voxels = reader.access_->tree;
  // A voxel's bit in a row of its own leaf, or in the one that follows along z.
  const auto bits_of = [](const VoxelLeaf& from, int x, int y, int count) {
    const float* row = from.buffer().data() + (x * kLeafSide + y) * kLeafSide;
    unsigned bits = 0;
    for (int z = 0; z < count; ++z) bits |= static_cast<unsigned>(row[z] < 0.0f) << z;
    return bits;
  };
  const std::array<int, 2> lengths = {kLeafSide, 1};
  for (int i = 0; i < 8; ++i) {
    const Coord beside(i & 1, i >> 1 & 1, i >> 2 & 1);
    const openvdb::Coord origin =
        leaf.origin().offsetBy(beside.x * kLeafSide, beside.y * kLeafSide, beside.z * kLeafSide);
    const VoxelLeaf* from = i == 0 ? &leaf : voxels.probeConstLeaf(origin);
    const bool is_inside = from == nullptr && voxels.getValue(origin) < 0.0f;
    const int count = lengths[static_cast<std::size_t>(beside.z)];
    for (int x = 0; x < lengths[static_cast<std::size_t>(beside.x)]; ++x) {
      for (int y = 0; y < lengths[static_cast<std::size_t>(beside.y)]; ++y) {
        const unsigned bits =
            from != nullptr ? bits_of(*from, x, y, count) : (is_inside ? (1u << count) - 1 : 0u);
        const int place = (x + beside.x * kLeafSide) * (kLeafSide + 1) + y + beside.y * kLeafSide;
        auto& row = rows_[static_cast<std::size_t>(place)];
        row = static_cast<std::uint16_t>(beside.z == 0 ? bits : row | bits << kLeafSide);
      }
    }
  }
}

unsigned LeafSigns::crossed_cells(int x, int y) const {
  const unsigned all = row(x, y) & row(x, y + 1) & row(x + 1, y) & row(x + 1, y + 1);
  const unsigned any = row(x, y) | row(x, y + 1) | row(x + 1, y) | row(x + 1, y + 1);
  return ((any | any >> 1) & ~(all & all >> 1)) & ((1u << kLeafSide) - 1);
}

LeafWindow::LeafWindow(std::size_t number, const VoxelReader& reader) {
  const VoxelLeaf& leaf = *reader.access_->grid.leaves[number];
  const auto& voxels = reader.access_->tree;
  const float* own = leaf.buffer().data();
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      const bool is_beside = x == kLeafSide || y == kLeafSide;
      if (!is_beside) {
        const float* row = own + (x * kLeafSide + y) * kLeafSide;
        std::copy(row, row + kLeafSide, values_.begin() + static_cast<std::ptrdiff_t>(index(x, y, 0)));
      }
      for (int z = is_beside ? 0 : kLeafSide; z < kSide; ++z) {
        values_[index(x, y, z)] = voxels.getValue(leaf.origin().offsetBy(x, y, z));
      }
    }
  }
}

CellCorners LeafWindow::corners(int x, int y, int z) const {
  CellCorners corners{};
  for (int i = 0; i < 8; ++i) corners[static_cast<std::size_t>(i)] = at(x + i / 4, y + i / 2 % 2, z + i % 2);
  return corners;
}

WoodVoxels wood_voxels(const FieldItems& items, double voxel_size) {
  openvdb::initialize();
  WoodVoxels voxels;
  voxels.voxel_size = voxel_size;
  voxels.touched = touched_leaves(items, voxel_size);
  rasterise(items, voxels);
  fill_ambiguous(voxels);
  return voxels;
}

}  // namespace ramify
