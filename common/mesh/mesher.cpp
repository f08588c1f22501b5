#include "common/mesh/mesher.h"

#include "common/mesh/cones.h"
#include "common/mesh/smooth.h"

namespace ramify {

const Table& MesherOptions::fields() {
  static const Table table = make_table<MesherOptions>({
      {"method",
       &MesherOptions::method,
       {.help = "smooth: one swept tube an axis; cones: a cone an internode, a sphere a node",
        .choices = {"smooth", "cones"}}},
      {"sides_min", &MesherOptions::sides_min, {.min = 3, .max = 64, .help = "sides of the thinnest twigs"}},
      {"sides_max", &MesherOptions::sides_max, {.min = 3, .max = 64, .help = "sides of the thickest axis"}},
  });
  return table;
}

Mesh build_mesh(const Skeleton& skeleton, const MesherOptions& options) {
  switch (options.method) {
    case MeshMethod::smooth:
      return smooth_mesh(skeleton, options);
    case MeshMethod::cones:
      return cones_mesh(skeleton, options);
  }
  return {};
}

}  // namespace ramify
