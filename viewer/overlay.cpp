#include "viewer/overlay.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <span>

#include "viewer/shaders.h"

namespace ramify {
namespace {

// Veils fade out this far from the tree, in parts of its size: a half-space has no end.
constexpr double kVeilReach = 1.6;

// Radii of dots, pixels of the picture.
constexpr double kSmallestDot = 0.6;
constexpr double kLargestDot = 3.0;

void set_attribute(unsigned location, GLint components, GLenum type, GLuint advance) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, 0,
                        nullptr);
  glVertexAttribDivisor(location, advance);
}

}  // namespace

OverlayPrograms::OverlayPrograms()
    : line("line", shaders::line_vertex(), shaders::line_fragment()),
      dot("dot", shaders::dot_vertex(), shaders::dot_fragment()),
      square("square", shaders::square_vertex(), shaders::line_fragment()),
      veil("veil", shaders::veil_vertex(), shaders::veil_fragment()) {}

void Overlay::load(const Product& product, const std::set<std::string>& names, bool are_slices) {
  batches_.clear();
  veils_.clear();
  for (const std::string& name : names) load_marks(marks_of(product, name, are_slices));
  if (names.count(kVolumes) == 0 || !product.run) return;
  for (const Veil& veil : veils_of(product)) load_veil(veil);
  Box tree;  // all of it, however little of it is shown
  for (const Vec3& position : product.run->skeleton.position) tree.include(position);
  if (tree.is_empty()) return;
  middle_ = tree.center();
  const Vec3 size = tree.size();
  veil_reach_ = kVeilReach * std::max({size.x, size.y, size.z});
}

void Overlay::load_marks(const Marks& marks) {
  if (marks.starts.empty()) return;
  Batch& batch = batches_.emplace_back();
  batch.shape = marks.shape;
  batch.size = marks.size;
  batch.is_opaque = marks.are_opaque();
  batch.count = static_cast<int>(marks.starts.size());
  glBindVertexArray(batch.vertices.id());
  upload(batch.starts, std::span<const Vec3f>(marks.starts));
  set_attribute(0, 3, GL_FLOAT, 1);
  upload(batch.ends, std::span<const Vec3f>(marks.ends));
  set_attribute(1, 3, GL_FLOAT, 1);
  upload(batch.colors, std::span<const ColorBytes>(marks.colors));
  set_attribute(2, 4, GL_UNSIGNED_BYTE, 1);
  glBindVertexArray(0);
}

void Overlay::load_veil(const Veil& veil) {
  VeilBatch& batch = veils_.emplace_back();
  batch.color = veil.color;
  batch.count = static_cast<int>(3 * veil.surface.triangles.size());
  glBindVertexArray(batch.vertices.id());
  upload(batch.positions, std::span<const Vec3f>(veil.surface.positions));
  set_attribute(0, 3, GL_FLOAT, 0);
  upload(batch.normals, std::span<const Vec3f>(veil.surface.normals));
  set_attribute(1, 3, GL_FLOAT, 0);
  upload(batch.bends, std::span<const float>(veil.bends));
  set_attribute(2, 1, GL_FLOAT, 0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, batch.indices.id());
  const std::size_t byte_count = veil.surface.triangles.size() * sizeof(veil.surface.triangles[0]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(byte_count), veil.surface.triangles.data(),
               GL_STATIC_DRAW);
  glBindVertexArray(0);
}

void Overlay::draw(const Camera& camera, const Viewport& viewport) const {
  if (batches_.empty() && veils_.empty()) return;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_BLEND);
  // Colours come with their alpha multiplied in; the picture's own alpha stays.
  glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  for (const Batch& batch : batches_) draw_marks(batch, camera, viewport);
  draw_veils(camera);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
}

const GlProgram& Overlay::program_of(MarkShape shape) const {
  switch (shape) {
    case MarkShape::dot:
      return programs_->dot;
    case MarkShape::square:
      return programs_->square;
    case MarkShape::line:
      break;
  }
  return programs_->line;
}

void Overlay::draw_marks(const Batch& batch, const Camera& camera, const Viewport& viewport) const {
  const GlProgram& program = program_of(batch.shape);
  program.use();
  program.set("world_to_clip", glm::mat4(camera.world_to_clip()));
  program.set("viewport", Vec2f(viewport.width, viewport.height));
  program.set("half_width", static_cast<float>(viewport.fineness * batch.size / 2.0));
  program.set("side", static_cast<float>(batch.size));
  program.set("radius", static_cast<float>(batch.size * viewport.height / (2.0 * camera.half_size.y)));
  program.set("bounds", Vec2f(viewport.fineness * glm::dvec2(kSmallestDot, kLargestDot)));
  // What is seen through does not hide what comes after it.
  glDepthMask(batch.is_opaque ? GL_TRUE : GL_FALSE);
  glBindVertexArray(batch.vertices.id());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, batch.count);
}

void Overlay::draw_veils(const Camera& camera) const {
  glDepthMask(GL_FALSE);
  programs_->veil.use();
  programs_->veil.set("world_to_clip", glm::mat4(camera.world_to_clip()));
  const Vec3& eye = camera.is_parallel ? camera.axes.back : camera.eye;
  programs_->veil.set("eye", glm::vec4(Vec3f(eye), camera.is_parallel ? 0.0f : 1.0f));
  programs_->veil.set("middle", Vec3f(middle_));
  programs_->veil.set("reach", static_cast<float>(veil_reach_));
  for (const VeilBatch& batch : veils_) {
    programs_->veil.set("paint",
                        Vec3f(linear_of(batch.color.r), linear_of(batch.color.g), linear_of(batch.color.b)));
    glBindVertexArray(batch.vertices.id());
    glDrawElements(GL_TRIANGLES, batch.count, GL_UNSIGNED_INT, nullptr);
  }
}

}  // namespace ramify
