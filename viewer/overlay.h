// What is shown over a tree beside its wood: an engine's layers, and the volumes that its run uses.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "common/base/color.h"
#include "viewer/camera.h"
#include "viewer/gl_objects.h"
#include "viewer/painter.h"
#include "viewer/workshop.h"

namespace ramify {

/// The overlays that are no engine's: the outlines of the volumes that a run uses, and its obstacles, which
/// are solid and part of the scene.
inline constexpr const char* kVolumes = "volumes";
inline constexpr const char* kObstacles = "obstacles";

/// Segments in the world, of no length: points; or squares.
struct Marks {
  std::vector<Vec3f> starts;  // of squares the middles
  std::vector<Vec3f> ends;
  std::vector<ColorBytes> colors;
  double width = 1.5;    // pixels of the picture
  float opacity = 1.0f;  // many marks are thin veils: what is behind them shows through
  double square = 0.0;   // metres, a side, facing +Z; 0: segments

  void add(const Vec3& start, const Vec3& end, const Color& color);
};

/// The marks of one overlay, of a field of voxels all or the slice through the origin that faces +Z; empty if
/// the product has none of that name. Values are coloured from the least
/// to the greatest; of very many marks evenly chosen ones are left.
Marks marks_of(const Product& product, const std::string& name, bool is_slice);

/// What can be asked for: the layers that the job's engine makes, and volumes and obstacles where it has
/// some.
std::vector<std::string> overlay_names(const Job& job);

/// The marks on the GPU. Needs a current context.
class Overlay {
 public:
  Overlay();

  void load(const Product& product, const std::set<std::string>& names, bool are_slices);

  /// Over what is in the framebuffer, behind what is nearer.
  void draw(const Camera& camera, const Viewport& viewport) const;

 private:
  struct Batch {
    GlVertexArray vertices;
    GlBuffer starts;
    GlBuffer ends;
    GlBuffer colors;
    int count = 0;
    double width = 1.0;
    float opacity = 1.0f;
    double square = 0.0;
  };

  GlProgram line_;
  GlProgram square_;
  std::vector<Batch> batches_;
};

}  // namespace ramify
