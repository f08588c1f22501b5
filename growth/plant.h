// A growing tree as flat arrays: its living nodes, its axes and its buds. Nodes and axes stand in the order
// of their creation, so a parent is before its children: a loop forward is acropetal, a loop backward
// basipetal. What is cut away leaves holes, which are closed when there are many.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "common/base/geometry.h"
#include "common/base/large_pages.h"
#include "common/base/mapped.h"
#include "growth/parameters.h"
#include "growth/shadow_grid.h"

namespace ramify::growth {

inline constexpr std::uint32_t kNone = 0xffffffff;

/// A chain of internodes made by one bud and its successors; axis 0 is the trunk.
struct Axis {
  std::uint32_t first = 0;       // its first own node, whose parent bears it; of the trunk the root
  std::uint32_t node_count = 0;  // its own nodes ever; of the trunk the root too
  std::uint32_t id = 0;          // how many axes were founded before it: its name for good
  std::uint16_t order = 0;
  Vec3f reference{1, 0, 0};  // perpendicular to its tip, carried along without twist: azimuth 0
};

struct Bud {
  std::uint32_t node =
      0;          // where it stands, on the axis it continues or branches off; kNone: dead in this step
  Site site = 0;  // the node's voxel
  std::uint16_t birth_step = 0;
  bool is_terminal = false;
  bool is_blind = false;  // space: it will never see a marker again

  bool is_dead() const { return node == kNone; }
};

struct Plant {
  // Nodes; 0 is the root. What the skeleton takes over stands in plain vectors.
  std::vector<Vec3> position;
  std::vector<std::uint32_t> parent;       // kNone: the root, or cut away
  MappedVector<std::uint32_t> axis;        // its place in `axes`
  MappedVector<std::uint8_t> founds_axis;  // 1: the first internode of a lateral axis
  MappedVector<std::uint16_t> birth_step;  // 0: the root
  std::vector<std::uint32_t> lost_tips;    // tips that children cut away had ever borne: the wood stays thick
  std::vector<std::uint32_t> id;           // how many nodes were made before it; only where a history is kept

  MappedVector<Axis> axes;
  MappedVector<Bud> buds;             // by node; those that died in a step stay to its end
  MappedVector<Vec3f> bud_direction;  // of each, unit: default direction of its first metamer

  std::uint32_t axes_founded = 0;  // ever, the trunk too
  std::uint32_t cut_nodes = 0;     // holes in the arrays

  std::size_t node_count() const { return position.size(); }  // holes too
  std::size_t internode_count() const { return position.size() - cut_nodes - 1; }
  bool is_cut(std::size_t node) const { return node != 0 && parent[node] == kNone; }
};

/// Room for so many more values. Of large arrays much, and by more than doubling: each time one moves, the
/// old one and the new one are both in memory, while room that is never used takes none. (Small trees get
/// little: there may be thousands of them.) Large ones are in large pages: what hangs together in a tree lies
/// anywhere in them.
template <class T, class Allocator>
void make_room(std::vector<T, Allocator>& values, std::size_t more) {
  constexpr std::size_t kGrowth = 4;
  constexpr std::size_t kLarge = kLeastMapped / sizeof(T);
  constexpr std::size_t kLeastOfLarge = 1 << 20;
  const std::size_t wanted = values.size() + more;
  if (values.capacity() >= wanted) return;
  std::vector<T, Allocator> roomier;
  if (wanted < kLarge) {
    roomier.reserve(std::min(kGrowth * wanted, kLarge));
  } else {
    roomier.reserve(std::max(kGrowth * wanted, kLeastOfLarge));
    prefer_large_pages(roomier.data(), roomier.capacity() * sizeof(T));  // before it is touched
  }
  roomier.insert(roomier.end(), values.begin(), values.end());
  values.swap(roomier);
}

/// std::vector::resize() with make_room().
template <class T, class Allocator>
void set_size(std::vector<T, Allocator>& values, std::size_t size) {
  if (size > values.size()) make_room(values, size - values.size());
  values.resize(size);
}

/// The state of step 0: a terminal bud at the root, pointing up.
Plant seedling(const TreePlace& place, Site site);

/// Takes out the dead buds and those on wood that is cut away, and closes the holes in nodes and axes if at
/// least this share of the nodes are holes.
void compact(Plant& plant, double share);

}  // namespace ramify::growth
