#include "viewer/marks.h"

#include <algorithm>

#include "tests/catch.h"
#include "tests/engines.h"
#include "viewer/nearness.h"

using namespace ramify;

namespace {

Product product_of(const std::string& preset) {
  Product product;
  product.job = std::make_shared<const Job>(load_job(test::both_engines(), preset));
  RunContext context;
  context.layers = product.job->engine->layers(product.job->parameters.get());
  product.run = std::make_shared<const RunResult>(product.job->run(context));
  return product;
}

}  // namespace

TEST_CASE("marks: every layer of both engines has some, a slice fewer than the whole field") {
  for (const std::string preset : {"s4-fig6", "space-oak", "xm12-fig5", "x18-d5-a30"}) {
    const Product product = product_of(preset);
    for (const std::string& name : product.job->engine->layers(product.job->parameters.get())) {
      INFO(preset << ": " << name);
      const Marks marks = marks_of(product, name, false);
      CHECK(marks.starts.size() > 0);
      CHECK(marks.starts.size() <= 60'000);
      CHECK(marks.size > 0.0);
      CHECK(marks.ends.size() == marks.starts.size());
      CHECK(marks.colors.size() == marks.starts.size());
    }
  }
  const Product product = product_of("s4-fig6");
  CHECK(marks_of(product, "shadow", true).starts.size() < marks_of(product, "shadow", false).starts.size());
  CHECK(marks_of(product, "no such layer", false).starts.empty());
}

TEST_CASE("marks: markers near the tree stand out, those far away are veils") {
  Product product = product_of("space-oak");
  product.skeleton = product.run->skeleton;
  const Marks marks = marks_of(product, "markers", false);
  std::size_t strong = 0;
  std::size_t faint = 0;
  for (const ColorBytes& color : marks.colors) {
    strong += color[3] > 150 ? 1 : 0;
    faint += color[3] < 40 ? 1 : 0;
  }
  CHECK(strong > marks.colors.size() / 20);
  CHECK(faint > marks.colors.size() / 50);
}

TEST_CASE("nearness: 1 at a node, less with the distance, 0 beyond the reach") {
  const std::vector<Vec3> nodes = {{1.0, 2.0, 3.0}, {-4.0, 0.0, 0.0}};
  const std::vector<Vec3> points = {nodes[0], nodes[0] + Vec3(0.5, 0.0, 0.0), nodes[1] + Vec3(0.0, 0.0, -0.9),
                                    nodes[0] + Vec3(0.0, 1.6, 0.0), Vec3(1e6)};
  const std::vector<float> near = nearness(points, nodes, 1.0);
  CHECK(near[0] == 1.0f);
  CHECK(near[1] == Approx(0.5).margin(0.26));
  CHECK(near[2] == Approx(0.1).margin(0.26));
  CHECK(near[3] == 0.0f);
  CHECK(near[4] == 0.0f);
  CHECK(nearness(points, {}, 1.0) == std::vector<float>(points.size(), 0.0f));
}

TEST_CASE("veils: one a volume that the run uses, its surface where the volume is") {
  const std::vector<Veil> veils = veils_of(product_of("xm12-fig5"));
  REQUIRE(veils.size() > 1);
  for (const Veil& veil : veils) CHECK_FALSE(veil.surface.triangles.empty());
  CHECK(veils_of(product_of("s4-fig6")).empty());
}

TEST_CASE("overlay: volumes and obstacles can be shown where a run uses some") {
  const auto has = [](const std::string& preset, const char* name) {
    const std::vector<std::string> names = overlay_names(load_job(test::both_engines(), preset));
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  CHECK(has("xm12-fig5", kVolumes));
  CHECK_FALSE(has("xm12-fig5", kObstacles));
  CHECK(has("xm12-obstacle", kObstacles));
  CHECK_FALSE(has("clear-trunk", kObstacles));  // a forest that shades alone would hide the tree
  CHECK(has("beside-wall", kObstacles));
  CHECK_FALSE(has("beside-wall", kVolumes));  // its markers are not used
  CHECK(has("space-oak", kVolumes));
  CHECK(has("pruned-hedge", kVolumes));
}
