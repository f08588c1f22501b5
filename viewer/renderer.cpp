#include "viewer/renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "common/base/errors.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"
#include "viewer/offscreen_context.h"
#include "viewer/painter.h"
#include "viewer/render_target.h"

namespace ramify {
namespace {

// Pixels a side of what is drawn at once, at most: larger pictures are put together from parts, so that
// memory does not grow with the picture. Parts begin at multiples of kPartStep, where the dithering's pattern
// repeats.
constexpr int kPartSize = 1024;
constexpr int kPartStep = 8;

// Free at each edge of the picture, in parts of it.
constexpr double kMargin = 0.05;

/// The part of them that is near the tree, or near what else is to have room: in a film it stays the same.
void include_obstacles(const Scene& scene, const RenderOptions& options, Framer& framer) {
  Box tree;
  if (scene.mesh != nullptr) {
    for (const Vec3f& position : scene.mesh->positions) tree.include(Vec3(position));
  }
  for (const Vec3f& point : options.room_for) tree.include(Vec3(point));
  const Box room = obstacle_room(*scene.obstacles, tree);
  if (room.is_empty()) return;
  for (const Vec3& corner : corners(room)) framer.include(corner);
}

void include_scene(const Scene& scene, const RenderOptions& options, Framer& framer) {
  const bool has_lines = options.style == RenderStyle::skeleton;
  if (!has_lines && scene.mesh != nullptr) {
    for (const Vec3f& position : scene.mesh->positions) framer.include(Vec3(position));
  }
  if (scene.skeleton != nullptr && (has_lines || framer.extent().is_empty())) {
    for (const Vec3& position : scene.skeleton->position) framer.include(position);
  }
  if (scene.obstacles != nullptr && options.obstacles_take_room) include_obstacles(scene, options, framer);
  for (const Vec3f& point : options.room_for) framer.include(Vec3(point));
}

/// Pixels of the parts that a side of the picture is cut into.
int part_length(int length) {
  if (length <= kPartSize) return length;
  const int parts = (length + kPartSize - 1) / kPartSize;
  const int even = (length + parts - 1) / parts;
  return (even + kPartStep - 1) / kPartStep * kPartStep;
}

/// Shadow maps are finer than the picture, within what makes a difference.
int shadow_map_size(const RenderOptions& options, int most) {
  const unsigned longer = static_cast<unsigned>(std::max(options.width, options.height));
  return std::min(static_cast<int>(std::bit_ceil(std::clamp(4 * longer, 512u, 4096u))), most);
}

}  // namespace

struct Renderer::Implementation {
  OffscreenContext context;  // first, so that it outlives what lives in it
  Painter painter;
  std::unique_ptr<RenderTarget> target;
  int target_width = 0;
  int target_height = 0;

  void require_target(int width, int height);
  Image draw(const Camera& camera, const RenderOptions& options);
};

void Renderer::Implementation::require_target(int width, int height) {
  if (target && target_width == width && target_height == height) return;
  target.reset();
  target = std::make_unique<RenderTarget>(width, height);
  target_width = width;
  target_height = height;
}

/// Part by part.
Image Renderer::Implementation::draw(const Camera& camera, const RenderOptions& options) {
  const glm::dvec2 size(options.width, options.height);
  const int part_width = part_length(options.width);
  const int part_height = part_length(options.height);
  require_target(part_width, part_height);

  Image image{options.width, options.height, {}};
  image.rgba.resize(4 * static_cast<std::size_t>(options.width) * options.height);
  std::vector<unsigned char> part(4 * static_cast<std::size_t>(part_width) * part_height);
  for (int y = 0; y < options.height; y += part_height) {
    for (int x = 0; x < options.width; x += part_width) {
      Viewport viewport;
      viewport.width = kSupersampling * part_width;
      viewport.height = kSupersampling * part_height;
      viewport.low = glm::dvec2(x, y) / size;
      viewport.high = glm::dvec2(x + part_width, y + part_height) / size;
      viewport.fineness = kSupersampling;
      target->begin();
      painter.draw(camera, viewport);

      // The last part of a row or column may reach beyond the picture.
      const int width = std::min(part_width, options.width - x);
      const int height = std::min(part_height, options.height - y);
      target->finish(width, height);
      target->read_finished(width, height, part.data());
      for (int row = 0; row < height; ++row) {
        const std::size_t top_down = options.height - 1 - (y + row);
        const unsigned char* pixels = part.data() + 4 * static_cast<std::size_t>(row) * width;
        std::copy(pixels, pixels + 4 * width, image.rgba.data() + 4 * (top_down * options.width + x));
      }
    }
  }
  return image;
}

Renderer::Renderer() : implementation_(std::make_unique<Implementation>()) {}

Renderer::~Renderer() {
  try {
    implementation_->context.make_current();
  } catch (const GraphicsError&) {
    // What cannot be deleted in its own context goes with the process.
    static_cast<void>(implementation_.release());
  }
}

std::string Renderer::device() const {
  implementation_->context.make_current();
  return implementation_->context.device();
}

Image Renderer::render(const Scene& scene, const RenderOptions& options) {
  assert(options.width >= 1 && options.height >= 1);
  implementation_->context.make_current();
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (std::max(options.width, options.height) > most) {
    throw GraphicsError(fmt::format("picture of {}x{} pixels: this OpenGL device draws at most {} a side",
                                    options.width, options.height, most));
  }

  Painter& painter = implementation_->painter;
  painter.load(scene, options);

  ViewDirection view = options.view;
  view.is_parallel = view.is_parallel || options.style != RenderStyle::lit;
  const double aspect = static_cast<double>(options.width) / options.height;
  Framer framer(view, aspect, kMargin);
  include_scene(scene, options, framer);
  if (options.with_scale) {
    const Vec3 base = base_of(scene);
    const Vec3 origin = framer.axes().coordinates(base);
    framer.include(base);
    const Annotations annotations =
        make_annotations(glm::dvec2(framer.extent().low - origin), glm::dvec2(framer.extent().high - origin));
    for (const std::vector<Vec2f>* shape : {&annotations.figure, &annotations.bar}) {
      for (const Vec2f& corner : *shape) framer.include(base + framer.axes().world(Vec3(corner, 0.0)));
    }
    painter.load_annotations(annotations, base, framer.axes());
  }
  if (options.style == RenderStyle::lit) {
    painter.cast_shadows(scene, sun_behind(view), shadow_map_size(options, most));
  }

  const Camera camera = options.close_up ? close_up_camera(view, aspect, *options.close_up,
                                                           framer.extent().low.z - painter.reach())
                                         : framer.camera(painter.reach());
  Image image = implementation_->draw(camera, options);
  require_no_gl_error("drawing the picture");
  return image;
}

}  // namespace ramify
