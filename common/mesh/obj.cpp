#include "common/mesh/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <ostream>
#include <span>

#include "common/base/color.h"
#include "common/base/decimal.h"
#include "common/base/ordered_output.h"

namespace ramify {
namespace {

void write_comments(const Provenance& provenance, std::ostream& out) {
  out << fmt::format("# ramify {}: engine {}, seed {}, steps {}; metres, +Y up. The config:\n",
                     provenance.version, provenance.engine, provenance.seed, provenance.steps);
  std::size_t begin = 0;
  while (begin < provenance.config.size()) {
    const std::size_t end = std::min(provenance.config.find('\n', begin), provenance.config.size());
    out << "#   " << provenance.config.substr(begin, end - begin) << '\n';
    begin = end + 1;
  }
}

/// Writes rows that take at most `row_bytes` each; put(i, to) writes row i at `to` and returns its end.
template <class Put>
void write_lines(std::size_t count, std::size_t row_bytes, std::ostream& out, Put put) {
  write_rows(count, row_bytes, out, [&](std::size_t begin, std::size_t end, std::string& text) {
    text.resize((end - begin) * row_bytes);
    char* to = text.data();
    for (std::size_t i = begin; i < end; ++i) to = put(i, to);
    text.resize(static_cast<std::size_t>(to - text.data()));
  });
}

template <int Places, class Vector>
void write_vectors(std::span<Vector> values, std::string_view key, std::ostream& out) {
  const std::size_t row_bytes = key.size() + 1 + Vector::length() * (decimal::kMaxLength + 1);
  write_lines(values.size(), row_bytes, out, [&](std::size_t i, char* to) {
    to = std::copy(key.begin(), key.end(), to);
    for (int axis = 0; axis < Vector::length(); ++axis) {
      *to++ = ' ';
      to = append_decimal<Places>(to, values[i][axis]);
    }
    *to++ = '\n';
    return to;
  });
}

/// " 12/12/12": position, texture coordinate and normal have one index, counted from 1.
char* put_corner(char* to, std::uint32_t vertex) {
  *to++ = ' ';
  const char* digits = to;
  to = append_whole(to, std::uint64_t{vertex} + 1);
  const auto length = static_cast<std::size_t>(to - digits);
  for (int again = 0; again < 2; ++again) {
    *to++ = '/';
    std::memcpy(to, digits, length);
    to += length;
  }
  return to;
}

void write_faces(const Mesh& mesh, const MaterialRange& range, std::ostream& out) {
  constexpr std::size_t kLongest = 1 + 3 * (1 + 3 * 10 + 2) + 1;
  write_lines(range.triangle_count, kLongest, out, [&](std::size_t i, char* to) {
    *to++ = 'f';
    for (const std::uint32_t vertex : mesh.triangles[range.first_triangle + i]) to = put_corner(to, vertex);
    *to++ = '\n';
    return to;
  });
}

std::string image_name(const std::string& stem, const Material& material) {
  return fmt::format("{}-{}.png", stem, material.name);
}

std::string normal_map_name(const std::string& stem, const Material& material) {
  return fmt::format("{}-{}-normal.png", stem, material.name);
}

/// Linear: the material's colour times the mean of its vertices'.
Vec3f mean_color(const Mesh& mesh, std::size_t material) {
  Vec3 sum(0.0);
  std::size_t count = 0;
  for (const MaterialRange& range : mesh.ranges) {
    if (range.material != material || mesh.colors.empty()) continue;
    for (std::size_t i = range.first_triangle; i < range.first_triangle + range.triangle_count; ++i) {
      const auto& color = mesh.colors[mesh.triangles[i][0]];
      for (int axis = 0; axis < 3; ++axis) {
        sum[axis] += linear_of(static_cast<float>(color[static_cast<std::size_t>(axis)]) / 255.0f);
      }
    }
    count += range.triangle_count;
  }
  const Vec3f& own = mesh.materials[material].color;
  return count == 0 ? own : own * Vec3f(sum / static_cast<double>(count));
}

Image tinted(const Image& image, const Vec3f& color) {
  std::array<std::array<std::uint8_t, 256>, 3> tints;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const float light = color[static_cast<int>(axis)] * linear_of(static_cast<float>(byte) / 255.0f);
      tints[axis][byte] = static_cast<std::uint8_t>(std::lround(255.0f * encoded_of(std::min(light, 1.0f))));
    }
  }
  Image result = image;
  for (std::size_t i = 0; i < result.rgba.size(); i += 4) {
    for (std::size_t axis = 0; axis < 3; ++axis) result.rgba[i + axis] = tints[axis][image.rgba[i + axis]];
  }
  return result;
}

}  // namespace

void write_obj(const Mesh& mesh, const Provenance& provenance, const std::string& material_library,
               std::ostream& out) {
  write_comments(provenance, out);
  out << fmt::format("mtllib {}\no tree\n", material_library);
  const std::size_t count = solid_part(mesh).vertex_count;
  write_vectors<6>(std::span(mesh.positions).first(count), "v", out);
  write_vectors<6>(std::span(mesh.uvs).first(count), "vt", out);
  write_vectors<4>(std::span(mesh.normals).first(count), "vn", out);
  for (const MaterialRange& range : mesh.ranges) {
    if (mesh.material(range).is_overlay) continue;
    out << fmt::format("usemtl {}\n", mesh.material(range).name);
    write_faces(mesh, range, out);
  }
}

std::vector<ImageFile> image_files(const Mesh& mesh, const std::string& stem) {
  std::vector<ImageFile> files;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const Material& material = mesh.materials[i];
    if (material.is_overlay) continue;
    if (!material.image.is_empty()) {
      files.push_back({image_name(stem, material), tinted(material.image, mean_color(mesh, i))});
    }
    if (!material.normal_map.is_empty()) {
      files.push_back({normal_map_name(stem, material), material.normal_map});
    }
  }
  return files;
}

void write_mtl(const Mesh& mesh, const std::string& stem, std::ostream& out) {
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    const Material& material = mesh.materials[i];
    if (material.is_overlay) continue;
    const Vec3f color = material.image.is_empty() ? mean_color(mesh, i) : Vec3f(1.0f);
    out << fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nKs 0 0 0\nillum 1\n", material.name, color.r,
                       color.g, color.b);
    if (!material.image.is_empty()) {
      const std::string name = image_name(stem, material);
      out << fmt::format("map_Kd {}\n", name);
      if (material.is_cutout) out << fmt::format("map_d {}\n", name);
    }
    if (!material.normal_map.is_empty()) out << fmt::format("norm {}\n", normal_map_name(stem, material));
  }
}

}  // namespace ramify
