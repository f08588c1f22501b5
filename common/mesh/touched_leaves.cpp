#include "common/mesh/touched_leaves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/errors.h"
#include "common/base/parallel.h"

namespace ramify {
namespace {

struct Touch {
  std::uint64_t leaf;
  std::uint32_t item;
  friend auto operator<=>(const Touch&, const Touch&) = default;
};

constexpr int kKeyBits = 21;
constexpr int kKeyBias = 1 << (kKeyBits - 1);

/// The lowest 21 bits, two empty ones after each.
std::uint64_t spread(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffff;
  bits = (bits | bits << 16) & 0x1f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

std::uint64_t gathered(std::uint64_t bits) {
  bits &= 0x1249249249249249;
  bits = (bits | bits >> 2) & 0x10c30c30c30c30c3;
  bits = (bits | bits >> 4) & 0x100f00f00f00f00f;
  bits = (bits | bits >> 8) & 0x1f0000ff0000ff;
  bits = (bits | bits >> 16) & 0x1f00000000ffff;
  return (bits | bits >> 32) & 0x1fffff;
}

std::uint64_t key_of(const Coord& leaf) {
  const auto part = [](int value) { return spread(static_cast<std::uint64_t>(value + kKeyBias)); };
  return part(leaf.x) << 2 | part(leaf.y) << 1 | part(leaf.z);
}

Coord leaf_of(std::uint64_t key) {
  const auto part = [&](int shift) { return static_cast<int>(gathered(key >> shift)) - kKeyBias; };
  return {part(2), part(1), part(0)};
}

/// Finds leaves by halves: a cube of them that an item cannot reach is left out as a whole.
class LeafFinder {
 public:
  LeafFinder(const FieldItems& items, double voxel_size) : items_(items), voxel_size_(voxel_size) {}

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

  const FieldItems& items_;
  double voxel_size_;
};

std::vector<Touch> all_touches(const LeafFinder& finder, std::size_t item_count) {
  constexpr std::size_t kChunk = 256;
  std::vector<std::vector<Touch>> chunks((item_count + kChunk - 1) / kChunk);
  parallel_for(chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t chunk = begin; chunk < end; ++chunk) {
      const std::size_t last = std::min(item_count, (chunk + 1) * kChunk);
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
  return touches;
}

void check_reach(const FieldItems& items, double voxel_size) {
  Box bounds;
  for (std::uint32_t item = 0; item < items.size(); ++item) bounds.include(items.bounds(item));
  const double farthest = std::max(glm::length(bounds.low), glm::length(bounds.high));
  if (farthest / (voxel_size * kLeafSide) <= kKeyBias - 8) return;
  throw RunError(
      fmt::format("watertight: voxels of {} m are too small for a tree that reaches {} m from the "
                  "origin (larger voxels)",
                  voxel_size, farthest));
}

}  // namespace

TouchedLeaves touched_leaves(const FieldItems& items, double voxel_size) {
  check_reach(items, voxel_size);
  const LeafFinder finder(items, voxel_size);
  const std::vector<Touch> touches = all_touches(finder, items.size());
  TouchedLeaves result;
  for (std::size_t begin = 0, end = 0; begin < touches.size(); begin = end) {
    const Coord leaf = leaf_of(touches[begin].leaf);
    for (end = begin; end < touches.size() && touches[end].leaf == touches[begin].leaf;) ++end;
    const std::size_t first = result.items.size();
    for (std::size_t i = begin; i < end; ++i) result.items.push_back(touches[i].item);
    // A leaf that lies deep inside a cone has none of the surface.
    const std::span<const std::uint32_t> own = std::span(result.items).subspan(first);
    if (items.union_distance(own, finder.center(leaf)) < -finder.radius()) {
      result.items.resize(first);
      continue;
    }
    result.leaves.push_back(leaf);
    result.first.push_back(first);
  }
  result.first.push_back(result.items.size());
  return result;
}

}  // namespace ramify
