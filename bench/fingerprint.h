// Whether two trees are the same, bit by bit, when they are made in different processes.
#pragma once

#include <cstdint>

#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify::bench {

/// Of positions, parents and diameters, to the last bit.
std::uint64_t fingerprint(const Skeleton& skeleton);

/// Of all that its vertices and triangles have, to the last bit.
std::uint64_t fingerprint(const Mesh& mesh);

}  // namespace ramify::bench
