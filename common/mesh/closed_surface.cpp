#include "common/mesh/closed_surface.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "common/mesh/even_volume.h"
#include "common/mesh/hollows.h"
#include "common/mesh/surface_pieces.h"

namespace ramify {
namespace {

// So many edges from the border of a piece triangles may still change when pieces are joined.
constexpr std::uint8_t kBorderSteps = 4;

/// Joins pieces into one surface.
class Assembler {
 public:
  Assembler(std::vector<SurfacePiece> pieces, double tolerance)
      : pieces_(std::move(pieces)), tolerance_(tolerance) {}

  /// All pieces, then simplified along their borders.
  ClosedSurface surface() {
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
        const SurfacePiece& piece = pieces_[i];
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
    pieces_.clear();
    return finished(std::move(mesh), std::move(internodes));
  }

 private:
  std::size_t piece_with(std::uint32_t cell) const {
    const auto after = std::upper_bound(
        pieces_.begin(), pieces_.end(), cell,
        [](std::uint32_t value, const SurfacePiece& piece) { return value < piece.first_cell; });
    return static_cast<std::size_t>(after - pieces_.begin()) - 1;
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

  std::vector<SurfacePiece> pieces_;
  double tolerance_;
};

}  // namespace

ClosedSurface closed_surface(const WoodField& field, double voxel_size, double tolerance) {
  const FieldItems items(field);
  std::vector<SurfacePiece> pieces;
  std::size_t active_voxels = 0;
  {
    const WoodVoxels voxels = wood_voxels(items, voxel_size);
    active_voxels = voxels.active_voxels;
    pieces = surface_pieces(voxels, place_cell_vertices(voxels, items), tolerance);
  }
  ClosedSurface surface = Assembler(std::move(pieces), tolerance).surface();
  surface.active_voxels = active_voxels;
  return surface;
}

}  // namespace ramify
