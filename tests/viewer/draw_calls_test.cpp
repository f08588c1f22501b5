// How often OpenGL is told to draw, counted in its place.

#include <epoxy/gl.h>

#include "common/config/job.h"
#include "common/mesh/tree_mesh.h"
#include "growth/engine.h"
#include "tests/catch.h"
#include "viewer/offscreen_context.h"
#include "viewer/pane.h"
#include "viewer/renderer.h"
#include "viewer/workshop.h"

using namespace ramify;

namespace {

int calls = 0;
GLsizei indices = 0;
PFNGLDRAWELEMENTSPROC draw_elements = nullptr;

void count_and_draw(GLenum mode, GLsizei count, GLenum type, const void* first) {
  ++calls;
  indices += count;
  draw_elements(mode, count, type, first);
}

/// epoxy calls through pointers, which are ours to turn once they are resolved: by a call that draws nothing.
/// Needs a current context.
class DrawCounter {
 public:
  DrawCounter() {
    glDrawElements(GL_TRIANGLES, 0, GL_UNSIGNED_INT, nullptr);
    glGetError();  // of a context without vertices
    draw_elements = epoxy_glDrawElements;
    epoxy_glDrawElements = count_and_draw;
    calls = 0;
    indices = 0;
  }
  ~DrawCounter() { epoxy_glDrawElements = draw_elements; }
};

struct DressedTree {
  Skeleton skeleton;
  Mesh mesh;
};

DressedTree tree_of(const std::string& preset) {
  EngineRegistry engines;
  growth::register_engine(engines);
  const Job job = load_job(engines, preset);
  DressedTree tree{job.run({}).skeleton, {}};
  tree.mesh = make_tree_mesh(tree.skeleton, job.looks(), job.seed()).mesh;
  return tree;
}

}  // namespace

TEST_CASE("painter: a tree of any size is drawn in one call a material, and once more for its shadow") {
  RenderOptions options;
  options.width = options.height = 64;
  Renderer renderer;
  for (const std::string preset : {"s4-fig3", "decurrent"}) {
    const DressedTree tree = tree_of(preset);
    const Scene scene{.mesh = &tree.mesh, .skeleton = &tree.skeleton};
    renderer.render(scene, options);
    INFO(preset << ": " << tree.mesh.triangles.size() << " triangles");
    // The last is bark over forks, which casts no shadow and is not to be seen in plain colours.
    REQUIRE(tree.mesh.materials.size() == (preset == "decurrent" ? 3 : 2));
    const auto materials = static_cast<int>(tree.mesh.materials.size());
    const std::size_t solid = solid_part(tree.mesh).triangle_count;
    for (const RenderStyle style : {RenderStyle::lit, RenderStyle::schematic}) {
      const bool is_lit = style == RenderStyle::lit;
      options.style = style;
      const DrawCounter counter;
      renderer.render(scene, options);
      CHECK(calls == (is_lit ? 2 * materials - 1 : materials - 1));
      CHECK(indices == static_cast<GLsizei>(3 * (is_lit ? solid + tree.mesh.triangles.size() : solid)));
    }
  }
}

namespace {

/// As the window's worker makes it.
Product product_of(const std::string& preset, const std::string& key, const std::string& value) {
  EngineRegistry engines;
  growth::register_engine(engines);
  const std::vector<Override> overrides = {{"--set", key, value}};
  const auto job = std::make_shared<const Job>(load_job(engines, preset, overrides));
  Product product;
  product.job = job;
  product.run = std::make_shared<const RunResult>(job->run({}));
  dress(product, {.job = job});
  return product;
}

struct Drawn {
  Image image;
  int calls = 0;     // for the picture and its shadows
  int pictures = 0;  // that were asked for until it was there
  int empty = 0;     // of these, how many there was nothing to show for
};

/// Until nothing is missing, as the window's pane does it.
Drawn drawn_by_pane(const Product& product, bool is_gradual) {
  const Orbit orbit = framed({}, framing_points(product), 1.0);
  Pane pane({}, is_gradual);
  const DrawCounter counter;
  Drawn drawn;
  do {
    drawn.empty += pane.picture({{&product, std::nullopt}}, {}, orbit, 64, 64, Quality::finest) == 0 ? 1 : 0;
    ++drawn.pictures;
  } while (pane.is_unfinished());
  drawn.image = pane.image();
  drawn.calls = calls;
  return drawn;
}

}  // namespace

TEST_CASE("pane: a tree of five million triangles is one call a material, or part by part the same picture") {
  const Product product = product_of("decurrent", "leaves.spacing", "0.0094");
  REQUIRE(product.mesh.triangles.size() > 4'900'000);
  REQUIRE(product.mesh.materials.size() == 3);
  const OffscreenContext context;

  // As a graphics device draws it: the shadows and the picture.
  const Drawn at_once = drawn_by_pane(product, false);
  CHECK(at_once.calls == 2 * 3 - 1);
  CHECK(at_once.empty < at_once.pictures);

  // As it is drawn in software: the coarse tree is on show while the fine one is drawn.
  const Drawn in_parts = drawn_by_pane(product, true);
  CHECK(in_parts.calls > 20);
  CHECK(in_parts.pictures > in_parts.empty + 5);
  CHECK(in_parts.image.rgba == at_once.image.rgba);
}

TEST_CASE("portion: parts follow each other, and what goes with the last comes alone") {
  const Portion limited(true);
  std::size_t done = 0;
  std::size_t parts = 0;
  TreePart part;
  do {
    part = limited.next(done, 120'000);
    CHECK(part.first == done);
    CHECK((part.is_last() ? part.first == 120'000 : part.end > part.first));
    done = part.end;
    ++parts;
  } while (!part.is_last());
  CHECK(parts > 2);
  const TreePart all = Portion(false).next(0, 120'000);
  CHECK(all.is_first());
  CHECK(all.is_last());
}
