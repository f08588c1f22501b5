// Bark over forks: where a lateral leaves its bearer, the bearer's bark goes on over it and fades out, so
// that no line shows where two barks meet.
#pragma once

#include <span>

#include "common/mesh/mesher.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// Its material's name.
constexpr const char* kForkBark = "bark over forks";

/// Appends to a mesh that is dressed in bark a last range, an overlay, of the triangles at the feet of
/// laterals: just above them, in their bearer's texture, with colours whose alpha goes to 0 where the
/// lateral's own bark is to be seen. Where the lateral has no vertices near enough for that, as on a cone,
/// the overlay has more. Thin laterals have none. `repeats`: of bark_repeats(). `options`: by which the mesh
/// was made. Does nothing without an image on the bark. O(n), and O(m log m) for the m triangles about forks;
/// on all threads, the same for any number of them.
void append_fork_bark(Mesh& mesh, const Skeleton& skeleton, std::span<const float> repeats,
                      const MesherOptions& options);

}  // namespace ramify
