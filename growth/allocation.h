// How the resource that light makes is shared among the buds. Both models take what sum_light() gathered on
// the way down and hand the resource up again, Palubicki et al. 2009, 4.2.
#pragma once

#include <vector>

#include "growth/light_sums.h"
#include "growth/plant.h"

namespace ramify::growth {

/// Extended Borchert-Honda model: at each node the main axis gets lambda * Q of its subtree, the laterals
/// (1 - lambda) * Q of theirs, in proportion; with demand = mean n * (Q / n)^demand_exponent stands in place
/// of Q, n being a side's internodes and buds. `vigour` gets one entry a bud; they sum to the v at the root
/// unless all light is 0. With demand = sum the light in `sums` is used up: it becomes what each side
/// passes on for a unit of light. O(nodes).
void allocate_borchert_honda(const Plant& plant, const MappedVector<double>& light, LightSums& sums,
                             const TreeParameters& tree, int step, MappedVector<double>& vigour);

/// Priority model: on each axis the axillary buds, lateral axes and the terminal bud are listed, best lit
/// first, and share by their light times a weight that falls along the list. `vigour` as above.
/// O(n log n) in the items of an axis.
void allocate_priority(const Plant& plant, const MappedVector<double>& light, const LightSums& sums,
                       const TreeParameters& tree, int step, MappedVector<double>& vigour);

/// Weight of the i-th of n items, i from 1 (P09, Eq. 3 with the fall that is meant).
double priority_weight(std::size_t i, std::size_t n, double w_max, double w_min, double kappa);

/// The resource at the root: alpha0 + alpha * Q.
double root_vigour(const LightSums& sums, const TreeParameters& tree, int step);

}  // namespace ramify::growth
