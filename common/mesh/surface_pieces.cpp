#include "common/mesh/surface_pieces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>

namespace ramify {
namespace {

// Leaves that are made into triangles, and simplified, together: what is at hand then fits into a cache.
constexpr std::size_t kLeavesAPiece = 1024;

// Cosine of the greatest angle between a vertex's normal and its triangles'.
constexpr float kFacing = 0.5f;

constexpr std::uint32_t kOnEdge = kCellVerticesMax;  // an index among a piece's own vertices on grid edges

/// A vertex on a grid edge, and one of the cells about it.
struct EdgeVertex {
  Vec3f position;
  std::uint32_t cell;
};

class PieceMaker {
 public:
  PieceMaker(const WoodVoxels& voxels, const CellVertices& vertices, double tolerance)
      : voxels_(voxels),
        vertices_(vertices),
        tolerance_(tolerance),
        leaf_count_(voxels.touched.leaves.size()) {}

  std::size_t piece_count() const { return (leaf_count_ + kLeavesAPiece - 1) / kLeavesAPiece; }

  /// Of the leaves of this number.
  SurfacePiece piece(std::size_t index, const VoxelReader& reader) const {
    SurfacePiece piece;
    std::vector<EdgeVertex> on_edges;
    BulkVector<Triangle> triangles;
    for (std::size_t leaf = first_leaf_of(index); leaf < first_leaf_of(index + 1); ++leaf) {
      const LeafSigns signs(leaf, reader);
      for (int x = 0; x < kLeafSide; ++x) {
        for (int y = 0; y < kLeafSide; ++y) {
          // Where the surface crosses the grid's edges that leave a row of voxels along each axis.
          const unsigned row = signs.row(x, y);
          const std::array<unsigned, 3> crossed = {row ^ signs.row(x + 1, y), row ^ signs.row(x, y + 1),
                                                   row ^ row >> 1};
          for (int axis = 0; axis < 3; ++axis) {
            for (unsigned left = crossed[static_cast<std::size_t>(axis)] & 0xffu; left != 0;
                 left &= left - 1) {
              const int z = std::countr_zero(left);
              add_quad(leaf, {x, y, z}, axis, (row >> z & 1u) != 0, reader, triangles, on_edges);
            }
          }
        }
      }
    }
    number_vertices(index, on_edges.size(), triangles, piece);
    fetch_vertices(on_edges, piece);
    piece.mesh.triangles = std::move(triangles);
    mark_borders(index, reader, piece);
    mend_normals(piece.mesh);
    if (tolerance_ > 0.0) simplify_closed(piece.mesh, tolerance_);
    keep_used(piece);
    return piece;
  }

 private:
  std::size_t first_leaf_of(std::size_t piece) const { return std::min(piece * kLeavesAPiece, leaf_count_); }

  /// Lets the triangles count a piece's own vertices first, then the others.
  void number_vertices(std::size_t index, std::size_t on_edges, BulkVector<Triangle>& triangles,
                       SurfacePiece& piece) const {
    const auto first = static_cast<std::uint32_t>(vertices_.first_vertex[first_leaf_of(index)]);
    const auto end = static_cast<std::uint32_t>(vertices_.first_vertex[first_leaf_of(index + 1)]);
    const auto is_own = [&](std::uint32_t v) { return v >= first && v < end; };
    for (const Triangle& triangle : triangles) {
      for (const std::uint32_t v : triangle) {
        if ((v & kOnEdge) == 0 && !is_own(v)) piece.others.push_back(v);
      }
    }
    std::sort(piece.others.begin(), piece.others.end());
    piece.others.erase(std::unique(piece.others.begin(), piece.others.end()), piece.others.end());
    piece.first_cell = first;
    piece.cells.resize(end - first);
    std::iota(piece.cells.begin(), piece.cells.end(), first);
    const std::uint32_t own = end - first;
    for (Triangle& triangle : triangles) {
      for (std::uint32_t& v : triangle) {
        if ((v & kOnEdge) != 0) {
          v = own + (v & ~kOnEdge);
        } else if (is_own(v)) {
          v -= first;
        } else {
          const auto found = std::lower_bound(piece.others.begin(), piece.others.end(), v);
          v = own +
              static_cast<std::uint32_t>(on_edges + static_cast<std::size_t>(found - piece.others.begin()));
        }
      }
    }
  }

  void fetch_vertices(const std::vector<EdgeVertex>& on_edges, SurfacePiece& piece) const {
    CollapsibleMesh& mesh = piece.mesh;
    const auto fetch = [&](std::uint32_t cell, const Freedom& freedom) {
      mesh.positions.push_back(vertices_.positions[cell]);
      mesh.normals.push_back(vertices_.normals[cell]);
      piece.internodes.push_back(vertices_.internodes[cell]);
      mesh.freedom.push_back(freedom);
    };
    const std::size_t count = piece.cells.size() + on_edges.size() + piece.others.size();
    mesh.positions.reserve(count);
    mesh.normals.reserve(count);
    piece.internodes.reserve(count);
    mesh.freedom.reserve(count);
    for (const std::uint32_t cell : piece.cells) fetch(cell, {.can_go = vertices_.are_alone[cell] != 0});
    for (const EdgeVertex& vertex : on_edges) {
      mesh.positions.push_back(vertex.position);
      mesh.normals.emplace_back(0.0f);  // to be mended like those in creases
      piece.internodes.push_back(vertices_.internodes[vertex.cell]);
      mesh.freedom.emplace_back();
    }
    for (const std::uint32_t cell : piece.others) fetch(cell, {.is_whole = false});
    mesh.errors.assign(count, 0.0f);
  }

  /// Own vertices of which other pieces have triangles must stay as they are.
  void mark_borders(std::size_t index, const VoxelReader& reader, SurfacePiece& piece) const {
    std::size_t vertex = 0;
    for (std::size_t leaf = first_leaf_of(index); leaf < first_leaf_of(index + 1); ++leaf) {
      // Bit i: the leaf that follows on the sides in i (1: x, 2: y, 4: z) belongs to another piece.
      unsigned foreign = 0;
      for (int i = 1; i < 8; ++i) {
        const Coord beside(i & 1, i >> 1 & 1, i >> 2 & 1);
        const std::optional<std::size_t> next = reader.leaf_at(voxels_.origin_of(leaf) + beside * kLeafSide);
        if (next && *next / kLeavesAPiece != index) foreign |= 1u << i;
      }
      vertices_.cells[leaf].for_each([&](int x, int y, int z) {
        const unsigned last =
            (x == kLeafSide - 1 ? 1u : 0u) | (y == kLeafSide - 1 ? 2u : 0u) | (z == kLeafSide - 1 ? 4u : 0u);
        for (unsigned i = 1; i < 8; ++i) {
          if ((i & ~last) == 0 && (foreign >> i & 1u) != 0) piece.mesh.freedom[vertex].is_whole = false;
        }
        ++vertex;
      });
    }
  }

  /// Drops the vertices of the piece that have gone; the others' stay in its list.
  static void keep_used(SurfacePiece& piece) {
    CollapsibleMesh& mesh = piece.mesh;
    const std::size_t own = mesh.positions.size() - piece.others.size();
    // What is not whole has triangles elsewhere.
    std::vector<bool> is_kept(mesh.positions.size(), false);
    for (std::size_t v = 0; v < own; ++v) is_kept[v] = !mesh.freedom[v].is_whole;
    std::vector<std::uint32_t> kept = drop_unused(std::move(is_kept), mesh.triangles);
    const auto own_end = std::lower_bound(kept.begin(), kept.end(), own);
    const std::size_t cell_count = piece.cells.size();
    std::vector<std::uint32_t> cells;
    std::vector<std::uint32_t> others;
    for (auto v = kept.begin(); v != own_end && *v < cell_count; ++v) cells.push_back(piece.cells[*v]);
    for (auto v = own_end; v != kept.end(); ++v) others.push_back(piece.others[*v - own]);
    piece.cells = std::move(cells);
    piece.others = std::move(others);
    kept.erase(own_end, kept.end());
    keep_only(kept, mesh.positions);
    keep_only(kept, mesh.normals);
    keep_only(kept, mesh.errors);
    keep_only(kept, mesh.freedom);
    keep_only(kept, piece.internodes);
  }

  /// The triangles about the grid edge that leaves a voxel along `axis`; the surface crosses it, outwards if
  /// the voxel is inside.
  void add_quad(std::size_t leaf, const Coord& voxel, int axis, bool is_inside, const VoxelReader& voxels,
                BulkVector<Triangle>& triangles, std::vector<EdgeVertex>& on_edges) const {
    // The four cells around the edge, counter-clockwise seen from its end: from outside, if that is there.
    const Coord last = voxels_.origin_of(leaf) + voxel;
    Coord b(0);
    Coord c(0);
    b[(axis + 1) % 3] = 1;
    c[(axis + 2) % 3] = 1;
    std::array<std::uint32_t, 4> ring = {
        vertices_.vertex_of(last - b - c, voxels_, voxels), vertices_.vertex_of(last - c, voxels_, voxels),
        vertices_.vertex_of(last, voxels_, voxels), vertices_.vertex_of(last - b, voxels_, voxels)};
    const std::uint32_t own = ring[2];
    if (!is_inside) std::swap(ring[1], ring[3]);
    Coord step(0);
    step[axis] = 1;
    const Vec3 start = place_of(last, voxels_.voxel_size);
    const Vec3 end = start + Vec3(step) * voxels_.voxel_size;
    const std::optional<int> diagonal = safe_diagonal(ring, start, end);
    if (diagonal) {
      const auto d = static_cast<std::size_t>(*diagonal);
      triangles.push_back({ring[d], ring[d + 1], ring[d + 2]});
      triangles.push_back({ring[d], ring[d + 2], ring[(d + 3) % 4]});
      return;
    }
    const double from = voxels.value(last);
    const double to = voxels.value(last + step);
    const double margin = kCellMargin;
    const double t = std::clamp(from / (from - to), margin, 1.0 - margin);
    const std::uint32_t middle = kOnEdge | static_cast<std::uint32_t>(on_edges.size());
    on_edges.push_back({Vec3f(start + (end - start) * t), own});
    for (std::size_t i = 0; i < 4; ++i) triangles.push_back({middle, ring[i], ring[(i + 1) % 4]});
  }

  /// The shorter of the diagonals (0: from the ring's first vertex, 1: from the second) whose triangles stay
  /// within the four tetrahedra about the grid edge, which no other quad enters: those that pass between the
  /// edge and one of the other two vertices.
  std::optional<int> safe_diagonal(const std::array<std::uint32_t, 4>& ring, const Vec3& start,
                                   const Vec3& end) const {
    std::array<Vec3, 4> at;
    for (std::size_t i = 0; i < 4; ++i) at[i] = Vec3(vertices_.positions[ring[i]]);
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

  const WoodVoxels& voxels_;
  const CellVertices& vertices_;
  double tolerance_;
  std::size_t leaf_count_;
};

}  // namespace

std::vector<SurfacePiece> surface_pieces(const WoodVoxels& voxels, const CellVertices& vertices,
                                         double tolerance) {
  const PieceMaker maker(voxels, vertices, tolerance);
  std::vector<SurfacePiece> pieces(maker.piece_count());
  parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
    const VoxelReader reader(voxels);
    for (std::size_t i = begin; i < end; ++i) pieces[i] = maker.piece(i, reader);
  });
  return pieces;
}

void mend_normals(CollapsibleMesh& mesh) {
  BulkVector<Vec3f> sums(mesh.positions.size(), Vec3f(0.0f));
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3f a = mesh.positions[triangle[0]];
    const Vec3f outwards = glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
    for (const std::uint32_t vertex : triangle) sums[vertex] += outwards;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const float length = glm::length(sums[v]);
    if (mesh.freedom[v].is_whole && length > 0.0f && glm::dot(mesh.normals[v], sums[v]) < kFacing * length)
      mesh.normals[v] = sums[v] / length;
  }
}

}  // namespace ramify
