#include "common/mesh/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "common/base/errors.h"

namespace ramify {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is written as memory has it");

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kTrianglesAChunk = 4096;

/// Normal, corners and two bytes without meaning.
void put_triangle(const Mesh& mesh, std::size_t index, char* bytes) {
  const auto& [a, b, c] = mesh.triangles[index];
  const std::array<Vec3f, 3> corners = {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
  const Vec3f across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const float length = glm::length(across);
  const Vec3f normal = length > 0.0f ? across / length : Vec3f(0.0f);
  std::memcpy(bytes, &normal, 12);
  std::memcpy(bytes + 12, corners.data(), 36);
  std::memset(bytes + 48, 0, 2);
}

}  // namespace

void write_stl(const Mesh& mesh, const Provenance& provenance, std::ostream& out) {
  const std::size_t count = solid_part(mesh).triangle_count;
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    throw RunError(fmt::format("STL: {} triangles are more than the format can count", count));
  }
  // Readers take a file that begins with "solid" for text.
  std::string header = fmt::format("ramify {}, metres, +Y up", provenance.version);
  header.resize(kHeaderBytes, ' ');
  out.write(header.data(), kHeaderBytes);
  const auto written = static_cast<std::uint32_t>(count);
  out.write(reinterpret_cast<const char*>(&written), 4);
  std::vector<char> bytes(kTrianglesAChunk * kTriangleBytes);
  for (std::size_t first = 0; first < count; first += kTrianglesAChunk) {
    const std::size_t chunk = std::min(kTrianglesAChunk, count - first);
    for (std::size_t i = 0; i < chunk; ++i) put_triangle(mesh, first + i, bytes.data() + i * kTriangleBytes);
    out.write(bytes.data(), static_cast<std::streamsize>(chunk * kTriangleBytes));
  }
}

}  // namespace ramify
