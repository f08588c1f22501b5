#include "common/mesh/closed_surface.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <span>

#include "common/base/errors.h"
#include "common/mesh/even_volume.h"
#include "common/mesh/hollows.h"
#include "common/mesh/leaf_field.h"
#include "common/mesh/simplify_closed.h"
#include "common/mesh/wood_voxels.h"

namespace ramify {
namespace {

// Leaves that are made into triangles, and simplified, together: what is at hand then fits into a cache.
constexpr std::size_t kLeavesAPiece = 1024;

// Vertices stay so far, in voxels, from the walls of their cell, so that no triangle is too thin for floats.
constexpr float kCellMargin = 0.05f;

// A voxel outside the surface another part of it is near if the distance there is less than this.
constexpr float kAlone = 0.6f;

// So many edges from the border of a piece triangles may still change when pieces are joined.
constexpr std::uint8_t kBorderSteps = 4;

// Cosine of the greatest angle between a vertex's normal and its triangles'.
constexpr float kFacing = 0.5f;

constexpr std::uint32_t kOnEdge = 0x80000000;  // an index among a piece's own vertices on grid edges

/// In voxels from the cell's first corner.
Vec3f amid_crossings(const CellCorners& corners) {
  Vec3f sum(0.0f);
  float crossings = 0.0f;
  for (unsigned low = 0; low < 8; ++low) {
    for (const unsigned bit : {1u, 2u, 4u}) {
      if ((low & bit) != 0 || (corners[low] < 0.0f) == (corners[low | bit] < 0.0f)) continue;
      Vec3f at(low / 4, low / 2 % 2, low % 2);
      at[bit == 4 ? 0 : (bit == 2 ? 1 : 2)] = corners[low] / (corners[low] - corners[low | bit]);
      sum += at;
      crossings += 1.0f;
    }
  }
  return sum / crossings;
}

/// What is known of all cells' vertices.
struct CellVertices {
  BulkVector<Vec3f> positions;
  BulkVector<Vec3f> normals;
  BulkVector<std::uint32_t> internodes;
  BulkVector<std::uint8_t> are_alone;  // no other part of the surface is near

  void resize(std::size_t count) {
    positions.resize(count);
    normals.resize(count);
    internodes.resize(count);
    are_alone.resize(count);
  }
};

/// The vertices of a leaf's cells, many at a time.
class VertexPlacer {
 public:
  VertexPlacer(const WoodVoxels& voxels, const FieldItems& items, CellVertices& vertices)
      : voxels_(voxels), items_(items), vertices_(vertices) {}

  /// Of these cells of the leaf; the first vertex is `vertex`.
  void place(std::size_t leaf, const CellMask& cells, const VoxelReader& reader, std::size_t vertex) {
    middle_ = voxels_.middle_of(leaf);
    field_.reset(items_, voxels_.touched.of(leaf), middle_, voxels_.voxel_size);
    const LeafWindow window(leaf, reader);
    count_ = 0;
    cells.for_each([&](int x, int y, int z) {
      // The first voxel stands half a voxel inside the leaf.
      const Vec3f corner = Vec3f(x, y, z) + (0.5f - 0.5f * kLeafSide);
      const Vec3f at = corner + amid_crossings(window.corners(x, y, z));
      corners_[static_cast<std::size_t>(count_)] = corner;
      set(count_++, at);
      if (count_ == kBatch) vertex = finish(vertex);
    });
    finish(vertex);
  }

 private:
  void set(int i, const Vec3f& at) {
    const auto lane = static_cast<std::size_t>(i);
    batch_.x[lane] = at.x;
    batch_.y[lane] = at.y;
    batch_.z[lane] = at.z;
  }

  /// Moves what has gathered onto the surface and writes it. Returns the next vertex.
  std::size_t finish(std::size_t vertex) {
    if (count_ == 0) return vertex;
    batch_.lanes = std::min(kBatch, (count_ + 7) / 8 * 8);
    for (int i = count_; i < batch_.lanes; ++i) set(i, corners_[0]);
    Vec3f low = corners_[0];
    Vec3f high = corners_[0];
    for (int i = 1; i < count_; ++i) {
      low = glm::min(low, corners_[static_cast<std::size_t>(i)]);
      high = glm::max(high, corners_[static_cast<std::size_t>(i)]);
    }
    high += 1.0f;
    field_.focus(0.5f * (low + high), 0.5f * glm::length(high - low) + 1.0f);
    for (int step = 0; step < 2; ++step) {
      field_.slopes(batch_);
      move_to_surface();
    }
    field_.slopes(batch_);
    write(vertex);
    vertex += static_cast<std::size_t>(count_);
    count_ = 0;
    return vertex;
  }

  void move_to_surface() {
    for (int i = 0; i < count_; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const Vec3f slope(batch_.slope_x[lane], batch_.slope_y[lane], batch_.slope_z[lane]);
      const Vec3f at(batch_.x[lane], batch_.y[lane], batch_.z[lane]);
      const Vec3f moved = at - slope * (batch_.value[lane] / std::max(glm::dot(slope, slope), 0.1f));
      const Vec3f corner = corners_[lane];
      set(i, glm::clamp(moved, corner + kCellMargin, corner + (1.0f - kCellMargin)));
    }
  }

  void write(std::size_t vertex) {
    for (int i = 0; i < count_; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      const Vec3f at(batch_.x[lane], batch_.y[lane], batch_.z[lane]);
      const Vec3f slope(batch_.slope_x[lane], batch_.slope_y[lane], batch_.slope_z[lane]);
      const float steepness = glm::length(slope);
      const Vec3f normal = steepness > 1e-6f ? slope / steepness : Vec3f(kUp);
      vertices_.positions[vertex + lane] = Vec3f(middle_ + Vec3(at) * voxels_.voxel_size);
      vertices_.normals[vertex + lane] = normal;
      vertices_.internodes[vertex + lane] = batch_.internode[lane];
      set(i, at + normal);
    }
    field_.values(batch_);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(count_); ++lane) {
      vertices_.are_alone[vertex + lane] = batch_.value[lane] >= kAlone;
    }
  }

  const WoodVoxels& voxels_;
  const FieldItems& items_;
  CellVertices& vertices_;
  LeafField field_;
  Vec3 middle_{0.0};
  Batch batch_;
  std::array<Vec3f, kBatch> corners_;  // of the cells
  int count_ = 0;                      // of them
};

/// A vertex on a grid edge, and one of the cells about it.
struct EdgeVertex {
  Vec3f position;
  std::uint32_t cell;
};

/// The triangles of some leaves, simplified as far as can be without their neighbours. Triangles count the
/// piece's own vertices first, then the others'.
struct Piece {
  CollapsibleMesh mesh;
  std::vector<std::uint32_t> internodes;
  std::vector<std::uint32_t> cells;   // of the own vertices, the cell vertex each was, in ascending order;
                                      // none for those on grid edges, which come last
  std::vector<std::uint32_t> others;  // cell vertices of other pieces
};

class Contour {
 public:
  Contour(const FieldItems& items, double voxel_size, double tolerance)
      : items_(items), tolerance_(tolerance), voxels_(wood_voxels(items, voxel_size)) {}

  ClosedSurface surface() {
    mark_cells();
    place_vertices();
    make_pieces();
    const std::size_t active_voxels = voxels_.active_voxels;
    voxels_ = {};
    cells_ = {};
    vertices_ = {};
    ClosedSurface surface = assembled();
    surface.active_voxels = active_voxels;
    return surface;
  }

 private:
  /// Each cell that the surface passes has a vertex.
  void mark_cells() {
    cells_.resize(leaf_count());
    for_each_leaf(voxels_, [&](std::size_t i, const VoxelReader& reader) {
      for_each_crossed_cell(LeafSigns(i, reader), [&](int x, int y, int z) { cells_[i].add(x, y, z); });
    });
    first_vertex_.assign(leaf_count() + 1, 0);
    for (std::size_t i = 0; i < leaf_count(); ++i)
      first_vertex_[i + 1] = first_vertex_[i] + cells_[i].count();
    if (first_vertex_.back() >= kOnEdge)
      throw RunError("watertight: more than 2^31 vertices (larger voxels)");
  }

  void place_vertices() {
    vertices_.resize(first_vertex_.back());
    parallel_for(leaf_count(), 16, [&](std::size_t begin, std::size_t end) {
      const VoxelReader reader(voxels_);
      VertexPlacer placer(voxels_, items_, vertices_);
      for (std::size_t i = begin; i < end; ++i) placer.place(i, cells_[i], reader, first_vertex_[i]);
    });
  }

  void make_pieces() {
    pieces_.resize((leaf_count() + kLeavesAPiece - 1) / kLeavesAPiece);
    parallel_for(pieces_.size(), 1, [&](std::size_t begin, std::size_t end) {
      const VoxelReader reader(voxels_);
      for (std::size_t i = begin; i < end; ++i) make_piece(i, reader);
    });
  }

  std::size_t leaf_count() const { return voxels_.touched.leaves.size(); }

  std::size_t first_leaf_of(std::size_t piece) const { return std::min(piece * kLeavesAPiece, leaf_count()); }

  void make_piece(std::size_t index, const VoxelReader& reader) {
    Piece& piece = pieces_[index];
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
  }

  /// Lets the triangles count a piece's own vertices first, then the others.
  void number_vertices(std::size_t index, std::size_t on_edges, BulkVector<Triangle>& triangles,
                       Piece& piece) const {
    const auto first = static_cast<std::uint32_t>(first_vertex_[first_leaf_of(index)]);
    const auto end = static_cast<std::uint32_t>(first_vertex_[first_leaf_of(index + 1)]);
    const auto is_own = [&](std::uint32_t v) { return v >= first && v < end; };
    for (const Triangle& triangle : triangles) {
      for (const std::uint32_t v : triangle) {
        if ((v & kOnEdge) == 0 && !is_own(v)) piece.others.push_back(v);
      }
    }
    std::sort(piece.others.begin(), piece.others.end());
    piece.others.erase(std::unique(piece.others.begin(), piece.others.end()), piece.others.end());
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

  void fetch_vertices(const std::vector<EdgeVertex>& on_edges, Piece& piece) const {
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
  void mark_borders(std::size_t index, const VoxelReader& reader, Piece& piece) const {
    std::size_t vertex = 0;
    for (std::size_t leaf = first_leaf_of(index); leaf < first_leaf_of(index + 1); ++leaf) {
      // Bit i: the leaf that follows on the sides in i (1: x, 2: y, 4: z) belongs to another piece.
      unsigned foreign = 0;
      for (int i = 1; i < 8; ++i) {
        const Coord beside(i & 1, i >> 1 & 1, i >> 2 & 1);
        const std::optional<std::size_t> next = reader.leaf_at(voxels_.origin_of(leaf) + beside * kLeafSide);
        if (next && *next / kLeavesAPiece != index) foreign |= 1u << i;
      }
      cells_[leaf].for_each([&](int x, int y, int z) {
        const unsigned last =
            (x == kLeafSide - 1 ? 1u : 0u) | (y == kLeafSide - 1 ? 2u : 0u) | (z == kLeafSide - 1 ? 4u : 0u);
        for (unsigned i = 1; i < 8; ++i) {
          if ((i & ~last) == 0 && (foreign >> i & 1u) != 0) piece.mesh.freedom[vertex].is_whole = false;
        }
        ++vertex;
      });
    }
  }

  /// In a crease the field has no one gradient: there a vertex faces as its triangles do.
  static void mend_normals(CollapsibleMesh& mesh) {
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

  /// Drops the vertices of the piece that have gone; the others' stay in its list.
  static void keep_used(Piece& piece) {
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

  /// In memory of just that size.
  template <class Values>
  static void keep_only(const std::vector<std::uint32_t>& kept, Values& values) {
    Values result(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) result[i] = values[kept[i]];
    values = std::move(result);
  }

  std::uint32_t vertex_of(const Coord& cell, const VoxelReader& voxels) const {
    // All cells that the surface passes are in leaves.
    const std::size_t leaf = *voxels.leaf_at(cell);
    const Coord local = cell - voxels_.origin_of(leaf);
    return static_cast<std::uint32_t>(first_vertex_[leaf] +
                                      cells_[leaf].count_before(local.x, local.y, local.z));
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
    std::array<std::uint32_t, 4> ring = {vertex_of(last - b - c, voxels), vertex_of(last - c, voxels),
                                         vertex_of(last, voxels), vertex_of(last - b, voxels)};
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

  std::size_t piece_with(std::uint32_t cell) const {
    const auto leaf = std::upper_bound(first_vertex_.begin(), first_vertex_.end(), cell) - 1;
    return static_cast<std::size_t>(leaf - first_vertex_.begin()) / kLeavesAPiece;
  }

  /// All pieces, then simplified along their borders.
  ClosedSurface assembled() {
    std::vector<std::uint32_t> first_vertex(pieces_.size() + 1, 0);
    std::vector<std::size_t> first_triangle(pieces_.size() + 1, 0);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      first_vertex[i + 1] = first_vertex[i] + static_cast<std::uint32_t>(pieces_[i].mesh.positions.size());
      first_triangle[i + 1] = first_triangle[i] + pieces_[i].mesh.triangles.size();
    }
    CollapsibleMesh mesh;
    mesh.positions.resize(first_vertex.back());
    mesh.normals.resize(first_vertex.back());
    mesh.errors.resize(first_vertex.back());
    mesh.freedom.resize(first_vertex.back());
    mesh.triangles.resize(first_triangle.back());
    BulkVector<std::uint32_t> internodes(first_vertex.back());
    const auto place_of_cell = [&](std::uint32_t cell) {
      const std::size_t i = piece_with(cell);
      const auto& cells = pieces_[i].cells;
      const auto found = std::lower_bound(cells.begin(), cells.end(), cell);
      return first_vertex[i] + static_cast<std::uint32_t>(found - cells.begin());
    };
    parallel_for(pieces_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Piece& piece = pieces_[i];
        const std::uint32_t first = first_vertex[i];
        std::copy(piece.mesh.positions.begin(), piece.mesh.positions.end(), mesh.positions.begin() + first);
        std::copy(piece.mesh.normals.begin(), piece.mesh.normals.end(), mesh.normals.begin() + first);
        std::copy(piece.mesh.errors.begin(), piece.mesh.errors.end(), mesh.errors.begin() + first);
        std::copy(piece.mesh.freedom.begin(), piece.mesh.freedom.end(), mesh.freedom.begin() + first);
        std::copy(piece.internodes.begin(), piece.internodes.end(), internodes.begin() + first);
        const auto own = static_cast<std::uint32_t>(piece.mesh.positions.size());
        std::size_t next = first_triangle[i];
        for (Triangle triangle : piece.mesh.triangles) {
          for (std::uint32_t& v : triangle) v = v < own ? first + v : place_of_cell(piece.others[v - own]);
          mesh.triangles[next++] = triangle;
        }
      }
    });
    pieces_ = {};
    return finished(std::move(mesh), std::move(internodes));
  }

  /// Simplifies where pieces had to leave vertices for their neighbours, and around.
  void simplify_borders(CollapsibleMesh& mesh) const {
    const std::vector<std::uint8_t> steps = steps_from_borders(mesh);
    const auto is_near = [&](const Triangle& triangle) {
      return std::any_of(triangle.begin(), triangle.end(),
                         [&](std::uint32_t v) { return steps[v] < kBorderSteps; });
    };
    const auto far_end = std::stable_partition(mesh.triangles.begin(), mesh.triangles.end(),
                                               [&](const Triangle& triangle) { return !is_near(triangle); });
    CollapsibleMesh band;
    band.triangles.assign(far_end, mesh.triangles.end());
    mesh.triangles.erase(far_end, mesh.triangles.end());
    const std::vector<std::uint32_t> used =
        drop_unused(std::vector<bool>(mesh.positions.size(), false), band.triangles);
    for (const std::uint32_t v : used) {
      band.positions.push_back(mesh.positions[v]);
      band.normals.push_back(mesh.normals[v]);
      band.errors.push_back(mesh.errors[v]);
      band.freedom.push_back({.can_go = mesh.freedom[v].can_go, .is_whole = steps[v] < kBorderSteps});
    }
    simplify_closed(band, tolerance_);
    for (Triangle triangle : band.triangles) {
      for (std::uint32_t& v : triangle) v = used[v];
      mesh.triangles.push_back(triangle);
    }
  }

  /// Of each vertex, how many edges lie between it and one that is not whole; kBorderSteps: more or as many.
  static std::vector<std::uint8_t> steps_from_borders(const CollapsibleMesh& mesh) {
    std::vector<std::uint8_t> steps(mesh.freedom.size(), kBorderSteps);
    for (std::size_t v = 0; v < steps.size(); ++v) {
      if (!mesh.freedom[v].is_whole) steps[v] = 0;
    }
    for (std::uint8_t step = 0; step + 1 < kBorderSteps; ++step) {
      for (const Triangle& triangle : mesh.triangles) {
        const bool is_next =
            steps[triangle[0]] == step || steps[triangle[1]] == step || steps[triangle[2]] == step;
        if (!is_next) continue;
        for (const std::uint32_t v : triangle)
          steps[v] = std::min(steps[v], static_cast<std::uint8_t>(step + 1));
      }
    }
    return steps;
  }

  ClosedSurface finished(CollapsibleMesh mesh, BulkVector<std::uint32_t> internodes) const {
    if (tolerance_ > 0.0) simplify_borders(mesh);
    for (Freedom& freedom : mesh.freedom) freedom.is_whole = true;
    fill_hollows(mesh.positions, mesh.triangles);
    const std::vector<std::uint32_t> kept =
        drop_unused(std::vector<bool>(mesh.positions.size(), false), mesh.triangles);
    keep_only(kept, mesh.positions);
    keep_only(kept, mesh.normals);
    keep_only(kept, mesh.freedom);
    keep_only(kept, internodes);
    mend_normals(mesh);
    std::vector<bool> can_move(mesh.freedom.size());
    for (std::size_t v = 0; v < can_move.size(); ++v) can_move[v] = mesh.freedom[v].can_go;
    even_volume(mesh.normals, mesh.triangles, can_move, mesh.positions);
    return {std::move(mesh.positions), std::move(mesh.normals), std::move(internodes),
            std::move(mesh.triangles), 0};
  }

  const FieldItems& items_;
  double tolerance_;
  WoodVoxels voxels_;
  std::vector<CellMask> cells_;            // of each leaf, those that have a vertex
  std::vector<std::size_t> first_vertex_;  // of each leaf; one more at the end
  CellVertices vertices_;
  std::vector<Piece> pieces_;
};

}  // namespace

ClosedSurface closed_surface(const WoodField& field, double voxel_size, double tolerance) {
  const FieldItems items(field);
  return Contour(items, voxel_size, tolerance).surface();
}

}  // namespace ramify
