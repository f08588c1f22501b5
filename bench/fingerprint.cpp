#include "bench/fingerprint.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace ramify::bench {
namespace {

constexpr std::uint64_t kFnvOffset = 0xcbf29ce484222325;
constexpr std::uint64_t kFnvPrime = 0x100000001b3;

/// FNV-1a over 8 bytes at a time.
template <class Values>
void add_to(std::uint64_t& hash, const Values& values) {
  const std::size_t bytes = values.size() * sizeof(values[0]);
  const auto* data = reinterpret_cast<const unsigned char*>(values.data());
  for (std::size_t i = 0; i < bytes; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + i, std::min(sizeof word, bytes - i));
    hash = (hash ^ word) * kFnvPrime;
  }
}

}  // namespace

std::uint64_t fingerprint(const Skeleton& skeleton) {
  std::uint64_t hash = kFnvOffset;
  add_to(hash, skeleton.position);
  add_to(hash, skeleton.parent);
  add_to(hash, skeleton.diameter);
  return hash;
}

std::uint64_t fingerprint(const Mesh& mesh) {
  std::uint64_t hash = kFnvOffset;
  add_to(hash, mesh.positions);
  add_to(hash, mesh.normals);
  add_to(hash, mesh.uvs);
  add_to(hash, mesh.internodes);
  add_to(hash, mesh.triangles);
  return hash;
}

}  // namespace ramify::bench
