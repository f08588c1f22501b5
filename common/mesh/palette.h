// Which colours stand for what.
#pragma once

#include <cstddef>

#include "common/base/color.h"

namespace ramify {

/// Viridis (van der Walt & Smith 2015), perceptually uniform: 0 dark blue, 1 yellow. t is clamped; grey for
/// NaN.
Color sequential_color(double t);

/// Nine colours in turn that also colour-blind readers tell apart (Tol 2021, "muted").
Color categorical_color(std::size_t index);

/// Bark of a stem of this diameter, metres: grey-brown where thick, redder and lighter towards the twigs.
Color bark_color(double diameter);

/// The same of smooth-barked trees, beech for instance (twigs brown, stems grey), and of pines (twigs
/// yellowish, stems reddish grey).
Color smooth_bark_color(double diameter);
Color plated_bark_color(double diameter);

}  // namespace ramify
