#include "pathplan/lifespans.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "common/base/rng.h"

namespace ramify::pathplan {
namespace {

void deal_by_light(const Light& light, std::size_t level, std::uint64_t seed, std::span<Sprout> sprouts) {
  const std::size_t count = sprouts.size();
  Rng rng = Rng::stream(seed, Stream::light, level);
  std::vector<int> decrements(count);
  std::vector<double> factors(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto span = static_cast<std::uint64_t>(light.decrement_high - light.decrement_low + 1);
    decrements[i] = light.decrement_low + static_cast<int>(rng.below(span));
    factors[i] = rng.uniform(light.b_low, light.b_high);
  }
  std::sort(decrements.begin(), decrements.end());
  std::sort(factors.begin(), factors.end(), std::greater<>());

  const Vec3 to_light = glm::normalize(light.direction);
  std::vector<std::size_t> by_angle(count);
  std::iota(by_angle.begin(), by_angle.end(), std::size_t{0});
  std::stable_sort(by_angle.begin(), by_angle.end(), [&](std::size_t i, std::size_t j) {
    return glm::dot(sprouts[i].v_g, to_light) > glm::dot(sprouts[j].v_g, to_light);
  });
  for (std::size_t rank = 0; rank < count; ++rank) {
    Sprout& sprout = sprouts[by_angle[rank]];
    sprout.lifespan = std::max(0, sprout.lifespan - decrements[rank]);
    sprout.b_factor = factors[rank];
  }
}

/// Terminated with a probability, else less by a random number of 1 .. L.
int drawn_lifespan(int lifespan, double p_stop, Rng rng) {
  if (lifespan == 0 || rng.uniform() < p_stop) return 0;
  return lifespan - 1 - static_cast<int>(rng.below(static_cast<std::uint64_t>(lifespan)));
}

}  // namespace

void deal_lifespans(const Lifespan& lifespan, const Light& light, std::size_t level, std::uint64_t seed,
                    std::span<Sprout> sprouts) {
  const bool is_lit = light.decrement_high > 1 || light.b_low != 1.0 || light.b_high != 1.0;
  if (lifespan.rule == LifespanRule::fixed) {
    if (is_lit) return deal_by_light(light, level, seed, sprouts);
    for (Sprout& sprout : sprouts) sprout.lifespan = std::max(0, sprout.lifespan - 1);
    return;
  }
  // The light deals out the counts alone: check_parameters() sees to it.
  const std::vector<Sprout> before(sprouts.begin(), sprouts.end());
  if (is_lit) deal_by_light(light, level, seed, sprouts);
  for (std::size_t i = 0; i < sprouts.size(); ++i) {
    sprouts[i].lifespan = level == 1 ? before[i].lifespan - 1
                                     : drawn_lifespan(before[i].lifespan, lifespan.p_stop,
                                                      Rng::stream(seed, Stream::lifespan, level, i));
  }
}

}  // namespace ramify::pathplan
