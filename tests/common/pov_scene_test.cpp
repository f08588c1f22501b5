#include "common/format/pov_scene.h"

#include <sstream>

#include "tests/catch.h"
#include "tests/common/trees.h"

using namespace ramify;
using namespace ramify::test;

namespace {

const Provenance kProvenance{"1.2.3", "growth", 42, 7, "engine = \"growth\"\nseed = 42\n"};

std::string scene_of(const Skeleton& skeleton) {
  std::ostringstream out;
  write_pov_scene(skeleton, kProvenance, out);
  return out.str();
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t result = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++result;
  return result;
}

}  // namespace

TEST_CASE("POV-Ray: a cone an internode, a sphere a node, a camera and two lights") {
  const std::string scene = scene_of(pole(3));
  CHECK(count(scene, "\ncone {") == 3);
  CHECK(count(scene, "\nsphere {") == 4);
  CHECK(count(scene, "\ncamera {") == 1);
  CHECK(count(scene, "\nlight_source {") == 2);
  const std::size_t second = scene.find("\ncone { <0, 1, 0>, 0.0833");  // from node 1 to node 2
  REQUIRE(second != std::string::npos);
  CHECK(scene.find(", <0, 2, 0>, 0.0666", second) < scene.find("\n", second + 1));
}

TEST_CASE("POV-Ray: comments say what made the scene") {
  const std::string scene = scene_of(pole(1));
  CHECK(scene.rfind("// ramify 1.2.3: engine growth, seed 42, steps 7; metres, +Y up.", 0) == 0);
  CHECK(scene.find("\n//   seed = 42\n") != std::string::npos);
}

TEST_CASE("POV-Ray: what has no length or no width is left out, as POV-Ray would complain") {
  Skeleton tree = pole(3);
  tree.position[2] = tree.position[1];
  tree.diameter[3] = 0.0;
  const std::string scene = scene_of(tree);
  CHECK(count(scene, "\ncone {") == 2);
  CHECK(count(scene, "\nsphere {") == 3);
}
