#include "viewer/overlay.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

#include "common/mesh/palette.h"
#include "viewer/shaders.h"
#include "viewer/volume_outline.h"

namespace ramify {
namespace {

// More marks than this hide each other and take too long to draw.
constexpr std::size_t kMostMarks = 60'000;

constexpr int kOutlineCells = 36;  // of a volume, along its longest side

constexpr Color kPlain = color_of(0xd1495b);

// Of layers with a mark a node, edge or voxel.
constexpr float kVeil = 0.35f;

// Of a voxel that its square takes up, each way: the voxels can be told apart.
constexpr double kSquareShare = 0.94;

/// From 0 to 1 between the least and the greatest of the values; 0.5 if they are all the same.
template <class T>
class Ramp {
 public:
  explicit Ramp(std::span<const T> values) {
    for (const T value : values) {
      low_ = std::min(low_, static_cast<double>(value));
      high_ = std::max(high_, static_cast<double>(value));
    }
  }
  Color color(T value) const {
    return sequential_color(high_ > low_ ? (static_cast<double>(value) - low_) / (high_ - low_) : 0.5);
  }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

/// Every how many of so many marks one is kept.
std::size_t stride_of(std::size_t count) {
  return std::max<std::size_t>(1, (count + kMostMarks - 1) / kMostMarks);
}

Marks marks_of(const PointLayer& layer) {
  Marks marks;
  marks.width = 4.0;
  const Ramp<double> ramp(layer.values);
  for (std::size_t i = 0; i < layer.points.size(); i += stride_of(layer.points.size())) {
    marks.add(layer.points[i], layer.points[i], layer.values.empty() ? kPlain : ramp.color(layer.values[i]));
  }
  return marks;
}

Marks marks_of(const LineLayer& layer) {
  Marks marks;
  marks.width = 1.0;
  marks.opacity = kVeil;
  const Ramp<double> ramp(layer.values);
  for (std::size_t i = 0; i < layer.lines.size(); i += stride_of(layer.lines.size())) {
    const auto [from, to] = layer.lines[i];
    marks.add(layer.points[from], layer.points[to],
              layer.values.empty() ? kPlain : ramp.color(layer.values[i]));
  }
  return marks;
}

/// Arrows are as long as the points are apart on average, the longest of them.
Marks marks_of(const VectorLayer& layer) {
  Marks marks;
  marks.width = 1.0;
  marks.opacity = kVeil;
  Box box;
  double longest = 0.0;
  for (std::size_t i = 0; i < layer.points.size(); ++i) {
    box.include(layer.points[i]);
    longest = std::max(longest, glm::length(layer.vectors[i]));
  }
  if (longest <= 0.0) return marks;
  const Vec3 size = box.size();
  const double apart = std::cbrt(size.x * size.y * size.z / static_cast<double>(layer.points.size()));
  for (std::size_t i = 0; i < layer.points.size(); i += stride_of(layer.points.size())) {
    marks.add(layer.points[i], layer.points[i] + layer.vectors[i] * (apart / longest), kPlain);
  }
  return marks;
}

/// A square, or a point, in each voxel; the values by their logarithms, as they double from level to level.
Marks marks_of(const VoxelLayer& layer, bool is_slice) {
  Marks marks;
  std::vector<float> logarithms;
  for (const float value : layer.values) logarithms.push_back(std::log(std::max(std::abs(value), 1e-12f)));
  const Ramp<float> ramp(logarithms);
  marks.width = 5.0;
  marks.opacity = is_slice ? 0.85f : 0.5f * kVeil;
  marks.square = is_slice ? kSquareShare * layer.voxel_size : 0.0;
  const std::size_t stride = is_slice ? 1 : stride_of(layer.voxels.size());
  for (std::size_t i = 0; i < layer.voxels.size(); i += stride) {
    if (is_slice && layer.voxels[i].z != 0) continue;
    const Vec3 at = Vec3(layer.voxels[i]) * layer.voxel_size;
    marks.add(at, at, ramp.color(logarithms[i]));
  }
  return marks;
}

Marks outlines(const Job& job) {
  Marks marks;
  marks.width = 2.5;
  std::size_t number = 0;
  for (const Volume* volume : job.engine->volumes(job.parameters.get()).others) {
    const Color color = categorical_color(number++);
    for (const Vec3& point : surface_points(*volume, kOutlineCells)) marks.add(point, point, color);
  }
  return marks;
}

}  // namespace

void Marks::add(const Vec3& start, const Vec3& end, const Color& color) {
  starts.emplace_back(start);
  ends.emplace_back(end);
  colors.push_back(color_bytes(color));
}

Marks marks_of(const Product& product, const std::string& name, bool is_slice) {
  if (name == kVolumes) return product.job ? outlines(*product.job) : Marks();
  if (!product.run) return {};
  for (const Layer& layer : product.run->layers) {
    if (layer.name != name) continue;
    if (const auto* voxels = std::get_if<VoxelLayer>(&layer.data)) return marks_of(*voxels, is_slice);
    if (const auto* points = std::get_if<PointLayer>(&layer.data)) return marks_of(*points);
    if (const auto* lines = std::get_if<LineLayer>(&layer.data)) return marks_of(*lines);
    return marks_of(std::get<VectorLayer>(layer.data));
  }
  return {};
}

std::vector<std::string> overlay_names(const Job& job) {
  std::vector<std::string> names = job.engine->layers(job.parameters.get());
  const UsedVolumes used = job.engine->volumes(job.parameters.get());
  if (!used.others.empty()) names.emplace_back(kVolumes);
  if (!used.obstacles.empty()) names.emplace_back(kObstacles);
  return names;
}

Overlay::Overlay()
    : line_("line", shaders::line_vertex(), shaders::line_fragment()),
      square_("square", shaders::square_vertex(), shaders::line_fragment()) {}

void Overlay::load(const Product& product, const std::set<std::string>& names, bool are_slices) {
  batches_.clear();
  for (const std::string& name : names) {
    const Marks marks = marks_of(product, name, are_slices);
    if (marks.starts.empty()) continue;
    Batch& batch = batches_.emplace_back();
    batch.count = static_cast<int>(marks.starts.size());
    batch.width = marks.width;
    batch.opacity = marks.opacity;
    batch.square = marks.square;
    glBindVertexArray(batch.vertices.id());
    const auto attribute = [](unsigned location, GLint components, GLenum type) {
      glEnableVertexAttribArray(location);
      glVertexAttribPointer(location, components, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE, 0,
                            nullptr);
      glVertexAttribDivisor(location, 1);
    };
    upload(batch.starts, std::span<const Vec3f>(marks.starts));
    attribute(0, 3, GL_FLOAT);
    upload(batch.ends, std::span<const Vec3f>(marks.ends));
    attribute(1, 3, GL_FLOAT);
    upload(batch.colors, std::span<const ColorBytes>(marks.colors));
    attribute(2, 4, GL_UNSIGNED_BYTE);
    glBindVertexArray(0);
  }
}

void Overlay::draw(const Camera& camera, const Viewport& viewport) const {
  if (batches_.empty()) return;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_ZERO, GL_ONE);
  for (const Batch& batch : batches_) {
    const GlProgram& program = batch.square > 0.0 ? square_ : line_;
    program.use();
    program.set("world_to_clip", glm::mat4(camera.world_to_clip()));
    program.set("viewport", Vec2f(viewport.width, viewport.height));
    program.set("half_width", static_cast<float>(viewport.fineness * batch.width / 2.0));
    program.set("side", static_cast<float>(batch.square));
    // Veils do not hide each other.
    glDepthMask(batch.opacity < 1.0f ? GL_FALSE : GL_TRUE);
    glBlendColor(0.0f, 0.0f, 0.0f, batch.opacity);
    glBindVertexArray(batch.vertices.id());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, batch.count);
  }
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
}

}  // namespace ramify
