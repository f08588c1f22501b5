#include "common/mesh/ply.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <ostream>

#include "common/base/ordered_output.h"

namespace ramify {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as memory has it");

/// Writes the value's bytes at `to` and moves it on.
template <class T>
void put(char*& to, const T& value) {
  std::memcpy(to, &value, sizeof(T));
  to += sizeof(T);
}

/// Lines that begin with "comment", since a config has several.
void write_comments(const Provenance& provenance, std::ostream& out) {
  out << fmt::format("comment ramify {}: engine {}, seed {}, steps {}; metres, +Y up. The config:\n",
                     provenance.version, provenance.engine, provenance.seed, provenance.steps);
  std::size_t begin = 0;
  while (begin < provenance.config.size()) {
    const std::size_t end = std::min(provenance.config.find('\n', begin), provenance.config.size());
    out << "comment   " << provenance.config.substr(begin, end - begin) << '\n';
    begin = end + 1;
  }
}

void write_header(const Mesh& mesh, const SolidPart& solid, const Provenance& provenance, std::ostream& out) {
  out << "ply\nformat binary_little_endian 1.0\n";
  write_comments(provenance, out);
  out << fmt::format("element vertex {}\n", solid.vertex_count);
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
    out << "property float " << name << '\n';
  if (!mesh.colors.empty()) {
    for (const char* name : {"red", "green", "blue", "alpha"}) out << "property uchar " << name << '\n';
  }
  out << fmt::format("property uint internode\nelement face {}\nproperty list uchar uint vertex_indices\n",
                     solid.triangle_count);
  out << "end_header\n";
}

}  // namespace

void write_ply(const Mesh& mesh, const Provenance& provenance, std::ostream& out) {
  const SolidPart solid = solid_part(mesh);
  write_header(mesh, solid, provenance, out);
  const std::size_t vertex_bytes = mesh.colors.empty() ? 36 : 40;
  write_rows(solid.vertex_count, vertex_bytes, out,
             [&](std::size_t begin, std::size_t end, std::string& text) {
               text.resize((end - begin) * vertex_bytes);
               char* to = text.data();
               for (std::size_t i = begin; i < end; ++i) {
                 put(to, mesh.positions[i]);
                 put(to, mesh.normals[i]);
                 put(to, mesh.uvs[i]);
                 if (!mesh.colors.empty()) put(to, mesh.colors[i]);
                 put(to, mesh.internodes[i]);
               }
             });
  constexpr std::size_t kFaceBytes = 13;
  write_rows(solid.triangle_count, kFaceBytes, out,
             [&](std::size_t begin, std::size_t end, std::string& text) {
               text.resize((end - begin) * kFaceBytes);
               char* to = text.data();
               for (std::size_t i = begin; i < end; ++i) {
                 put(to, std::uint8_t{3});
                 put(to, mesh.triangles[i]);
               }
             });
}

}  // namespace ramify
