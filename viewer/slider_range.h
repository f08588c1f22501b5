// How far a parameter's slider reaches.
#pragma once

#include "common/config/field.h"

namespace ramify {

struct SliderRange {
  double low = 0.0;
  double high = 1.0;
};

/// All that the table allows where that is a handy range; else from the nearest limit to some times the
/// larger of `value` and `reference`, what the parameter was: a slider from 0 to a million cannot be set to
/// 2. Typed values may be anything allowed.
SliderRange slider_range(const FieldInfo& info, double value, double reference);

}  // namespace ramify
