#include "pathplan/lifespans.h"

#include <algorithm>
#include <map>

#include "common/base/rng.h"
#include "tests/catch.h"

using namespace ramify;
using namespace ramify::pathplan;

namespace {

const Lifespan kDistribution{.rule = LifespanRule::distribution};

std::vector<Sprout> sprouts_of(std::size_t count, int lifespan) {
  Rng rng = Rng::stream(7, Stream::bud, 0);
  std::vector<Sprout> sprouts(count);
  for (Sprout& sprout : sprouts) {
    const Vec3 v(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
    sprout = {.v_g = normalized_or(v, kUp), .lifespan = lifespan};
  }
  return sprouts;
}

std::vector<Sprout> dealt(std::vector<Sprout> sprouts, const Lifespan& lifespan, const Light& light = {},
                          std::size_t level = 2, std::uint64_t seed = 1) {
  deal_lifespans(lifespan, light, level, seed, sprouts);
  return sprouts;
}

std::vector<int> lifespans_of(const std::vector<Sprout>& sprouts) {
  std::vector<int> lifespans;
  for (const Sprout& sprout : sprouts) lifespans.push_back(sprout.lifespan);
  return lifespans;
}

/// How often each lifespan is there, as a share of all.
std::map<int, double> shares(const std::vector<Sprout>& sprouts) {
  std::map<int, double> shares;
  for (const Sprout& sprout : sprouts) shares[sprout.lifespan] += 1.0 / static_cast<double>(sprouts.size());
  return shares;
}

}  // namespace

TEST_CASE("lifespans: one less a level, and never less than 0") {
  std::vector<Sprout> sprouts = {{.lifespan = 3}, {.lifespan = 1}, {.lifespan = 0}};
  for (const std::size_t level : {1, 2, 5}) {
    const std::vector<Sprout> after = dealt(sprouts, {}, {}, level);
    CHECK(lifespans_of(after) == std::vector<int>{2, 0, 0});
    for (const Sprout& sprout : after) CHECK(sprout.b_factor == 1.0);
  }
}

TEST_CASE("lifespans: by distribution level 1 is only one less") {
  CHECK(lifespans_of(dealt(sprouts_of(3, 4), kDistribution, {}, 1)) == std::vector<int>{3, 3, 3});
}

TEST_CASE("lifespans: by distribution none is left with p_stop, else 1 to L less, each alike") {
  constexpr std::size_t kCount = 40'000;
  for (const double p_stop : {0.0, 0.3, 0.8}) {
    for (const int lifespan : {1, 2, 4}) {
      const Lifespan rule{.rule = LifespanRule::distribution, .p_stop = p_stop};
      std::map<int, double> found = shares(dealt(sprouts_of(kCount, lifespan), rule));
      INFO("p_stop " << p_stop << ", L " << lifespan);
      CHECK(found.rbegin()->first == lifespan - 1);
      CHECK(found.begin()->first == 0);
      const double each = (1.0 - p_stop) / lifespan;
      CHECK(std::abs(found[0] - (p_stop + each)) < 0.01);  // four standard deviations
      for (int left = 1; left < lifespan; ++left) CHECK(std::abs(found[left] - each) < 0.01);
    }
  }
  const Lifespan always{.rule = LifespanRule::distribution, .p_stop = 1.0};
  CHECK(lifespans_of(dealt(sprouts_of(100, 4), always)) == std::vector<int>(100, 0));
  CHECK(lifespans_of(dealt(sprouts_of(2, 0), kDistribution)) == std::vector<int>{0, 0});
}

TEST_CASE("lifespans: what is drawn belongs to the seed, the level and the endpoint") {
  const std::vector<Sprout> before = sprouts_of(200, 4);
  const std::vector<int> drawn = lifespans_of(dealt(before, kDistribution));
  CHECK(drawn == lifespans_of(dealt(before, kDistribution)));
  CHECK(drawn != lifespans_of(dealt(before, kDistribution, {}, 3)));
  CHECK(drawn != lifespans_of(dealt(before, kDistribution, {}, 2, 9)));
  std::vector<int> first = lifespans_of(dealt(sprouts_of(50, 4), kDistribution));
  CHECK(std::equal(first.begin(), first.end(), drawn.begin()));
}

TEST_CASE("lifespans: the endpoint nearest to the light gets the least decrement and the greatest count") {
  // Two of three get what is certain: both numbers have one value.
  std::vector<Sprout> sprouts = {{.v_g = {0, -1, 0}, .lifespan = 5},
                                 {.v_g = {0, 1, 0}, .lifespan = 5},
                                 {.v_g = {1, 0, 0}, .lifespan = 5}};
  const Light even{.decrement_low = 2, .decrement_high = 2, .b_low = 1.5, .b_high = 1.5};
  const std::vector<Sprout> alike = dealt(sprouts, {}, even);
  CHECK(lifespans_of(alike) == std::vector<int>{3, 3, 3});
  for (const Sprout& sprout : alike) CHECK(sprout.b_factor == 1.5);

  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const Vec3& direction : {Vec3(0.0, 0.2, 0.0), Vec3(3.0, -1.0, 2.0)}) {
      for (const std::size_t level : {1, 3}) {
        const Light light{
            .direction = direction, .decrement_low = 1, .decrement_high = 3, .b_low = 0.5, .b_high = 2.0};
        std::vector<Sprout> after = dealt(sprouts_of(3000, 7), {}, light, level, seed);
        std::sort(after.begin(), after.end(), [&](const Sprout& a, const Sprout& b) {
          return glm::dot(a.v_g, direction) > glm::dot(b.v_g, direction);
        });
        CHECK(std::is_sorted(after.begin(), after.end(),
                             [](const Sprout& a, const Sprout& b) { return a.lifespan > b.lifespan; }));
        CHECK(std::is_sorted(after.begin(), after.end(),
                             [](const Sprout& a, const Sprout& b) { return a.b_factor > b.b_factor; }));
        // Both are uniform in their range, ends included.
        std::map<int, double> found = shares(after);
        REQUIRE(found.size() == 3);
        for (const int left : {4, 5, 6}) CHECK(std::abs(found[left] - 1.0 / 3.0) < 0.035);
        CHECK(after.front().b_factor <= 2.0);
        CHECK(after.front().b_factor > 1.99);
        CHECK(after.back().b_factor >= 0.5);
        CHECK(after.back().b_factor < 0.51);
        CHECK(std::abs(after[1500].b_factor - 1.25) < 0.1);
      }
    }
  }
}

TEST_CASE("lifespans: the light leaves none below 0") {
  const Light light{.decrement_low = 1, .decrement_high = 9};
  for (const int left : lifespans_of(dealt(sprouts_of(500, 3), {}, light))) REQUIRE(left >= 0);
  const std::map<int, double> found = shares(dealt(sprouts_of(500, 3), {}, light));
  CHECK(found.rbegin()->first == 2);
  CHECK(found.at(0) > 0.7);  // decrements 3 to 9
}

TEST_CASE("lifespans: with a distribution the light deals out the counts alone") {
  const Light light{.direction = {1.0, 0.0, 0.0}, .b_low = 0.5, .b_high = 2.0};
  const std::vector<Sprout> before = sprouts_of(300, 4);
  const std::vector<Sprout> after = dealt(before, kDistribution, light);
  CHECK(lifespans_of(after) == lifespans_of(dealt(before, kDistribution)));
  for (const Sprout& a : after) {
    for (const Sprout& b : after) REQUIRE((a.v_g.x <= b.v_g.x || a.b_factor >= b.b_factor));
  }
}

TEST_CASE("lifespans: of endpoints that see the light alike the first comes first") {
  std::vector<Sprout> sprouts(50, Sprout{.lifespan = 9});
  const std::vector<Sprout> after =
      dealt(sprouts, {}, {.decrement_low = 1, .decrement_high = 6, .b_low = 0.0, .b_high = 1.0});
  for (std::size_t i = 1; i < after.size(); ++i) {
    CHECK(after[i].lifespan <= after[i - 1].lifespan);
    CHECK(after[i].b_factor <= after[i - 1].b_factor);
  }
}

TEST_CASE("lifespans: a level without endpoints has none") {
  CHECK(dealt({}, {}, {.decrement_low = 1, .decrement_high = 3}).empty());
  CHECK(dealt({}, kDistribution).empty());
}
