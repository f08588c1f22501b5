#include "common/mesh/mesher.h"

#include <algorithm>

#include "common/base/parallel.h"
#include "common/mesh/attribute_colors.h"
#include "common/mesh/cones.h"
#include "common/mesh/smooth.h"
#include "common/mesh/watertight.h"

namespace ramify {

const Table& MesherOptions::fields() {
  static const Table table = make_table<MesherOptions>({
      {"method",
       &MesherOptions::method,
       {.help =
            "smooth: one swept tube an axis; cones: a cone an internode, a sphere a node; watertight: one "
            "closed surface, forks blended, as 3D printers need it",
        .choices = {"smooth", "cones", "watertight"}}},
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
      {"lod",
       &MesherOptions::lod,
       {.max = 3,
        .help = "level of detail: 0 all of it, each next one a third of the triangles (watertight: about)"}},
      {"max_triangles",
       &MesherOptions::max_triangles,
       {.max = 2e9,
        .help = "of the wood: what is small goes until it has no more; leaves come on top; 0: no limit"}},
      {"color_by",
       &MesherOptions::color_by,
       {.help = "attribute of the tree that its vertices show as a colour (order, width, ...); empty: none"}},
      {"voxel_size",
       &MesherOptions::voxel_size,
       {.min = 0,
        .max = 10,
        .unit = "m",
        .help = "watertight: 0: a third of the thinnest twig, or what 50 million voxels allow"}},
      {"blend",
       &MesherOptions::blend,
       {.min = 0,
        .max = 2,
        .help = "watertight: how wide forks blend, in radii of the lateral; 0: not at all",
        .source = "Gourmel et al. 2013"}},
      {"adaptivity",
       &MesherOptions::adaptivity,
       {.min = 0,
        .max = 1,
        .help =
            "watertight: how far the surface may move to save triangles, in voxels; 0: as fine everywhere"}},
      {"thin_twigs",
       &MesherOptions::thin_twigs,
       {.help = "watertight: twigs thinner than two voxels: leave_out, or tubes: each closed, for itself",
        .choices = {"leave_out", "tubes"}}},
  });
  return table;
}

namespace {

Mesh wood(const Skeleton& skeleton, const MesherOptions& options, Mesh memory) {
  switch (options.method) {
    case MeshMethod::smooth:
      return smooth_mesh(skeleton, options, std::move(memory));
    case MeshMethod::cones:
      return cones_mesh(skeleton, options);
    case MeshMethod::watertight:
      return watertight_mesh(skeleton, options);
  }
  return {};
}

/// Gives each vertex the colour of the node it belongs to.
void color_vertices(Mesh& mesh, const std::vector<Color>& of_node) {
  std::vector<ColorBytes> bytes(of_node.size());
  std::transform(of_node.begin(), of_node.end(), bytes.begin(), color_bytes);
  mesh.colors.resize(mesh.vertex_count());
  parallel_for(mesh.vertex_count(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t vertex = begin; vertex < end; ++vertex) {
      mesh.colors[vertex] = bytes[mesh.internodes[vertex]];
    }
  });
  for (Material& material : mesh.materials) material.color = Vec3f(1.0f);
}

}  // namespace

Mesh build_mesh(const Skeleton& skeleton, const MesherOptions& options, Mesh memory) {
  if (options.color_by.empty()) return wood(skeleton, options, std::move(memory));
  const std::vector<Color> of_node = attribute_colors(skeleton, options.color_by, "mesher.color_by");
  Mesh mesh = wood(skeleton, options, std::move(memory));
  color_vertices(mesh, of_node);
  return mesh;
}

}  // namespace ramify
