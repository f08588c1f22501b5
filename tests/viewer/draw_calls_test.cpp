// How often OpenGL is told to draw, counted in its place.

#include <epoxy/gl.h>

#include "common/config/job.h"
#include "common/mesh/tree_mesh.h"
#include "growth/engine.h"
#include "tests/catch.h"
#include "viewer/renderer.h"

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

/// epoxy calls through pointers, which are ours to turn once they are resolved.
class DrawCounter {
 public:
  DrawCounter() {
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
    REQUIRE(tree.mesh.materials.size() == (preset == "decurrent" ? 2 : 1));
    const auto materials = static_cast<int>(tree.mesh.materials.size());
    for (const RenderStyle style : {RenderStyle::lit, RenderStyle::schematic}) {
      const int passes = style == RenderStyle::lit ? 2 : 1;
      options.style = style;
      const DrawCounter counter;
      renderer.render(scene, options);
      CHECK(calls == passes * materials);
      CHECK(indices == static_cast<GLsizei>(3 * passes * tree.mesh.triangles.size()));
    }
  }
}
