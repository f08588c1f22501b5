// A schedule as points on a curve that are moved by hand.
#pragma once

#include "common/config/schedule.h"
#include "viewer/field_widget.h"
#include "viewer/slider_range.h"

namespace ramify {

/// Draws the curve of a schedule that is not constant, from 0 to `last` across and over `range` up. Points
/// are dragged; a double click adds one, a right click takes one away; with the last but one it becomes a
/// constant again.
WidgetOutcome schedule_curve(const char* id, Schedule& schedule, double last, const SliderRange& range);

}  // namespace ramify
