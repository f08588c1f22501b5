#include "viewer/painter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"
#include "viewer/shaders.h"
#include "viewer/sky_light.h"

namespace ramify {
namespace {

// Attribute locations in the shaders.
constexpr GLuint kPosition = 0;
constexpr GLuint kNormal = 1;
constexpr GLuint kColor = 2;
constexpr GLuint kUv = 3;

// Texture units.
constexpr int kSunDepthUnit = 0;
constexpr int kCoverageUnit = 1;
constexpr int kSkyUnit = 2;
constexpr int kImageUnit = 3;
constexpr int kNormalMapUnit = 4;

// The sky of pictures without a background of their own, and the ground under it.
constexpr Color kSkyTop = color_of(0xc6d3dd);
constexpr Color kSkyBottom = color_of(0xedecea);
constexpr Color kGround = color_of(0xe3e0da);
constexpr Color kInk = color_of(0x2b2b2b);

// Obstacles: plaster in the sun, and behind a drawing's black.
constexpr Color kPlaster = color_of(0xc9c3b8);
constexpr Color kPale = color_of(0xdcdcd8);

constexpr double kLineWidth = 1.5;  // of the style skeleton, pixels of the picture

// More than a buffer of indices holds: three times as many can be counted, too.
constexpr std::size_t kMostTriangles = std::size_t{1} << 40;

// Bytes that are copied to the device in one go: a few milliseconds.
constexpr std::size_t kSlice = std::size_t{4} << 20;

// The ground fades out this far from the tree, in parts of the tree's size.
constexpr double kGroundReach = 3.5;

Vec3f linear_color(const Color& color) {
  return {linear_of(color.r), linear_of(color.g), linear_of(color.b)};
}

/// Linear, alpha multiplied in.
glm::vec4 as_light(const Color& color) {
  return {linear_color(color) * color.a, color.a};
}

/// What is drawn now lies on what was drawn before and leaves its depth and opacity.
void begin_overlay() {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  glDepthMask(GL_FALSE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1.0f, -1.0f);
}

void end_overlay() {
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

/// `buffer` as the vertex attribute at `location` of the vertex array that is bound; `advance` 1: one an
/// instance.
void set_attribute(GLuint location, const GlBuffer& buffer, GLint components, GLenum type,
                   GLuint advance = 0) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, 0,
                        nullptr);
  glVertexAttribDivisor(location, advance);
}

/// The same, filled with `data`.
template <class T>
void add_attribute(GLuint location, const GlBuffer& buffer, std::span<const T> data, GLint components,
                   GLenum type, GLuint advance = 0) {
  upload(buffer, data);
  set_attribute(location, buffer, components, type, advance);
}

void bind_texture(int unit, GLenum target, const GlTexture& texture) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, texture.id());
}

/// Repeats each way, with coarser and coarser copies. Row 0 of the image becomes the upper edge, v = 1.
GlTexture texture_of(const Image& image, bool is_srgb) {
  const std::size_t row_bytes = 4 * static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> bottom_up;
  bottom_up.reserve(image.rgba.size());
  for (int y = image.height - 1; y >= 0; --y) {
    bottom_up.insert(bottom_up.end(), image.pixel(0, y), image.pixel(0, y) + row_bytes);
  }
  GlTexture texture;
  bind_texture(kImageUnit, GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, is_srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width, image.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, bottom_up.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

/// Maps the part of the picture that the viewport shows to the whole of clip space.
glm::dmat4 cropped(const Viewport& viewport) {
  const glm::dvec2 scale = 1.0 / (viewport.high - viewport.low);
  const glm::dvec2 middle = viewport.low + viewport.high - 1.0;
  return glm::translate(glm::scale(glm::dmat4(1.0), Vec3(scale, 1.0)), Vec3(-middle, 0.0));
}

glm::mat4 moved(const glm::dmat4& world_to_clip, const Vec3& origin) {
  return glm::mat4(glm::translate(world_to_clip, origin));
}

/// Metres of the longest side of the points' box; 0 for none.
double longest_side(std::span<const Vec3f> points) {
  Box box;
  for (const Vec3f& point : points) box.include(Vec3(point));
  if (box.is_empty()) return 0.0;
  return std::max({box.size().x, box.size().y, box.size().z});
}

}  // namespace

PaintPrograms::PaintPrograms()
    : background("background", shaders::screen_vertex(), shaders::background_fragment()),
      caster("caster", shaders::caster_vertex(), shaders::caster_fragment()),
      flat("flat", shaders::flat_vertex(), shaders::flat_fragment()),
      lit("lit", shaders::lit_vertex(), shaders::lit_fragment()),
      ground("ground", shaders::ground_vertex(), shaders::ground_fragment()),
      line("line", shaders::line_vertex(), shaders::line_fragment()) {}

Painter::Painter(std::shared_ptr<const PaintPrograms> programs) : programs_(std::move(programs)) {}

void Painter::load(const Scene& scene, const RenderOptions& options) {
  begin_load(scene, options);
  while (load_more()) {
  }
}

bool Painter::load_more() {
  if (to_load_.empty()) return false;
  // A step may add others, which come next.
  const std::function<void()> step = std::move(to_load_.front());
  to_load_.pop_front();
  step();
  return !to_load_.empty();
}

void Painter::begin_load(const Scene& scene, const RenderOptions& options) {
  to_load_.clear();
  options_ = options;
  tree_ = Batch();
  triangle_count_ = 0;
  surfaces_.clear();
  obstacles_ = Batch();
  obstacle_reach_ = 0.0;
  figure_ = Batch();
  figure_corners_.clear();
  bar_ = Batch();
  base_ = base_of(scene);
  ground_reach_ = 0.0;
  to_load_.emplace_back([this, scene] {
    if (options_.style == RenderStyle::skeleton) {
      load_lines(scene);
    } else {
      load_mesh(scene);
    }
  });
  if (scene.obstacles != nullptr && !scene.obstacles->triangles.empty()) {
    to_load_.emplace_back([this, scene] { load_obstacles(*scene.obstacles); });
  }
  if (options.style == RenderStyle::lit) to_load_.emplace_back([this, scene] { load_sky_light(scene); });
}

void Painter::load_mesh(const Scene& scene) {
  tree_colors_ = vertex_colors(scene, options_);
  if (scene.mesh == nullptr || scene.mesh->triangles.empty()) return;
  const Mesh& mesh = *scene.mesh;
  triangle_count_ = mesh.triangles.size();
  for (const MaterialRange& range : mesh.ranges) {
    if (mesh.material(range).is_overlay && is_plain()) continue;
    // The mesher's branches are closed; a file's need not be, and leaves have two sides.
    const bool is_closed = scene.skeleton != nullptr && !mesh.material(range).is_two_sided;
    tree_.ranges.push_back(
        {3 * range.first_triangle, static_cast<int>(3 * range.triangle_count), is_closed, range.material});
  }
  // Surfaces are counted in this order.
  const bool shows_color = shows_materials(mesh);
  for (auto material = mesh.materials.rbegin(); material != mesh.materials.rend(); ++material) {
    to_load_.emplace_front([this, shown = &*material, shows_color] { load_surface(*shown, shows_color); });
  }
  to_load_.emplace_front([this] { tree_colors_ = {}; });
  load_triangles(tree_, mesh, tree_colors_);
}

void Painter::load_obstacles(const Mesh& obstacles) {
  const Color color = options_.style == RenderStyle::lit ? kPlaster : kPale;
  obstacle_colors_.assign(obstacles.vertex_count(), color_bytes(color));
  obstacles_.ranges.push_back({0, static_cast<int>(3 * obstacles.triangles.size()), true, surfaces_.size()});
  surfaces_.emplace_back();
  for (const Vec3f& position : obstacles.positions) {
    obstacle_reach_ = std::max(obstacle_reach_, glm::distance(Vec3(position), base_));
  }
  load_triangles(obstacles_, obstacles, obstacle_colors_);
}

/// Makes room for the mesh; the rest of load_more() fills it. Without ranges: the caller knows the materials.
void Painter::load_triangles(Batch& batch, const Mesh& mesh, const std::vector<ColorBytes>& colors) {
  const auto fill = [this](const GlBuffer& buffer, const auto& values) {
    load_later(buffer, values.data(), values.size() * sizeof(values[0]));
  };
  fill(batch.positions, mesh.positions);
  if (options_.style == RenderStyle::lit) fill(batch.normals, mesh.normals);
  fill(batch.colors, colors);
  fill(batch.uvs, mesh.uvs);
  fill(batch.indices, mesh.triangles);

  glBindVertexArray(batch.vertices.id());
  set_attribute(kPosition, batch.positions, 3, GL_FLOAT);
  if (options_.style == RenderStyle::lit) set_attribute(kNormal, batch.normals, 3, GL_FLOAT);
  set_attribute(kColor, batch.colors, 4, GL_UNSIGNED_BYTE);
  set_attribute(kUv, batch.uvs, 2, GL_FLOAT);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, batch.indices.id());
  glBindVertexArray(0);
}

/// In slices, before what else is to be loaded.
void Painter::load_later(const GlBuffer& buffer, const void* data, std::size_t byte_count) {
  glBindBuffer(GL_COPY_WRITE_BUFFER, buffer.id());
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(byte_count), nullptr, GL_STATIC_DRAW);
  for (std::size_t first = 0; first < byte_count; first += kSlice) {
    const std::size_t size = std::min(kSlice, byte_count - first);
    to_load_.emplace_front(
        [id = buffer.id(), from = static_cast<const std::byte*>(data) + first, first, size] {
          glBindBuffer(GL_COPY_WRITE_BUFFER, id);
          glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(first), static_cast<GLsizeiptr>(size),
                          from);
        });
  }
}

void Painter::load_surface(const Material& material, bool shows_color) {
  // In plain colours an image only tells where a leaf ends.
  Surface surface;
  if (!is_plain() && shows_color) surface.color = material.color;
  surface.is_thin = material.is_two_sided;
  surface.is_overlay = material.is_overlay;
  surface.is_cutout = material.is_cutout && !material.image.is_empty();
  if (!material.image.is_empty() && (!is_plain() || surface.is_cutout)) {
    surface.image = texture_of(material.image, true);
  }
  if (!material.normal_map.is_empty() && !is_plain()) {
    surface.normal_map = texture_of(material.normal_map, false);
  }
  surfaces_.push_back(std::move(surface));
}

void Painter::load_lines(const Scene& scene) {
  const std::vector<ColorBytes> of_node = node_colors(scene, options_);
  const Skeleton& skeleton = *scene.skeleton;
  std::vector<Vec3f> starts;
  std::vector<Vec3f> ends;
  std::vector<ColorBytes> colors;
  for (std::size_t node = skeleton.root_count(); node < skeleton.node_count(); ++node) {
    starts.emplace_back(skeleton.position[skeleton.parent[node]] - base_);
    ends.emplace_back(skeleton.position[node] - base_);
    colors.push_back(of_node[node]);
  }
  if (starts.empty()) return;
  tree_.origin = base_;
  tree_.count = static_cast<int>(starts.size());
  glBindVertexArray(tree_.vertices.id());
  add_attribute<Vec3f>(kPosition, tree_.positions, starts, 3, GL_FLOAT, 1);
  add_attribute<Vec3f>(kNormal, tree_.normals, ends, 3, GL_FLOAT, 1);
  add_attribute<ColorBytes>(kColor, tree_.colors, colors, 4, GL_UNSIGNED_BYTE, 1);
  glBindVertexArray(0);
}

void Painter::load_sky_light(const Scene& scene) {
  SkyLight sky;
  if (options_.with_occlusion && scene.sky != nullptr) {
    sky = *scene.sky;
  } else if (options_.with_occlusion && scene.mesh != nullptr) {
    sky = sky_light(*scene.mesh, base_.y);
  }
  double size = 1.0;
  if (sky.visibility.empty()) {
    // What the box of the sky's light would measure.
    const double side = longest_side(outline_of(scene));
    if (side > 0.0) size = 1.3 * side;
    sky.box = {base_, base_ + 1.0};
    sky.size = Coord(1);
    sky.visibility = {255};
  } else {
    const Vec3 extent = sky.box.size();
    size = std::max({extent.x, extent.y, extent.z});
  }
  // Trees drawn to one scale stand on one ground.
  ground_reach_ = kGroundReach * std::max(size, longest_side(options_.room_for));
  world_to_sky_ = glm::mat4(glm::translate(glm::scale(glm::dmat4(1.0), 1.0 / sky.box.size()), -sky.box.low));

  bind_texture(kSkyUnit, GL_TEXTURE_3D, sky_visibility_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R8, sky.size.x, sky.size.y, sky.size.z, 0, GL_RED, GL_UNSIGNED_BYTE,
               sky.visibility.data());
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (GLenum direction : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTexParameteri(GL_TEXTURE_3D, direction, GL_CLAMP_TO_EDGE);
  }
}

void Painter::load_annotations(const Annotations& annotations, const Vec3& base, const CameraAxes& axes) {
  figure_ = flat_batch(annotations.figure, axes);
  figure_.origin = base;
  bar_ = flat_batch(annotations.bar, axes);
  bar_.origin = base;
  for (const Vec2f& corner : annotations.figure) {
    figure_corners_.emplace_back(base + axes.world(Vec3(corner, 0.0)));
  }
}

Painter::Batch Painter::flat_batch(const std::vector<Vec2f>& corners, const CameraAxes& axes) const {
  std::vector<Vec3f> positions;
  for (const Vec2f& corner : corners) positions.emplace_back(axes.world(Vec3(corner, 0.0)));
  const ColorBytes ink = color_bytes(options_.style == RenderStyle::lit ? kInk : Color());
  const std::vector<ColorBytes> colors(corners.size(), ink);
  Batch batch;
  glBindVertexArray(batch.vertices.id());
  add_attribute<Vec3f>(kPosition, batch.positions, positions, 3, GL_FLOAT);
  add_attribute<ColorBytes>(kColor, batch.colors, colors, 4, GL_UNSIGNED_BYTE);
  glBindVertexArray(0);
  batch.count = static_cast<int>(corners.size());
  return batch;
}

void Painter::cast_shadows(const Scene& scene, const CameraAxes& sun, int map_size, const TreePart& part) {
  if (part.is_first()) {
    const std::span<const Vec3f> tree = outline_of(scene);
    std::span<const Vec3f> obstacles;
    if (scene.obstacles != nullptr) obstacles = scene.obstacles->positions;
    sun_ = sun_view(sun, {tree, obstacles, figure_corners_}, base_.y);
  }
  if (!shadow_map_ || shadow_map_->size() != map_size) shadow_map_ = std::make_unique<ShadowMap>(map_size);

  shadow_map_->begin(part.is_first());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  programs_->caster.use();
  if (options_.with_occlusion) {
    cast(tree_, part);
    if (part.is_last()) cast(obstacles_);
    if (part.is_last()) cast(figure_);
  }
  if (part.is_last()) shadow_map_->finish();
}

void Painter::cast(const Batch& batch, const TreePart& part) const {
  programs_->caster.set("world_to_map", moved(sun_.world_to_map, batch.origin));
  programs_->caster.set("ground", static_cast<float>(base_.y - batch.origin.y));
  draw_triangles(batch, programs_->caster, part);
}

bool Painter::is_plain() const {
  return !options_.color_by.empty() || options_.style == RenderStyle::schematic;
}

bool Painter::has_ground(const Camera& camera) const {
  const bool is_opaque = !options_.background || options_.background->a >= 1.0f;
  // From below it would hide the tree.
  const bool is_above = camera.is_parallel ? camera.axes.back.y > 0.0 : camera.eye.y > base_.y;
  return options_.style == RenderStyle::lit && is_opaque && is_above;
}

void Painter::draw(const Camera& camera, const Viewport& viewport, const TreePart& part) {
  const glm::dmat4 world_to_clip = cropped(viewport) * camera.world_to_clip();
  glViewport(0, 0, viewport.width, viewport.height);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  if (part.is_first()) {
    glClearDepth(1.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST);
    draw_background(viewport);
  }
  draw_over(camera, viewport, part);
  if (!part.is_last()) return;

  draw_flat(figure_, world_to_clip);
  if (has_ground(camera)) draw_ground(world_to_clip);
  glDisable(GL_DEPTH_TEST);
  draw_flat(bar_, world_to_clip);
  glBindVertexArray(0);
}

void Painter::draw_over(const Camera& camera, const Viewport& viewport, const TreePart& part) {
  const glm::dmat4 world_to_clip = cropped(viewport) * camera.world_to_clip();
  glViewport(0, 0, viewport.width, viewport.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  if (options_.style == RenderStyle::skeleton) {
    draw_lines(world_to_clip, viewport);
  } else {
    draw_solid(tree_, world_to_clip, part);
  }
  if (part.is_last()) draw_solid(obstacles_, world_to_clip);
  glBindVertexArray(0);
}

void Painter::draw_background(const Viewport& viewport) const {
  glm::vec4 bottom = as_light(options_.background.value_or(color_of(0xffffff)));
  glm::vec4 top = bottom;
  if (!options_.background && options_.style == RenderStyle::lit) {
    bottom = as_light(kSkyBottom);
    top = as_light(kSkyTop);
  }
  programs_->background.use();
  programs_->background.set("bottom", bottom);
  programs_->background.set("top", top);
  programs_->background.set("part", Vec2f(viewport.low.y, viewport.high.y));
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Painter::draw_solid(const Batch& batch, const glm::dmat4& world_to_clip, const TreePart& part) const {
  if (batch.ranges.empty()) return;
  const GlProgram& program = options_.style == RenderStyle::lit ? programs_->lit : programs_->flat;
  program.use();
  program.set("world_to_clip", moved(world_to_clip, batch.origin));
  if (options_.style == RenderStyle::lit) {
    set_light(program);
    bind_texture(kSunDepthUnit, GL_TEXTURE_2D, shadow_map_->depth());
    program.set("sun_depth", kSunDepthUnit);
    program.set("texel", static_cast<float>(std::max(sun_.size.x, sun_.size.y) / shadow_map_->size()));
  }
  draw_triangles(batch, program, part);
}

void Painter::draw_lines(const glm::dmat4& world_to_clip, const Viewport& viewport) const {
  programs_->line.use();
  programs_->line.set("world_to_clip", moved(world_to_clip, tree_.origin));
  programs_->line.set("viewport", Vec2f(viewport.width, viewport.height));
  programs_->line.set("half_width", static_cast<float>(viewport.fineness * kLineWidth / 2.0));
  glBindVertexArray(tree_.vertices.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, tree_.count);
}

void Painter::draw_ground(const glm::dmat4& world_to_clip) const {
  programs_->ground.use();
  programs_->ground.set("world_to_clip", glm::mat4(world_to_clip));
  programs_->ground.set("middle", Vec3f(base_));
  programs_->ground.set("reach", static_cast<float>(ground_reach_));
  programs_->ground.set("paint", linear_color(options_.background.value_or(kGround)));
  programs_->ground.set("penumbra", static_cast<float>(kPenumbra));
  set_light(programs_->ground);
  bind_texture(kCoverageUnit, GL_TEXTURE_2D, shadow_map_->coverage());
  programs_->ground.set("shade", kCoverageUnit);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDisable(GL_BLEND);
}

void Painter::draw_flat(const Batch& batch, const glm::dmat4& world_to_clip) const {
  programs_->flat.use();
  programs_->flat.set("world_to_clip", moved(world_to_clip, batch.origin));
  draw_triangles(batch, programs_->flat);
}

void Painter::draw_triangles(const Batch& batch, const GlProgram& program, const TreePart& part) const {
  glBindVertexArray(batch.vertices.id());
  if (batch.count > 0) {
    set_surface({}, program);
    glDrawArrays(GL_TRIANGLES, 0, batch.count);
  }
  for (const Range& range : batch.ranges) {
    const std::size_t first = std::max(range.first, 3 * part.first);
    const std::size_t end = std::min(range.first + range.count, 3 * std::min(part.end, kMostTriangles));
    if (first >= end) continue;
    const Surface& surface = surfaces_[range.surface];
    // What an overlay lies on casts its shadow.
    if (surface.is_overlay && &program == &programs_->caster) continue;
    set_surface(surface, program);
    if (range.is_closed) glEnable(GL_CULL_FACE);
    // A leaf's edge covers as many of a pixel's samples as its alpha says.
    for (const GLenum capability : {GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE}) {
      if (surface.is_cutout) glEnable(capability);
    }
    if (surface.is_overlay) begin_overlay();
    const void* offset = reinterpret_cast<const void*>(first * sizeof(std::uint32_t));
    glDrawElements(GL_TRIANGLES, static_cast<int>(end - first), GL_UNSIGNED_INT, offset);
    if (surface.is_overlay) end_overlay();
    for (const GLenum capability : {GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE})
      glDisable(capability);
    glDisable(GL_CULL_FACE);
  }
}

void Painter::set_surface(const Surface& surface, const GlProgram& program) const {
  program.set("surface_color", surface.color);
  program.set("is_cutout", surface.is_cutout ? 1 : 0);
  program.set("is_overlay", surface.is_overlay ? 1 : 0);
  program.set("is_thin", surface.is_thin ? 1 : 0);
  program.set("has_image", surface.image && !is_plain() ? 1 : 0);
  program.set("has_normal_map", surface.normal_map ? 1 : 0);
  program.set("image", kImageUnit);
  program.set("normal_map", kNormalMapUnit);
  if (surface.image) bind_texture(kImageUnit, GL_TEXTURE_2D, *surface.image);
  if (surface.normal_map) bind_texture(kNormalMapUnit, GL_TEXTURE_2D, *surface.normal_map);
}

void Painter::set_light(const GlProgram& program) const {
  program.set("to_sun", Vec3f(sun_.axes.back));
  program.set("world_to_map", glm::mat4(sun_.world_to_map));
  program.set("map_size", Vec2f(sun_.size));
  program.set("map_depth", static_cast<float>(sun_.depth));
  program.set("world_to_sky", world_to_sky_);
  program.set("sky_visibility", kSkyUnit);
  bind_texture(kSkyUnit, GL_TEXTURE_3D, sky_visibility_);
}

}  // namespace ramify
