// All parameters of a tree as widgets, made from its tables alone: the panel knows no engine and no key.
#pragma once

#include <string>

#include "common/config/field.h"
#include "common/config/job.h"
#include "viewer/field_widget.h"
#include "viewer/widget_report.h"

namespace ramify {

struct Panel {
  Job defaults;        // grows items where it is compared with lists; only its values count
  std::string filter;  // only parameters that have it in their key or meaning are shown
  double last_step = 1.0;
  std::string fresh = {};  // key of the item that was added last: it is open
};

/// Widgets for what stands in `table` of `job`. A parameter that differs from `opened` is marked; a click on
/// the mark takes it back, a right click on its name offers the default. All three are of one engine.
WidgetOutcome parameter_rows(const Table& table, Job& job, const Job& opened, Panel& panel,
                             WidgetReport& report);

}  // namespace ramify
