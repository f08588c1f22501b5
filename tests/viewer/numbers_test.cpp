#include "viewer/numbers.h"

#include <numeric>

#include "growth/engine.h"
#include "tests/catch.h"

using namespace ramify;

TEST_CASE("numbers: a histogram of lengths counts each axis once, one of angles each that another bears") {
  const growth::Parameters parameters;
  const Skeleton tree = growth::Engine::run(parameters, {}).skeleton;
  const Numbers numbers = numbers_of(tree);
  const auto total = [](const Histogram& histogram) {
    float sum = 0.0f;
    for (const auto& order : histogram.by_order) sum = std::accumulate(order.begin(), order.end(), sum);
    return static_cast<std::size_t>(sum);
  };
  CHECK(total(numbers.lengths) == tree.axis_count());
  CHECK(total(numbers.angles) < tree.axis_count());
  CHECK(total(numbers.angles) > 0);
  CHECK(numbers.metrics.internodes == tree.internode_count());
}
