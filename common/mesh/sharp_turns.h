// Where an axis turns back, as dead leaders make it do, a tube swept along it would fold over on the inner
// side: there it ends, and what goes on leaves it as a lateral does.
#pragma once

#include "common/mesh/axes.h"

namespace ramify {

/// Ends axes where they turn sharply; what follows becomes an axis of its own, which stands after the one it
/// was a part of. O(points), on all threads.
void part_sharp_turns(Axes& axes);

}  // namespace ramify
