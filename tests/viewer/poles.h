// The simplest tree that a picture can be measured by.
#pragma once

#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify::test {

/// A straight trunk on the origin, of equal width all along; metres.
Skeleton pole_of(int internodes, double height, double diameter);

/// Open cylinders around the internodes: enough to draw. The renderer is tested without the mesher.
Mesh tube_mesh(const Skeleton& skeleton);

}  // namespace ramify::test
