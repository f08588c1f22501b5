// Leaves: shapes, places, and what of a file becomes of them.

#include <algorithm>
#include <fstream>

#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "common/mesh/leaves.h"
#include "common/mesh/tree_mesh.h"
#include "tests/catch.h"
#include "tests/common/trees.h"
#include "tests/folder.h"

using namespace ramify;
using namespace ramify::test;

namespace {

constexpr LeafShape kShapes[] = {LeafShape::ovate, LeafShape::lanceolate, LeafShape::lobed,
                                 LeafShape::needles};

LeafOptions leafy(LeafShape shape = LeafShape::ovate) {
  LeafOptions options;
  options.shape = shape;
  options.max_width = 100.0;
  return options;
}

/// Of the triangles, one side.
double area_of(const Mesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 * glm::length(glm::cross(Vec3(mesh.positions[b] - mesh.positions[a]),
                                         Vec3(mesh.positions[c] - mesh.positions[a])));
  }
  return area;
}

bool is_same(const Leaf& a, const Leaf& b) {
  return a.base == b.base && a.frame == b.frame && a.internode == b.internode && a.tint == b.tint;
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::string model_error(const std::string& path) {
  LeafOptions options;
  options.mesh = path;
  try {
    check_leaves(options);
  } catch (const ConfigError& error) {
    CHECK(error.key() == "mesh");
    return error.problem();
  }
  return "no error";
}

}  // namespace

TEST_CASE(
    "leaves: a blade's area is that of its outline, a little more where triangles are folded and bent") {
  for (const LeafShape shape : {LeafShape::ovate, LeafShape::lanceolate, LeafShape::lobed}) {
    double outline = 0.0;
    constexpr int kSlices = 20000;
    for (int i = 0; i < kSlices; ++i) outline += 2.0 * half_width(shape, (i + 0.5) / kSlices) / kSlices;
    const LeafModel leaf = make_leaf(shape, LeafForm::geometry);
    CHECK(leaf.area == Approx(outline).epsilon(1e-3));
    CHECK(area_of(leaf.mesh) > leaf.area);
    CHECK(area_of(leaf.mesh) < 1.15 * leaf.area);
    CHECK(make_leaf(shape, LeafForm::card).area == leaf.area);
  }
  const LeafModel tuft = make_leaf(LeafShape::needles, LeafForm::geometry);
  CHECK(area_of(tuft.mesh) == Approx(tuft.area).epsilon(1e-4));
}

TEST_CASE("leaves: every shape and form is a sound mesh within its picture") {
  for (const LeafShape shape : kShapes) {
    for (const LeafForm form : {LeafForm::geometry, LeafForm::card}) {
      const Mesh mesh = make_leaf(shape, form).mesh;
      REQUIRE(mesh.ranges.size() == 1);
      CHECK(mesh.ranges[0].triangle_count == mesh.triangles.size());
      CHECK(mesh.materials[0].name == "leaf");
      CHECK(mesh.materials[0].is_two_sided);
      CHECK(mesh.materials[0].is_cutout);
      for (const auto& [a, b, c] : mesh.triangles) {
        REQUIRE(std::max({a, b, c}) < mesh.vertex_count());
        const Vec3f u = mesh.positions[b] - mesh.positions[a];
        const Vec3f v = mesh.positions[c] - mesh.positions[a];
        const Vec3f normal = glm::cross(u, v);
        CHECK(glm::length(normal) > 1e-7f);
        // Wound so that the side the normals look from is the front.
        CHECK(glm::dot(normal, mesh.normals[a]) > 0.0f);
      }
      for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        CHECK(glm::length(mesh.normals[i]) == Approx(1.0f).margin(1e-5));
        for (int axis = 0; axis < 2; ++axis) {
          CHECK(mesh.uvs[i][axis] >= 0.0f);
          CHECK(mesh.uvs[i][axis] <= 1.0f);
        }
      }
    }
  }
}

TEST_CASE("leaves: a card's picture covers what the outline does") {
  for (const LeafShape shape : {LeafShape::ovate, LeafShape::lanceolate, LeafShape::lobed}) {
    const Mesh card = make_leaf(shape, LeafForm::card).mesh;
    const Image& image = card.materials[0].image;
    double covered = 0.0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) covered += image.rgba[i] / 255.0;
    const double width = card.positions[2].x - card.positions[0].x;
    const double pixels = static_cast<double>(image.width) * image.height;
    CHECK(covered / pixels * width == Approx(make_leaf(shape, LeafForm::card).area).epsilon(0.05));
  }
}

TEST_CASE("leaves: a pole has one group each spacing and one at its tip") {
  LeafOptions options = leafy();
  options.spacing = 0.25;
  for (const int per_node : {1, 2, 3}) {
    options.per_node = per_node;
    CHECK(place_leaves(pole(4), options, 1).size() == static_cast<std::size_t>((16 + 1) * per_node));
  }
}

TEST_CASE("leaves: they stand only on wood that is thin, young and lateral enough") {
  const Skeleton tree = random_tree(3, 400);
  std::uint32_t last = 0;
  for (const std::uint32_t step : tree.birth_step) last = std::max(last, step);
  std::vector<double> widths = tree.diameter;
  std::sort(widths.begin(), widths.end());
  LeafOptions options = leafy();
  options.max_width = widths[widths.size() / 2];
  options.min_order = 1;
  options.max_age = 2;
  const std::vector<Leaf> leaves = place_leaves(tree, options, 1);
  REQUIRE(!leaves.empty());
  for (const Leaf& leaf : leaves) {
    CHECK(tree.diameter[leaf.internode] <= options.max_width);
    CHECK(tree.order[leaf.internode] >= 1);
    CHECK(last - tree.birth_step[leaf.internode] < 2);
  }
  options.max_age = 0;
  const std::size_t of_any_age = place_leaves(tree, options, 1).size();
  CHECK(of_any_age > leaves.size());
  options.min_order = 0;
  options.max_width = 100.0;
  CHECK(place_leaves(tree, options, 1).size() > of_any_age);
}

TEST_CASE(
    "leaves: without droop and jitter they make the angle asked for, half of them on each side if "
    "distichous") {
  LeafOptions options = leafy();
  options.droop = 0.0;
  options.divergence_deg = 180.0;
  options.angle_deg = 60.0;
  options.spacing = 0.05;
  const std::vector<Leaf> leaves = place_leaves(pole(3), options, 5);
  Vec3 sum(0.0);
  double mean = 0.0;
  for (const Leaf& leaf : leaves) {
    const Vec3 direction = glm::normalize(leaf.frame[1]);
    mean += degrees(std::acos(direction.y)) / static_cast<double>(leaves.size());
    sum += direction - kUp * direction.y;
  }
  CHECK(mean == Approx(60.0).margin(3.0));
  CHECK(glm::length(sum) < 0.05 * static_cast<double>(leaves.size()));
}

TEST_CASE("leaves: droop lowers them and facing_up turns their upper sides up") {
  LeafOptions options = leafy();
  options.spacing = 0.05;
  const auto mean_height = [&](int column) {
    double sum = 0.0;
    const std::vector<Leaf> leaves = place_leaves(random_tree(2, 100), options, 1);
    for (const Leaf& leaf : leaves) sum += glm::normalize(leaf.frame[column]).y;
    return sum / static_cast<double>(leaves.size());
  };
  options.droop = 0.0;
  options.facing_up = 0.0;
  const double direction = mean_height(1);
  const double upper = mean_height(2);
  options.facing_up = 1.0;
  CHECK(mean_height(2) > upper + 0.3);
  options.droop = 1.0;
  CHECK(mean_height(1) < direction - 0.3);
}

TEST_CASE("leaves: frames are right-handed and as long as the leaf") {
  LeafOptions options = leafy();
  options.length = 0.2;
  options.length_jitter = 0.5;
  for (const Leaf& leaf : place_leaves(random_tree(4, 100), options, 1)) {
    const double length = glm::length(leaf.frame[1]);
    CHECK(length >= 0.1);
    CHECK(length <= 0.3);
    CHECK(glm::determinant(leaf.frame) == Approx(length * length * length));
  }
}

TEST_CASE("leaves: the same seed gives the same ones for any number of threads, another seed others") {
  const Skeleton tree = random_tree(5, 3000);
  const std::vector<Leaf> leaves = place_leaves(tree, leafy(), 7);
  const ThreadLimit limit(1);
  const std::vector<Leaf> again = place_leaves(tree, leafy(), 7);
  REQUIRE(leaves.size() == again.size());
  CHECK(std::equal(leaves.begin(), leaves.end(), again.begin(), is_same));
  const std::vector<Leaf> others = place_leaves(tree, leafy(), 8);
  CHECK(!std::equal(leaves.begin(), leaves.begin() + 10, others.begin(), is_same));
}

TEST_CASE("leaves: a coarser level has fewer and larger ones, of about the same area") {
  LeafOptions options = leafy();
  options.spacing = 0.01;
  const Skeleton tree = pole(20);
  const std::vector<Leaf> fine = place_leaves(tree, options, 1, 0);
  const std::vector<Leaf> coarse = place_leaves(tree, options, 1, 2);
  CHECK(static_cast<double>(fine.size()) / static_cast<double>(coarse.size()) == Approx(4.0).epsilon(0.02));
  const auto area = [](const std::vector<Leaf>& leaves) {
    double sum = 0.0;
    for (const Leaf& leaf : leaves) sum += glm::dot(leaf.frame[1], leaf.frame[1]);
    return sum;
  };
  CHECK(area(coarse) == Approx(area(fine)).epsilon(0.05));

  Looks looks;
  looks.leaves = options;
  looks.mesher.lod = 2;
  CHECK(make_tree_mesh(tree, looks, 1).leaf_count == coarse.size());
}

TEST_CASE("leaves: a tree's mesh tells of each leaf vertex which internode bears it, and reports the area") {
  Looks looks;
  looks.leaves = leafy(LeafShape::lobed);
  const Skeleton skeleton = random_tree(6, 200);
  const TreeMesh tree = make_tree_mesh(skeleton, looks, 1);
  const Mesh& mesh = tree.mesh;
  REQUIRE(mesh.ranges.size() == 3);
  CHECK(mesh.materials[mesh.ranges[1].material].name == "leaf");
  const std::size_t of_one = make_leaf(LeafShape::lobed, LeafForm::card).mesh.triangles.size();
  CHECK(mesh.ranges[1].triangle_count == tree.leaf_count * of_one);
  CHECK(mesh.ranges[0].triangle_count + mesh.ranges[1].triangle_count == solid_part(mesh).triangle_count);
  CHECK(mesh.internodes.size() == mesh.vertex_count());
  CHECK(mesh.colors.size() == mesh.vertex_count());
  const std::vector<Leaf> leaves = place_leaves(skeleton, looks.leaves, 1);
  const auto first_of_last = mesh.triangles[mesh.ranges[1].first_triangle + (leaves.size() - 1) * of_one][0];
  CHECK(mesh.internodes[first_of_last] == leaves.back().internode);
  const double mean = tree.leaf_area / static_cast<double>(tree.leaf_count);
  CHECK(mean == Approx(0.09 * 0.09 * make_leaf(LeafShape::lobed, LeafForm::card).area).epsilon(0.1));
}

TEST_CASE("leaves: an OBJ of one's own stands for each leaf, scaled to its length, with its materials") {
  const Folder folder;
  write_text(folder.file("leaf.mtl"), "newmtl stalk\nKd 0.5 0.25 0.125\nnewmtl blade\nKd 0 1 0\n");
  write_text(
      folder.file("leaf.obj"),
      "mtllib leaf.mtl\nv -1 0 0\nv 1 0 0\nv 0 4 0\nv 0 2 1\nusemtl stalk\nf 1 2 3\nusemtl blade\nf 1 2 4\n");
  Looks looks;
  looks.leaves = leafy(LeafShape::none);
  looks.leaves.mesh = folder.file("leaf.obj");
  const LeafModel model = leaf_model(looks.leaves);
  CHECK(model.mesh.positions[2].y == 1.0f);
  CHECK(model.mesh.materials[0].color == Vec3f(0.5f, 0.25f, 0.125f));
  CHECK(model.area == Approx(0.5 * (2.0 * 4.0 + 2.0 * std::sqrt(5.0)) / 16.0));
  const TreeMesh tree = make_tree_mesh(random_tree(1, 50), looks, 1);
  REQUIRE(tree.mesh.ranges.size() == 4);
  CHECK(tree.mesh.materials[1].name == "leaf");
  CHECK(tree.mesh.materials[2].name == "leaf-2");
  CHECK(tree.mesh.ranges[1].triangle_count == tree.leaf_count);
  CHECK(tree.mesh.ranges[2].triangle_count == tree.leaf_count);
}

TEST_CASE("leaves: a mesh that cannot be used is told in a line") {
  const Folder folder;
  const auto error_of = [&](const std::string& name, const std::string& text) {
    write_text(folder.file(name), text);
    return model_error(folder.file(name));
  };
  CHECK(model_error(folder.file("none.obj")) ==
        folder.file("none.obj") + ": cannot read: No such file or directory");
  CHECK(error_of("a.stl", "solid") == folder.file("a.stl") + ": unknown ending '.stl' (.glb .gltf .obj)");
  CHECK(error_of("b.obj", "v 0 0 0\n") == folder.file("b.obj") + ": has no triangles");
  CHECK(error_of("c.obj", "v 0 0 0\nv 1 0 0\nv 0 -1 0\nf 1 2 3\n") ==
        folder.file("c.obj") + ": reaches up to y = 0 (a leaf grows from 0 along +Y)");
  CHECK(error_of("d.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n").rfind(folder.file("d.obj") + ": ", 0) == 0);
  CHECK(error_of("e.obj", "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n") ==
        folder.file("gone.mtl") + ": cannot read: No such file or directory");
  CHECK(error_of("f.obj", "v 0 nan 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find('\n') == std::string::npos);
  CHECK(error_of("g.glb", "glTF garbage").rfind(folder.file("g.glb") + ": no glTF: ", 0) == 0);
}
