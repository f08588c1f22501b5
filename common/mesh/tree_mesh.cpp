#include "common/mesh/tree_mesh.h"

#include "common/mesh/fork_bark.h"
#include "common/mesh/tangents.h"

namespace ramify {
namespace {

/// Of leaves like the model at these places, which differ in size.
double total_area(const LeafModel& model, const std::vector<Leaf>& leaves) {
  double area = 0.0;
  for (const Leaf& leaf : leaves) area += model.area * glm::dot(leaf.frame[1], leaf.frame[1]);
  return area;
}

void add_leaves(TreeMesh& tree, const Skeleton& skeleton, const Looks& looks, std::uint64_t seed) {
  const LeafModel model = leaf_model(looks.leaves);
  const std::vector<Leaf> leaves = place_leaves(skeleton, looks.leaves, seed, looks.mesher.lod);
  append_leaves(tree.mesh, model, leaves);
  tree.leaf_count = leaves.size();
  tree.leaf_area = total_area(model, leaves);
}

/// Coarse meshes have no triangles to spare.
bool has_fork_bark(const MesherOptions& options) {
  return options.lod == 0 && options.max_triangles == 0;
}

}  // namespace

TreeMesh make_tree_mesh(const Skeleton& skeleton, const Looks& looks, std::uint64_t seed, Mesh memory) {
  TreeMesh tree;
  tree.mesh = build_mesh(skeleton, looks.mesher, std::move(memory));
  const bool has_bark =
      looks.mesher.color_by.empty();  // else colours are to be read, and bark would change them
  if (has_bark) {
    dress_in_bark(tree.mesh, skeleton, looks.bark);
    compute_tangents(tree.mesh);
  }
  if (looks.leaves.is_on()) add_leaves(tree, skeleton, looks, seed);
  if (has_bark && has_fork_bark(looks.mesher)) {
    append_fork_bark(tree.mesh, skeleton, bark_repeats(skeleton, looks.bark.tile_width), looks.mesher);
    append_overlay_tangents(tree.mesh);
  }
  return tree;
}

}  // namespace ramify
