// Draws a scene with OpenGL into whichever framebuffer is bound: an off-screen one or a window's. Light is
// linear and alpha multiplied in; whoever owns the framebuffer encodes it.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "viewer/annotations.h"
#include "viewer/camera.h"
#include "viewer/gl_objects.h"
#include "viewer/scene.h"
#include "viewer/shadow_map.h"
#include "viewer/sunlight.h"

namespace ramify {

struct Material;

/// The part of a picture that a framebuffer takes up.
struct Viewport {
  int width = 0;  // pixels of the framebuffer
  int height = 0;
  glm::dvec2 low{0.0};  // lower left corner in the whole picture, which runs from 0 to 1
  glm::dvec2 high{1.0};
  double fineness = 1.0;  // pixels of the framebuffer for one of the picture, in which lines are measured
};

/// Which of the tree's triangles are drawn. Very many are drawn part by part: what is drawn before the tree
/// goes with the part that begins with its first triangle, what is drawn after it with the part without end.
struct TreePart {
  static constexpr std::size_t kNoEnd = std::numeric_limits<std::size_t>::max();

  std::size_t first = 0;
  std::size_t end = kNoEnd;

  bool is_first() const { return first == 0; }
  bool is_last() const { return end == kNoEnd; }
};

/// What painters draw with; those of one context share it, as compiling takes a while. Needs a current
/// context. Throws GraphicsError.
struct PaintPrograms {
  PaintPrograms();

  GlProgram background;
  GlProgram caster;
  GlProgram flat;
  GlProgram lit;
  GlProgram ground;
  GlProgram line;
};

class Painter {
 public:
  /// Needs a current OpenGL 3.3 context, the same one in every call. Throws GraphicsError.
  explicit Painter(std::shared_ptr<const PaintPrograms> programs = std::make_shared<const PaintPrograms>());
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Takes over what `options` show of the scene; replaces what was loaded before, annotations included.
  /// Throws InputError if options.color_by or the style asks for what the scene lacks.
  void load(const Scene& scene, const RenderOptions& options);

  /// The same little by little: each call of load_more() takes some milliseconds and says whether there is
  /// more to come. Until there is none, the scene has to stay as it is and nothing can be drawn.
  void begin_load(const Scene& scene, const RenderOptions& options);
  bool load_more();

  /// Adds figure and bar to what was loaded, in the plane through `base` spanned by right and up.
  void load_annotations(const Annotations& annotations, const Vec3& base, const CameraAxes& axes);

  /// Makes the shadows of what was loaded from `scene`; before draw() in the style lit, even where it is to
  /// be without occlusion and there are none. `map_size`: pixels a side. Leaves its own framebuffer bound.
  void cast_shadows(const Scene& scene, const CameraAxes& sun, int map_size, const TreePart& part = {});

  /// How far ground and obstacles reach around the tree's base, metres; 0 if there are none.
  double reach() const { return std::max(ground_reach_, obstacle_reach_); }

  /// Draws what was loaded, background first.
  void draw(const Camera& camera, const Viewport& viewport, const TreePart& part = {});

  /// Of the tree's mesh.
  std::size_t triangle_count() const { return triangle_count_; }

  /// Draws tree and obstacles alone, among what another painter drew through the same camera.
  void draw_over(const Camera& camera, const Viewport& viewport, const TreePart& part = {});

 private:
  /// Indices that are drawn in one go.
  struct Range {
    std::size_t first = 0;
    int count = 0;
    bool is_closed = false;   // so that the triangles' backs are never seen
    std::size_t surface = 0;  // index into surfaces_
  };

  /// A material on the GPU.
  struct Surface {
    Vec3f color{1.0f};  // linear, times that of the vertices
    bool is_cutout = false;
    bool is_overlay = false;
    bool is_thin = false;  // light comes through
    std::optional<GlTexture> image;
    std::optional<GlTexture> normal_map;
  };

  /// Triangles, or lines, on the GPU.
  struct Batch {
    Vec3 origin{0.0};  // that the positions are relative to
    GlVertexArray vertices;
    GlBuffer positions;
    GlBuffer normals;  // of lines: where they end
    GlBuffer colors;
    GlBuffer uvs;
    GlBuffer indices;
    std::vector<Range> ranges;  // of a mesh
    int count = 0;              // of vertices or lines, where there are no ranges
  };

  void load_mesh(const Scene& scene);
  void load_surface(const Material& material, bool shows_color);
  void load_obstacles(const Mesh& obstacles);
  void load_triangles(Batch& batch, const Mesh& mesh, const std::vector<ColorBytes>& colors);
  void load_later(const GlBuffer& buffer, const void* data, std::size_t byte_count);
  void load_lines(const Scene& scene);
  void load_sky_light(const Scene& scene);
  Batch flat_batch(const std::vector<Vec2f>& corners, const CameraAxes& axes) const;
  void draw_background(const Viewport& viewport) const;
  void draw_solid(const Batch& batch, const glm::dmat4& world_to_clip, const TreePart& part = {}) const;
  void draw_lines(const glm::dmat4& world_to_clip, const Viewport& viewport) const;
  void draw_ground(const glm::dmat4& world_to_clip) const;
  void draw_triangles(const Batch& batch, const GlProgram& program, const TreePart& part = {}) const;
  void set_surface(const Surface& surface, const GlProgram& program) const;
  void draw_flat(const Batch& batch, const glm::dmat4& world_to_clip) const;
  void cast(const Batch& batch, const TreePart& part = {}) const;
  void set_light(const GlProgram& program) const;
  bool has_ground(const Camera& camera) const;
  bool is_plain() const;  // colours are to be read: no images, no overlays

  std::shared_ptr<const PaintPrograms> programs_;
  GlVertexArray no_vertices_;

  RenderOptions options_;
  std::deque<std::function<void()>> to_load_;  // some milliseconds each
  std::vector<ColorBytes> tree_colors_;        // until they are loaded
  std::vector<ColorBytes> obstacle_colors_;
  Batch tree_;
  std::size_t triangle_count_ = 0;
  std::vector<Surface> surfaces_;
  Batch obstacles_;
  std::vector<Vec3f> figure_corners_;
  Batch figure_;
  Batch bar_;

  Vec3 base_{0.0};
  double ground_reach_ = 0.0;
  double obstacle_reach_ = 0.0;
  SunView sun_;
  std::unique_ptr<ShadowMap> shadow_map_;
  GlTexture sky_visibility_;
  glm::mat4 world_to_sky_{1.0f};
};

}  // namespace ramify
