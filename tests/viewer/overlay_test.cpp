#include "viewer/overlay.h"

#include <algorithm>

#include "growth/engine.h"
#include "pathplan/engine.h"
#include "tests/catch.h"
#include "viewer/volume_outline.h"

using namespace ramify;

namespace {

const EngineRegistry& registry() {
  static const EngineRegistry all = [] {
    EngineRegistry engines;
    growth::register_engine(engines);
    pathplan::register_engine(engines);
    return engines;
  }();
  return all;
}

Product product_of(const std::string& preset) {
  Product product;
  product.job = std::make_shared<const Job>(load_job(registry(), preset));
  RunContext context;
  context.layers = product.job->engine->layers(product.job->parameters.get());
  product.run = std::make_shared<const RunResult>(product.job->run(context));
  return product;
}

}  // namespace

TEST_CASE("overlay: every layer of both engines has marks, a slice fewer than the whole field") {
  for (const std::string preset : {"s4-fig6", "space-oak", "xm12-fig5", "x18-d5-a30"}) {
    const Product product = product_of(preset);
    for (const std::string& name : overlay_names(*product.job)) {
      INFO(preset << ": " << name);
      const Marks marks = marks_of(product, name, false);
      CHECK(marks.starts.size() > 0);
      CHECK(marks.starts.size() <= 60'000);
      CHECK(marks.ends.size() == marks.starts.size());
      CHECK(marks.colors.size() == marks.starts.size());
    }
  }
  const Product product = product_of("s4-fig6");
  CHECK(marks_of(product, "shadow", true).starts.size() < marks_of(product, "shadow", false).starts.size());
  CHECK(marks_of(product, "no such layer", false).starts.empty());
}

TEST_CASE("outline: points of a ball's surface are a radius from its middle, within a cell") {
  const Volume ball{.shape = Shape::sphere, .center = {1.0, 2.0, 3.0}, .radius = 2.0};
  const std::vector<Vec3> points = surface_points(ball, 20);
  REQUIRE(points.size() > 500);
  for (const Vec3& point : points) CHECK(std::abs(glm::length(point - ball.center) - 2.0) < 0.2);
}

TEST_CASE("overlay: volumes and obstacles can be shown where a run uses some") {
  const auto has = [](const std::string& preset, const char* name) {
    const std::vector<std::string> names = overlay_names(load_job(registry(), preset));
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
