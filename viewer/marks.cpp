#include "viewer/marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

#include "common/base/errors.h"
#include "common/mesh/palette.h"
#include "viewer/nearness.h"

namespace ramify {
namespace {

// More marks than this hide each other and take too long to draw.
constexpr std::size_t kMostMarks = 60'000;

constexpr int kVeilVoxels = 64;  // see surface_of()

constexpr float kPaleness = 0.4f;  // of veils: they are looked through

constexpr Color kPlain = color_of(0xd1495b);

// Alpha of marks that are a node, edge or voxel each: many are thin veils.
constexpr float kVeil = 0.35f;
constexpr float kSquareAlpha = 0.85f;

// Of a voxel that its square, or the radius of its dot, takes up: the voxels can be told apart.
constexpr double kSquareShare = 0.94;
constexpr double kDotShare = 0.3;

// Radius of dots, in parts of how far they are apart.
constexpr double kDotSize = 0.085;

// Dots without values fade from the tree outwards, this far in parts of its size, to this alpha.
constexpr double kNear = 0.08;
constexpr float kFarAlpha = 0.10f;

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

Color with_alpha(Color color, float alpha) {
  color.a = alpha;
  return color;
}

Color paler(const Color& color) {
  const auto towards_white = [](float component) { return component + kPaleness * (1.0f - component); };
  return {towards_white(color.r), towards_white(color.g), towards_white(color.b), color.a};
}

/// Every how many of so many marks one is kept.
std::size_t stride_of(std::size_t count) {
  return std::max<std::size_t>(1, (count + kMostMarks - 1) / kMostMarks);
}

/// Metres between points that fill their box evenly.
double spacing_of(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& point : points) box.include(point);
  if (box.is_empty()) return 0.0;
  const Vec3 size = box.size();
  return std::cbrt(size.x * size.y * size.z / static_cast<double>(points.size()));
}

/// With values: opaque, coloured by them. Without: those near the tree stand out.
Marks marks_of(const PointLayer& layer, const Skeleton& tree) {
  Marks marks;
  marks.shape = MarkShape::dot;
  marks.size = kDotSize * spacing_of(layer.points);
  const Ramp<double> ramp(layer.values);
  std::vector<float> near;
  if (layer.values.empty()) {
    Box box;
    for (const Vec3& position : tree.position) box.include(position);
    const double size = box.is_empty() ? 0.0 : glm::length(box.size());
    near = nearness(layer.points, tree.position, std::max(kNear * size, 1e-3));
  }
  for (std::size_t i = 0; i < layer.points.size(); i += stride_of(layer.points.size())) {
    const Color color = layer.values.empty() ? with_alpha(kPlain, kFarAlpha + (1.0f - kFarAlpha) * near[i])
                                             : ramp.color(layer.values[i]);
    marks.add(layer.points[i], layer.points[i], color);
  }
  return marks;
}

Marks marks_of(const LineLayer& layer) {
  Marks marks;
  const Ramp<double> ramp(layer.values);
  for (std::size_t i = 0; i < layer.lines.size(); i += stride_of(layer.lines.size())) {
    const auto [from, to] = layer.lines[i];
    const Color color = layer.values.empty() ? kPlain : ramp.color(layer.values[i]);
    marks.add(layer.points[from], layer.points[to], with_alpha(color, kVeil));
  }
  return marks;
}

/// Arrows are as long as the points are apart on average, the longest of them.
Marks marks_of(const VectorLayer& layer) {
  Marks marks;
  double longest = 0.0;
  for (const Vec3& vector : layer.vectors) longest = std::max(longest, glm::length(vector));
  if (longest <= 0.0) return marks;
  const double apart = spacing_of(layer.points);
  for (std::size_t i = 0; i < layer.points.size(); i += stride_of(layer.points.size())) {
    marks.add(layer.points[i], layer.points[i] + layer.vectors[i] * (apart / longest),
              with_alpha(kPlain, kVeil));
  }
  return marks;
}

/// A square, or a dot, in each voxel; the values by their logarithms, as they double from level to level.
Marks marks_of(const VoxelLayer& layer, bool is_slice) {
  Marks marks;
  std::vector<float> logarithms;
  for (const float value : layer.values) logarithms.push_back(std::log(std::max(std::abs(value), 1e-12f)));
  const Ramp<float> ramp(logarithms);
  marks.shape = is_slice ? MarkShape::square : MarkShape::dot;
  marks.size = (is_slice ? kSquareShare : kDotShare) * layer.voxel_size;
  const std::size_t stride = is_slice ? 1 : stride_of(layer.voxels.size());
  for (std::size_t i = 0; i < layer.voxels.size(); i += stride) {
    if (is_slice && layer.voxels[i].z != 0) continue;
    const Vec3 at = Vec3(layer.voxels[i]) * layer.voxel_size;
    marks.add(at, at, with_alpha(ramp.color(logarithms[i]), is_slice ? kSquareAlpha : 0.5f * kVeil));
  }
  return marks;
}

/// How much the normals turn along the edges at each position, on average.
std::vector<float> bends_of(const VolumeSurface& surface) {
  std::vector<float> bends(surface.positions.size(), 0.0f);
  std::vector<float> counts(surface.positions.size(), 0.0f);
  for (const std::array<std::uint32_t, 3>& triangle : surface.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = triangle[corner];
      const std::uint32_t to = triangle[(corner + 1) % 3];
      const float length = glm::distance(surface.positions[from], surface.positions[to]);
      if (length <= 0.0f) continue;
      const float bend = glm::distance(surface.normals[from], surface.normals[to]) / length;
      for (const std::uint32_t end : {from, to}) {
        bends[end] += bend;
        counts[end] += 1.0f;
      }
    }
  }
  for (std::size_t i = 0; i < bends.size(); ++i) bends[i] /= std::max(counts[i], 1.0f);
  return bends;
}

}  // namespace

void Marks::add(const Vec3& start, const Vec3& end, const Color& color) {
  starts.emplace_back(start);
  ends.emplace_back(end);
  colors.push_back(color_bytes(color));
}

bool Marks::are_opaque() const {
  return std::all_of(colors.begin(), colors.end(), [](const ColorBytes& color) { return color[3] == 255; });
}

Marks marks_of(const Product& product, const std::string& name, bool is_slice) {
  if (!product.run) return {};
  for (const Layer& layer : product.run->layers) {
    if (layer.name != name) continue;
    if (const auto* voxels = std::get_if<VoxelLayer>(&layer.data)) return marks_of(*voxels, is_slice);
    if (const auto* points = std::get_if<PointLayer>(&layer.data)) return marks_of(*points, product.skeleton);
    if (const auto* lines = std::get_if<LineLayer>(&layer.data)) return marks_of(*lines);
    return marks_of(std::get<VectorLayer>(layer.data));
  }
  return {};
}

std::vector<Veil> veils_of(const Product& product) {
  std::vector<Veil> veils;
  if (!product.job) return veils;
  std::size_t number = 0;
  for (const Volume* volume : product.job->engine->volumes(product.job->parameters.get()).others) {
    const Color color = paler(categorical_color(number++));
    try {
      VolumeSurface surface = surface_of(*volume, kVeilVoxels);
      if (surface.triangles.empty()) continue;
      std::vector<float> bends = bends_of(surface);
      veils.push_back({std::move(surface), std::move(bends), color});
    } catch (const InputError&) {
      // The check has told.
    }
  }
  return veils;
}

std::vector<std::string> overlay_names(const Job& job) {
  std::vector<std::string> names = job.engine->layers(job.parameters.get());
  const UsedVolumes used = job.engine->volumes(job.parameters.get());
  if (!used.others.empty()) names.emplace_back(kVolumes);
  if (!used.obstacles.empty()) names.emplace_back(kObstacles);
  return names;
}

}  // namespace ramify
