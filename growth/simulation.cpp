#include "growth/simulation.h"

#include "growth/allocation.h"
#include "growth/environment_light.h"
#include "growth/shedding.h"
#include "growth/shoots.h"

namespace ramify::growth {

Simulation::Simulation(const Parameters& parameters)
    : parameters_(parameters),
      plant_(seedling(parameters)),
      shadow_({.a = parameters.a, .b = parameters.b, .q_max = parameters.q_max}, parameters.voxel_edge()) {
  if (parameters.casters == Casters::buds)
    shadow_.cast(std::vector<Coord>{shadow_.voxel_of(plant_.position[0])});
}

void Simulation::sense() {
  const int step = step_ + 1;
  sense_light(plant_, parameters_, shadow_, step, light_);
  stopwatch_.lap("light");
  sum_light(plant_, light_, sums_);
  switch (parameters_.allocation) {
    case Allocation::priority:
      allocate_priority(plant_, light_, sums_, parameters_, step, vigour_);
      break;
    case Allocation::borchert_honda:
      allocate_borchert_honda(plant_, light_, sums_, parameters_, step, vigour_);
      break;
  }
  stopwatch_.lap("allocation");
}

bool Simulation::advance() {
  sense();
  const int step = step_ + 1;
  const double planned = planned_metamers(vigour_, parameters_, step);
  if (static_cast<double>(plant_.internode_count()) + planned > parameters_.max_internodes) return false;

  const std::vector<std::uint32_t> shaded = shaded_axes(plant_, sums_, parameters_, step);
  const CasterChanges changes = extend_shoots(plant_, vigour_, parameters_, shadow_, step);
  stopwatch_.lap("shoots");
  shadow_.cast(changes.added);
  shadow_.uncast(changes.removed);
  stopwatch_.lap("shadow");
  shadow_.uncast(shed_axes(plant_, shaded, parameters_, shadow_, step));
  stopwatch_.lap("shedding");
  step_ = step;
  return true;
}

}  // namespace ramify::growth
