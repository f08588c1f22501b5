#include "common/format/pov_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <sstream>

namespace ramify {
namespace {

// Vertical opening angle of the camera, degrees.
constexpr double kOpening = 35.0;

// What stands around the tree in the picture, of its radius.
constexpr double kMargin = 1.08;

constexpr std::size_t kChunk = 1 << 16;

std::string vector_text(const Vec3& v) {
  return fmt::format("<{}, {}, {}>", v.x, v.y, v.z);
}

void write_comments(const Provenance& provenance, std::ostream& out) {
  out << fmt::format("// ramify {}: engine {}, seed {}, steps {}; metres, +Y up. Render with\n",
                     provenance.version, provenance.engine, provenance.seed, provenance.steps);
  out << "//   povray +Ifile.pov +W800 +H800 +A\n// The config:\n";
  std::istringstream lines(provenance.config);
  for (std::string line; std::getline(lines, line);) out << "//   " << line << "\n";
}

Box bounds_of(const Skeleton& skeleton) {
  Box box;
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    box.include(skeleton.position[node] - 0.5 * skeleton.diameter[node]);
    box.include(skeleton.position[node] + 0.5 * skeleton.diameter[node]);
  }
  return box;
}

/// Camera, lights, sky and ground for what stands in `box`.
void write_surroundings(const Box& box, std::ostream& out) {
  const double radius = std::max(0.5 * glm::length(box.size()), 1e-3);
  const double away = kMargin * radius / std::sin(radians(0.5 * kOpening));
  const Vec3 toward = glm::normalize(Vec3(0.35, 0.12, 1.0));
  out << fmt::format(
      "\n#version 3.7;\nglobal_settings {{ assumed_gamma 1.0 }}\n"
      "camera {{\n  location {}\n  look_at {}\n"
      "  right -x*image_width/image_height // right-handed\n  angle {}*image_width/image_height\n}}\n",
      vector_text(box.center() + toward * away), vector_text(box.center()), kOpening);
  out << fmt::format("light_source {{ {} rgb <1.0, 0.96, 0.88> }}\n",
                     vector_text(box.center() + Vec3(3, 5, 4) * radius));
  out << fmt::format("light_source {{ {} rgb <0.30, 0.33, 0.40> shadowless }}\n",
                     vector_text(box.center() + Vec3(-5, 2, 1) * radius));
  out << "sky_sphere { pigment { gradient y color_map { [0 rgb <0.85, 0.90, 0.95>] [1 rgb <0.35, 0.55, "
         "0.85>] "
         "} } }\n";
  out << fmt::format("plane {{ y, {} pigment {{ rgb <0.23, 0.27, 0.13> }} finish {{ diffuse 0.8 }} }}\n",
                     box.low.y);
}

void write_tree(const Skeleton& skeleton, std::ostream& out) {
  fmt::memory_buffer text;
  const auto add = [&]<class... Args>(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
    if (text.size() < kChunk) return;
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  };
  add("\nunion {{\n");
  for (std::size_t node = 0; node < skeleton.node_count(); ++node) {
    const Vec3& end = skeleton.position[node];
    const double radius = 0.5 * skeleton.diameter[node];
    if (radius > 0.0) add("sphere {{ <{}, {}, {}>, {} }}\n", end.x, end.y, end.z, radius);
    if (skeleton.is_root(node) || skeleton.length(node) == 0.0) continue;
    const Vec3& start = skeleton.position[skeleton.parent[node]];
    const double base = skeleton.start_radius(node);
    if (base + radius == 0.0) continue;
    add("cone {{ <{}, {}, {}>, {}, <{}, {}, {}>, {} }}\n", start.x, start.y, start.z, base, end.x, end.y,
        end.z, radius);
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace

void write_pov_scene(const Skeleton& skeleton, const Provenance& provenance, std::ostream& out) {
  write_comments(provenance, out);
  write_surroundings(bounds_of(skeleton), out);
  write_tree(skeleton, out);
  out << "texture {\n  pigment { bozo scale 0.05 color_map { [0 rgb <0.30, 0.22, 0.15>] [1 rgb <0.18, 0.13, "
         "0.09>] } }\n  finish { diffuse 0.9 specular 0.05 }\n}\n}\n";
}

}  // namespace ramify
