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
      {"centre_line",
       &MesherOptions::centre_line,
       {.help = "smooth: polyline: straight between nodes, bends rounded; catmull-rom: curved through them",
        .source = "Catmull & Rom 1974, centripetal",
        .choices = {"polyline", "catmull-rom"}}},
      {"sides_min", &MesherOptions::sides_min, {.min = 3, .max = 64, .help = "sides of the thinnest twigs"}},
      {"sides_max", &MesherOptions::sides_max, {.min = 3, .max = 64, .help = "sides of the thickest axis"}},
      {"root_flare",
       &MesherOptions::root_flare,
       {.max = 3,
        .help = "smooth: how much wider a trunk without roots is at the ground, of its radius; 0: no flare"}},
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
