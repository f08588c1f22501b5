#include "viewer/document.h"

#include <chrono>
#include <thread>

#include "common/config/toml_reader.h"
#include "tests/catch.h"
#include "tests/engines.h"

using namespace ramify;
using namespace std::chrono_literals;

namespace {

Opened preset(const std::string& name) {
  return {.input = name, .job = load_job(test::both_engines(), name), .tree = {}, .mesh = {}};
}

void set(Document& document, const std::string& key, const std::string& value) {
  Origins origins;
  assign(job_table(*document.job().engine), &document.job(), key, value, "", origins);
}

/// Until the tree is there as it is when all has come to rest.
bool settles(Document& document) {
  for (int i = 0; i < 2000; ++i) {
    document.update(1e9, true);
    if (document.is_settled()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

}  // namespace

TEST_CASE("document: an edit gives another tree, undo and redo give back the ones before") {
  Document document(preset("s4-fig6"), [] {});
  REQUIRE(settles(document));
  const std::size_t first = document.product()->skeleton.internode_count();
  set(document, "steps", "8");
  document.edited(0.0);
  document.settle();
  REQUIRE(settles(document));
  const std::size_t second = document.product()->skeleton.internode_count();
  CHECK(second > first);
  document.undo(0.0);
  CHECK_FALSE(document.can_undo());
  REQUIRE(settles(document));
  CHECK(document.product()->skeleton.internode_count() == first);
  document.redo(0.0);
  REQUIRE(settles(document));
  CHECK(document.product()->skeleton.internode_count() == second);
}

TEST_CASE("document: parameters that cannot be keep the last tree and say why") {
  Document document(preset("s4-fig6"), [] {});
  REQUIRE(settles(document));
  const Product* before = document.product();
  set(document, "mesher.sides_min", "30");
  document.edited(0.0);
  CHECK(document.error().find("mesher.sides_min: 30 is more than sides_max") != std::string::npos);
  document.update(1e9, true);
  CHECK(document.product() == before);
  set(document, "mesher.sides_min", "4");
  document.edited(0.0);
  CHECK(document.error().empty());
}

TEST_CASE("document: earlier steps and levels are shown without running again") {
  for (const std::string name : {"s4-fig6", "xm12-fig5"}) {
    Document document(preset(name), [] {});
    REQUIRE(settles(document));
    const auto run = document.product()->run;
    const std::size_t whole = document.product()->skeleton.internode_count();
    document.show_step(1, 0.0);
    REQUIRE(settles(document));
    CHECK(document.product()->run == run);
    CHECK(document.product()->skeleton.internode_count() < whole);
    CHECK(violations(document.product()->skeleton).empty());
    document.show_step(document.last_step(), 0.0);
    REQUIRE(settles(document));
    CHECK(document.product()->skeleton.internode_count() == whole);
  }
}

TEST_CASE("document: each engine keeps its parameters while the other is at work") {
  Document document(preset("s4-fig6"), [] {});
  set(document, "growth.kappa", "0.25");
  document.edited(0.0);
  document.settle();
  document.switch_engine(*test::both_engines().find("pathplan"), 0.0);
  CHECK(document.job().engine->name == "pathplan");
  CHECK(generate_command(document) ==
        "ramify params pathplan --toml > pathplan.toml && ramify generate pathplan.toml -o tree.glb");
  document.switch_engine(*test::both_engines().find("growth"), 0.0);
  CHECK(generate_command(document) == "ramify generate s4-fig6 --set growth.kappa=0.25 -o tree.glb");
  document.undo(0.0);
  CHECK(document.job().engine->name == "pathplan");
}

TEST_CASE("document: the command quotes what a shell would take apart") {
  Document document(preset("s4-fig6"), [] {});
  set(document, "growth.lambda", "[[1, 0.6], [8, 0.5]]");
  CHECK(generate_command(document) ==
        "ramify generate s4-fig6 --set 'growth.lambda=[[1, 0.6], [8, 0.5]]' -o tree.glb");
}

TEST_CASE("document: only layers that the engine makes are asked for, and come with the tree") {
  Document document(preset("s4-fig6"), [] {});
  REQUIRE(settles(document));
  document.want_layers({"shadow", "graph"}, 0.0);
  REQUIRE(settles(document));
  REQUIRE(document.product()->run->layers.size() == 1);
  CHECK(document.product()->run->layers.front().name == "shadow");
}
