#include "common/base/rng.h"

#include <cmath>
#include <set>
#include <vector>

#include "tests/catch.h"

using namespace ramify;

TEST_CASE("rng: a stream's numbers depend on its address alone") {
  Rng first = Rng::stream(7, Stream::bud, 3, 4);
  Rng::stream(7, Stream::bud, 3, 5).next();
  Rng second = Rng::stream(7, Stream::bud, 3, 4);
  for (int i = 0; i < 100; ++i) CHECK(first.next() == second.next());
}

TEST_CASE("rng: seed, purpose and both indices all change the numbers") {
  std::set<std::uint64_t> firsts;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const Stream purpose : {Stream::bud, Stream::axis, Stream::endpoint}) {
      for (std::uint64_t i = 0; i < 10; ++i) {
        for (std::uint64_t j = 0; j < 10; ++j) firsts.insert(Rng::stream(seed, purpose, i, j).next());
      }
    }
  }
  CHECK(firsts.size() == 3000);
}

TEST_CASE("rng: the numbers never change from one version to the next") {
  // Golden: trees of old configs must come out again.
  Rng random = Rng::stream(1, Stream::bud, 2, 3);
  CHECK(random.next() == 0x599bc9a3a6ddcbf2ULL);
}

TEST_CASE("rng: uniform numbers fill the unit interval evenly") {
  std::vector<int> counts(10, 0);
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    const double u = Rng::stream(5, Stream::dart, i).uniform();
    REQUIRE(u >= 0.0);
    REQUIRE(u < 1.0);
    ++counts[static_cast<std::size_t>(u * 10)];
  }
  // 5 standard deviations of a binomial count.
  for (const int count : counts) CHECK(std::abs(count - 10'000) < 5 * 95);
}

TEST_CASE("rng: below(n) reaches every number under n and no other") {
  Rng random = Rng::stream(9, Stream::endpoint, 0);
  std::vector<int> counts(7, 0);
  for (int i = 0; i < 7000; ++i) {
    const std::uint64_t drawn = random.below(7);
    REQUIRE(drawn < 7);
    ++counts[drawn];
  }
  for (const int count : counts) CHECK(std::abs(count - 1000) < 150);
}
