// One tree growing, a step at a time. Palubicki et al. 2009, Section 4.
#pragma once

#include <vector>

#include "common/base/stopwatch.h"
#include "growth/plant.h"
#include "growth/shadow_grid.h"

namespace ramify::growth {

class Simulation {
 public:
  explicit Simulation(const Parameters& parameters);

  /// Takes the next step. Returns false, with nothing changed, if it would make more than max_internodes.
  bool advance();

  /// The resource that the tree as it stands has to share, a bud: what the next step will grow by.
  void sense();

  int step() const { return step_; }
  const Plant& plant() const { return plant_; }
  const ShadowGrid& shadow() const { return shadow_; }
  const LightSums& sums() const { return sums_; }                // of the last sense()
  const std::vector<double>& light() const { return light_; }    // Q a bud, likewise
  const std::vector<double>& vigour() const { return vigour_; }  // v a bud, likewise
  const Stopwatch& stopwatch() const { return stopwatch_; }

 private:
  const Parameters& parameters_;
  Plant plant_;
  ShadowGrid shadow_;
  int step_ = 0;
  std::vector<double> light_;
  LightSums sums_;
  std::vector<double> vigour_;
  Stopwatch stopwatch_;
};

}  // namespace ramify::growth
