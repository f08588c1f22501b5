#include "common/config/inheritance.h"

#include "common/config/job.h"
#include "growth/engine.h"
#include "tests/catch.h"

using namespace ramify;

namespace {

EngineRegistry registry() {
  EngineRegistry engines;
  growth::register_engine(engines);
  return engines;
}

growth::Parameters& parameters_of(Job& job) {
  return *static_cast<growth::Parameters*>(job.parameters.get());
}

void follow(Job& before, Job& job) {
  follow_owner(job_table(*job.engine), &before, &job);
}

}  // namespace

TEST_CASE("inheritance: a tree that is added by hand is the config's own") {
  growth::Parameters parameters;
  parameters.lambda = 0.7;
  parameters.tropism["up"].weight = 0.4;
  const Table& table = growth::Parameters::fields();
  for (const FieldRow& row : table) {
    if (row.key == "trees") append_item(table, &parameters, row);
  }
  REQUIRE(parameters.trees.size() == 1);
  CHECK(parameters.trees[0].lambda.at(1.0) == 0.7);
  REQUIRE(parameters.trees[0].tropism.count("up") == 1);
  CHECK(parameters.trees[0].tropism["up"].weight.at(1.0) == 0.4);
}

TEST_CASE("inheritance: a change by hand reaches the trees that have no value of their own") {
  const EngineRegistry engines = registry();
  const std::vector<Override> own = {{"--set", "growth.trees", "[{lambda = 0.3}, {position = [2, 0, 0]}]"},
                                     {"--set", "growth.lambda", "0.6"},
                                     {"--set", "growth.tropism.up.weight", "0.2"}};
  Job job = load_job(engines, "s4-fig6", own);
  Job before = independent_copy(job);
  growth::Parameters& now = parameters_of(job);
  now.lambda = 0.9;
  now.tropism["up"].weight = 0.5;
  now.tropism["aside"].weight = 0.1;
  follow(before, job);
  CHECK(now.trees[0].lambda.at(1.0) == 0.3);
  CHECK(now.trees[1].lambda.at(1.0) == 0.9);
  CHECK(now.trees[1].position.x == 2.0);
  CHECK(now.trees[0].tropism["up"].weight.at(1.0) == 0.5);
  CHECK(now.trees[1].tropism.count("aside") == 1);

  before = independent_copy(job);
  now.tropism.erase("aside");
  follow(before, job);
  CHECK(now.trees[0].tropism.count("aside") == 0);
  CHECK(now.trees[0].tropism.count("up") == 1);
}
