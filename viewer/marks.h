// What an overlay is drawn with: an engine's layers as dots, lines, arrows and squares, the volumes that a
// run uses as veils.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "common/base/color.h"
#include "common/volume/volume_surface.h"
#include "viewer/workshop.h"

namespace ramify {

/// The overlays that are no engine's: the volumes that a run uses, and its obstacles, which are solid and
/// part of the scene.
inline constexpr const char* kVolumes = "volumes";
inline constexpr const char* kObstacles = "obstacles";

enum class MarkShape { line, dot, square };

/// Marks of one shape, in the world.
struct Marks {
  MarkShape shape = MarkShape::line;
  double size = 1.0;  // lines: pixels of the picture across; dots: radius, squares: side facing +Z, metres
  std::vector<Vec3f> starts;       // of dots and squares the middles
  std::vector<Vec3f> ends;         // of dots and squares the same
  std::vector<ColorBytes> colors;  // alpha: how much of what is behind a mark it hides

  void add(const Vec3& start, const Vec3& end, const Color& color);
  bool are_opaque() const;
};

/// The marks of one overlay, of a field of voxels all or the slice through the origin that faces +Z; empty if
/// the product has none of that name. Values are coloured from the least to the greatest; of very many marks
/// evenly chosen ones are left.
Marks marks_of(const Product& product, const std::string& name, bool is_slice);

/// The surface of a volume, to be seen through.
struct Veil {
  VolumeSurface surface;
  std::vector<float> bends;  // of the surface at each position: 1 over its radius, 0 where it is flat, 1/m
  Color color;
};

/// Of each volume that the product's run uses, obstacles aside; without those that cannot be read or are
/// empty.
std::vector<Veil> veils_of(const Product& product);

/// What can be asked for: the layers that the job's engine makes, and volumes and obstacles where it has
/// some.
std::vector<std::string> overlay_names(const Job& job);

}  // namespace ramify
