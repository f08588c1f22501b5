// One parameter as a widget, whatever engine it belongs to.
#pragma once

#include <string>

#include "common/config/field.h"

namespace ramify {

/// What the user did to a widget in this frame.
struct WidgetOutcome {
  bool is_changed = false;   // the value is another one
  bool is_finished = false;  // and stays: the slider was let go, the choice was made

  WidgetOutcome& operator|=(const WidgetOutcome& other) {
    is_changed = is_changed || other.is_changed;
    is_finished = is_finished || other.is_finished;
    return *this;
  }
};

/// Slider, list, check box or text for the member of a row that is no group, list or map; as wide as the
/// place it is in. `reference` is the member that changes are counted from, null if there is none. `last` is
/// where a schedule's curve ends.
WidgetOutcome field_widget(const FieldRow& row, void* member, const void* reference, double last);

/// "°", "m": what a unit is written as beside a number; empty where only the tooltip can hold it.
std::string short_unit(const FieldInfo& info);

}  // namespace ramify
