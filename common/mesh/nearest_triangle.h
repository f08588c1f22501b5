// Which of some triangles lies nearest to a point: a tree of boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/mesh.h"

namespace ramify {

struct NearestTriangle {
  std::uint32_t triangle = 0;  // index into Mesh::triangles
  Vec3f shares{0.0f};          // of its corners in the point of it that is nearest
  Vec3f point{0.0f};
  float distance2 = std::numeric_limits<float>::infinity();  // square metres
};

class TriangleTree {
 public:
  /// Of these triangles, at least one. The mesh must outlive the tree. O(n log n).
  TriangleTree(const Mesh& mesh, std::vector<std::uint32_t> triangles);

  /// About O(log n).
  NearestTriangle nearest(const Vec3f& point) const;

 private:
  struct Node {
    Vec3f low{std::numeric_limits<float>::infinity()};
    Vec3f high{-std::numeric_limits<float>::infinity()};
    std::uint32_t first = 0;  // of its triangles
    std::uint32_t count = 0;
    std::uint32_t second_half = 0;  // index of a node, the first half's comes next after this; 0: a leaf
  };

  /// A triangle while it is put in its place.
  struct Item {
    std::uint32_t triangle;
    Vec3f place;  // thrice its middle
    Vec3f low;
    Vec3f high;
  };

  std::uint32_t add(std::vector<Item>& items, std::uint32_t first, std::uint32_t count);
  void look(std::uint32_t index, const Vec3f& point, NearestTriangle& best) const;

  const Mesh& mesh_;
  std::vector<std::uint32_t> triangles_;  // a node's in a row
  std::vector<Node> nodes_;
};

}  // namespace ramify
