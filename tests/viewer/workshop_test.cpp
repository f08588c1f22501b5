#include "viewer/workshop.h"

#include <atomic>
#include <chrono>

#include "common/config/engine.h"
#include "growth/engine.h"
#include "tests/catch.h"

using namespace ramify;
using namespace std::chrono_literals;

namespace {

/// An engine whose runs end when they are told to, or take a number of steps.
struct SlowEngine {
  struct Parameters {
    std::uint64_t seed = 1;
    int steps = 1;
    static const Table& fields() {
      static const Table table = make_table<Parameters>(
          {{"seed", &Parameters::seed, {.is_top_level = true}},
           {"steps", &Parameters::steps, {.min = 1, .max = 1e6, .is_top_level = true}}});
      return table;
    }
  };
  static constexpr std::string_view name = "slow";
  static constexpr bool has_history = false;
  static inline std::atomic<int> stopped = 0;
  static std::vector<std::string> layers(const Parameters&) { return {}; }
  static UsedVolumes volumes(const Parameters&) { return {}; }
  static std::vector<std::string> check(const Parameters&) { return {}; }
  static int steps(const Parameters& parameters) { return parameters.steps; }
  static RunResult run(const Parameters& parameters, const RunContext& context) {
    for (int step = 0; step < parameters.steps; ++step) {
      if (context.stop.stop_requested()) {
        ++stopped;
        break;
      }
      std::this_thread::sleep_for(5ms);
      context.report({"waiting", double(step), double(parameters.steps), "step"});
    }
    throw std::runtime_error("a run of " + std::to_string(parameters.steps));
  }
};

std::unique_ptr<Product> awaited(Workshop& workshop) {
  for (int i = 0; i < 2000; ++i) {
    if (auto product = workshop.take()) return product;
    std::this_thread::sleep_for(5ms);
  }
  return nullptr;
}

template <class Engine>
std::shared_ptr<const Job> job_of(int steps) {
  static EngineRegistry engines = [] {
    EngineRegistry all;
    all.add<Engine>();
    return all;
  }();
  Job job = default_job(engines.engines().front());
  static_cast<typename Engine::Parameters*>(job.parameters.get())->steps = steps;
  return std::make_shared<const Job>(std::move(job));
}

}  // namespace

TEST_CASE(
    "workshop: an order comes back as tree, mesh and sky light, a draft with fewer triangles and no sky") {
  Workshop workshop([] {});
  workshop.order({.number = 1, .job = job_of<growth::Engine>(8)});
  const auto fine = awaited(workshop);
  REQUIRE(fine);
  CHECK(fine->number == 1);
  CHECK(fine->error.empty());
  CHECK(fine->last_step == 8);
  CHECK(fine->mesh.triangles.size() > 0);
  CHECK_FALSE(fine->sky.visibility.empty());

  workshop.order({.number = 2, .job = fine->job, .run = fine->run, .at = 4, .is_draft = true});
  const auto draft = awaited(workshop);
  REQUIRE(draft);
  CHECK(draft->number == 2);
  CHECK(draft->run_seconds == 0.0);
  CHECK(draft->skeleton.internode_count() < fine->skeleton.internode_count());
  CHECK(draft->mesh.triangles.size() < fine->mesh.triangles.size());
  CHECK(draft->sky.visibility.empty());
}

TEST_CASE("workshop: a draft is written into the memory of the one before") {
  Workshop workshop([] {});
  workshop.order({.number = 1, .job = job_of<growth::Engine>(8), .is_draft = true});
  auto first = awaited(workshop);
  REQUIRE(first);
  const auto job = first->job;
  const auto run = first->run;
  const Vec3f* memory = first->mesh.positions.data();
  const auto positions = first->mesh.positions;
  workshop.retire(std::move(first), true);
  workshop.order({.number = 2, .job = job, .run = run, .is_draft = true});
  const auto second = awaited(workshop);
  REQUIRE(second);
  CHECK(second->mesh.positions.data() == memory);
  CHECK(second->mesh.positions == positions);
}

TEST_CASE("workshop: the newest order wins and a long run is stopped for it") {
  SlowEngine::stopped = 0;
  Workshop workshop([] {});
  workshop.order({.number = 1, .job = job_of<SlowEngine>(100'000)});
  std::this_thread::sleep_for(400ms);
  CHECK(workshop.state().is_busy);
  CHECK(workshop.state().stage == "waiting");
  workshop.order({.number = 2, .job = job_of<SlowEngine>(100'000)});
  workshop.order({.number = 3, .job = job_of<SlowEngine>(1)});
  const auto product = awaited(workshop);
  REQUIRE(product);
  CHECK(product->number == 3);
  CHECK(product->error == "a run of 1");
  CHECK(SlowEngine::stopped >= 1);
}

TEST_CASE("workshop: closing it stops what it makes") {
  SlowEngine::stopped = 0;
  {
    Workshop workshop([] {});
    workshop.order({.number = 1, .job = job_of<SlowEngine>(100'000)});
    while (workshop.state().stage.empty()) std::this_thread::sleep_for(5ms);
  }
  CHECK(SlowEngine::stopped == 1);
}
