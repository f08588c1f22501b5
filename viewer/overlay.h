// Marks and veils over a tree, drawn with OpenGL.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "viewer/camera.h"
#include "viewer/gl_objects.h"
#include "viewer/marks.h"
#include "viewer/painter.h"

namespace ramify {

/// What overlays draw with; those of one context share it. Needs a current context. Throws GraphicsError.
struct OverlayPrograms {
  OverlayPrograms();

  GlProgram line;
  GlProgram dot;
  GlProgram square;
  GlProgram veil;
};

/// The overlays of a product on the GPU. Needs a current context.
class Overlay {
 public:
  explicit Overlay(std::shared_ptr<const OverlayPrograms> programs) : programs_(std::move(programs)) {}

  void load(const Product& product, const std::set<std::string>& names, bool are_slices);

  /// Over what is in the framebuffer, behind what is nearer.
  void draw(const Camera& camera, const Viewport& viewport) const;

 private:
  struct Batch {
    MarkShape shape = MarkShape::line;
    double size = 1.0;
    bool is_opaque = false;
    GlVertexArray vertices;
    GlBuffer starts;
    GlBuffer ends;
    GlBuffer colors;
    int count = 0;
  };

  struct VeilBatch {
    Color color;
    GlVertexArray vertices;
    GlBuffer positions;
    GlBuffer normals;
    GlBuffer bends;
    GlBuffer indices;
    int count = 0;
  };

  const GlProgram& program_of(MarkShape shape) const;
  void load_marks(const Marks& marks);
  void load_veil(const Veil& veil);
  void draw_marks(const Batch& batch, const Camera& camera, const Viewport& viewport) const;
  void draw_veils(const Camera& camera) const;

  std::shared_ptr<const OverlayPrograms> programs_;
  std::vector<Batch> batches_;
  std::vector<VeilBatch> veils_;
  Vec3 middle_{0.0};         // of the grown tree
  double veil_reach_ = 0.0;  // metres from there
};

}  // namespace ramify
