#include "viewer/numbers.h"

#include <cmath>
#include <numeric>
#include <string>

#include "growth/engine.h"
#include "tests/catch.h"

using namespace ramify;

TEST_CASE("numbers: as text they take seven characters at most and keep what counts") {
  CHECK(number_text(0.0, false) == "0");
  CHECK(number_text(0.08418, false) == "0.0842");
  CHECK(number_text(-0.0036149, false, true) == "-0.0036");
  CHECK(number_text(-0.00031, false) == "-3.1e-4");
  CHECK(number_text(258.71, false) == "258.7");
  CHECK(number_text(2544.6, false, true) == "+2545");
  CHECK(number_text(640'000.0, true, true) == "+640000");
  CHECK(number_text(23.0, true) == "23");
  CHECK(number_text(5'123'456.0, true) == "5.12e6");
  for (const double digits : {1.0, 1.2345678, 9.9995, 9.99999999}) {
    for (int power = -8; power <= 8; ++power) {
      const double value = -digits * std::pow(10.0, power);
      INFO(value);
      CHECK(number_text(value, false, true).size() <= 7);
      // Half of the last of two digits.
      CHECK(std::stod(number_text(value, false)) == Approx(value).epsilon(0.05));
    }
  }
}

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
