#include "common/mesh/ply.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <ostream>
#include <vector>

namespace ramify {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as memory has it");

constexpr std::size_t kRowsAChunk = 4096;

/// Appends the bytes of a value to a row.
template <class T>
void put(std::vector<char>& bytes, const T& value) {
  const auto* first = reinterpret_cast<const char*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof(T));
}

/// Calls put_row(i, bytes) for every row and sends the bytes off in chunks.
template <class PutRow>
void write_rows(std::size_t count, std::ostream& out, PutRow put_row) {
  std::vector<char> bytes;
  for (std::size_t i = 0; i < count; ++i) {
    put_row(i, bytes);
    if ((i + 1) % kRowsAChunk == 0 || i + 1 == count) {
      out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      bytes.clear();
    }
  }
}

}  // namespace

void write_ply(const Mesh& mesh, const Provenance& provenance, std::ostream& out) {
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment ramify {}: engine {}, seed {}, steps {}\n",
      provenance.version, provenance.engine, provenance.seed, provenance.steps);
  out << fmt::format("element vertex {}\n", mesh.vertex_count());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"}) {
    out << fmt::format("property float {}\n", name);
  }
  out << fmt::format("property uint internode\nelement face {}\nproperty list uchar uint vertex_indices\n",
                     mesh.triangles.size());
  out << "end_header\n";
  write_rows(mesh.vertex_count(), out, [&](std::size_t i, std::vector<char>& bytes) {
    put(bytes, mesh.positions[i]);
    put(bytes, mesh.normals[i]);
    put(bytes, mesh.uvs[i]);
    put(bytes, mesh.internodes[i]);
  });
  write_rows(mesh.triangles.size(), out, [&](std::size_t i, std::vector<char>& bytes) {
    put(bytes, std::uint8_t{3});
    put(bytes, mesh.triangles[i]);
  });
}

}  // namespace ramify
