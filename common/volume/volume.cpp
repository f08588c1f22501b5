#include "common/volume/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/volume/level_set.h"
#include "common/volume/primitive.h"
#include "common/volume/profile.h"

namespace ramify {
namespace {

// Points counted a task: some tens of microseconds.
constexpr std::size_t kPointsPerTask = 4096;

bool has_axis(Shape shape) {
  return shape == Shape::cylinder || shape == Shape::cone || shape == Shape::hemisphere ||
         shape == Shape::sphere_portion || shape == Shape::revolution;
}

/// What a shape made of parts is called in messages; empty for the others.
std::string compound_name(Shape shape) {
  switch (shape) {
    case Shape::union_of:
      return "a union";
    case Shape::difference:
      return "a difference";
    case Shape::intersection:
      return "an intersection";
    default:
      return {};
  }
}

/// The volume of the part of `box` for which is_inside is true, by the share of evenly spread points that
/// are. M. Roberts' R3 sequence, 2018: a regular grid of as many points is off by up to 2 % where it lies
/// along a face.
template <class Inside>
double counted_volume(const Box& box, int points, const Inside& is_inside) {
  if (box.is_empty()) return 0.0;
  constexpr double kPlastic = 1.2207440846057596;  // the root of x^4 = x + 1
  const Vec3 stride = 1.0 / Vec3(kPlastic, kPlastic * kPlastic, kPlastic * kPlastic * kPlastic);
  const Vec3 size = box.size();

  const auto count = static_cast<std::size_t>(points);
  std::vector<std::size_t> inside((count + kPointsPerTask - 1) / kPointsPerTask, 0);
  parallel_for(inside.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * kPointsPerTask; i < std::min(end * kPointsPerTask, count); ++i) {
      const Vec3 place = glm::fract(static_cast<double>(i + 1) * stride);
      if (is_inside(box.low + place * size)) ++inside[i / kPointsPerTask];
    }
  });
  const std::size_t total = std::accumulate(inside.begin(), inside.end(), std::size_t{0});
  return size.x * size.y * size.z * static_cast<double>(total) / static_cast<double>(points);
}

void check_sketch(const Volume& volume, const std::string& key) {
  const std::string where = volume.file.empty() ? ".points" : ".file";
  if (!volume.file.empty() && !volume.points.empty()) {
    throw ConfigError("", key + ".file", "points are given, too (either of them)");
  }
  if (volume.file.empty() && volume.points.empty()) {
    throw ConfigError("", key + ".points", "a revolution without a sketch (points, or a file of them)");
  }
  const std::string problem = sketch_problem(sketch_of(volume));
  if (problem.empty()) return;
  const std::string file = volume.file.empty() ? "" : volume.file.string() + ": ";
  throw ConfigError("", key + where, file + problem);
}

void check_mesh(const Volume& volume, const std::string& key) {
  if (volume.file.empty()) throw ConfigError("", key + ".file", "a mesh without a file (a closed mesh, OBJ)");
  level_set_of(volume.file, volume.voxel_size);
}

void check_shape(const Volume& volume, const std::string& key) {
  const std::string compound = compound_name(volume.shape);
  if (!compound.empty() && volume.parts.empty()) {
    throw ConfigError("", key, compound + " without parts (at least one part)");
  }
  if (!compound.empty()) {
    for (std::size_t i = 0; i < volume.parts.size(); ++i) {
      check_shape(volume.parts[i], fmt::format("{}.parts.{}", key, i + 1));
    }
  }
  if (has_axis(volume.shape) && glm::length(volume.direction) < 1e-6) {
    throw ConfigError("", key + ".direction",
                      "its length is 0 (any other length; only where it points counts)");
  }
  try {
    if (volume.shape == Shape::revolution) check_sketch(volume, key);
    if (volume.shape == Shape::mesh) check_mesh(volume, key);
  } catch (const InputError& error) {
    throw ConfigError("", key + ".file", error.what());
  }
}

}  // namespace

bool contains(const Volume& volume, const Vec3& point) {
  return Solid(volume).contains(point);
}

Box bounds(const Volume& volume) {
  return Solid(volume).bounds();
}

double outer_depth(const Volume& volume, const Vec3& point) {
  return Solid(volume).outer_depth(point);
}

double volume_of(const Volume& volume, int points) {
  const Solid solid(volume);
  return counted_volume(solid.bounds(), points, [&](const Vec3& point) { return solid.contains(point); });
}

double shared_volume_of(const Volume& a, const Volume& b, int points) {
  const Solid solid_a(a);
  const Solid solid_b(b);
  const Box box_a = solid_a.bounds();
  const Box box_b = solid_b.bounds();
  const Box shared{glm::max(box_a.low, box_b.low), glm::min(box_a.high, box_b.high)};
  return counted_volume(
      shared, points, [&](const Vec3& point) { return solid_a.contains(point) && solid_b.contains(point); });
}

double check_volume(const Volume& volume, const std::string& key) {
  check_shape(volume, key);
  const double cubic_metres = volume_of(volume);
  if (cubic_metres > 0.0) return cubic_metres;
  throw ConfigError("", key, "nothing inside it (sizes that fill at least a hundred-thousandth of its box)");
}

const Table& Volume::fields() {
  // Larger than any plant, and small enough that a cell's number still fits.
  constexpr double kFar = 1000.0;
  static const Table table = make_table<Volume>({
      {"shape",
       &Volume::shape,
       {.help = "what the solid is",
        .source = "XM12 3.3.1",
        .choices = {"sphere", "ellipsoid", "cylinder", "cone", "hemisphere", "sphere_portion", "box",
                    "revolution", "mesh", "union", "difference", "intersection"}}},
      {"center",
       &Volume::center,
       {.min = -kFar,
        .max = kFar,
        .unit = "metres",
        .help = "middle of a sphere, ellipsoid or box, of the base of the others; a portion's apex; height 0 "
                "of a "
                "revolution"}},
      {"radius",
       &Volume::radius,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "of a sphere, hemisphere, portion or cylinder; of a cone's base"}},
      {"height",
       &Volume::height,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "of a cylinder or cone, along its direction"}},
      {"radii",
       &Volume::radii,
       {.max = kFar,
        .is_above_min = true,
        .unit = "metres",
        .help = "half axes of an ellipsoid along x, y and z"}},
      {"size",
       &Volume::size,
       {.max = kFar, .is_above_min = true, .unit = "metres", .help = "edges of a box along x, y and z"}},
      {"angle_deg",
       &Volume::angle_deg,
       {.max = 180.0,
        .is_above_min = true,
        .unit = "degrees",
        .help = "sphere_portion: greatest angle from the direction; 90 is a half ball",
        .source = "XM12 Fig. 4, step 4C"}},
      {"direction",
       &Volume::direction,
       {.min = -kFar,
        .max = kFar,
        .help = "axis: from the base of a cylinder, cone or hemisphere, along the middle of a portion, "
                "up a revolution"}},
      {"points",
       &Volume::points,
       {.min = -kFar,
        .max = kFar,
        .unit = "metres",
        .help =
            "revolution: a sketch turned about the axis, as [radius, height], ...; flat disks close its ends",
        .source = "XM12 Fig. 14"}},
      {"file",
       &Volume::file,
       {.help = "mesh: a closed one, OBJ; revolution: the sketch as CSV, radius,height"}},
      {"voxel_size",
       &Volume::voxel_size,
       {.max = kFar,
        .unit = "metres",
        .help = "mesh: of the grid that tells inside from outside; 0 takes 1/128 of its length, finer if it "
                "is flat"}},
      {"scale",
       &Volume::scale,
       {.max = kFar,
        .is_above_min = true,
        .help = "first: stretched from the origin by these along x, y and z"}},
      {"rotate",
       &Volume::rotate,
       {.min = -360.0,
        .max = 360.0,
        .unit = "degrees",
        .help = "then: turned about the origin, about the x, then the y, then the z axis"}},
      {"translate",
       &Volume::translate,
       {.min = -kFar, .max = kFar, .unit = "metres", .help = "last: moved along x, y and z"}},
      {"parts",
       &Volume::parts,
       {.help =
            "of a union, an intersection, or a difference (the first without the others); any shapes again"}},
  });
  return table;
}

}  // namespace ramify
