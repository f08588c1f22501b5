#include "cli/experiment/sweep_results.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/text.h"
#include "common/analysis/metrics.h"

namespace ramify::cli {

std::size_t SweepResults::count_done() const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const SweepRow& row) { return row.record.has_value(); }));
}

std::size_t SweepResults::count_failed() const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const SweepRow& row) { return !row.failure.empty(); }));
}

SweepResults gather(const SweepPlan& plan, const std::filesystem::path& runs) {
  SweepResults results{plan, {}};
  for (const PlannedRun& run : plan.runs) {
    SweepRow row{read_run(runs, run.name, run.config), {}};
    if (!row.record) row.failure = read_failure(runs, run.name).value_or("");
    results.rows.push_back(std::move(row));
  }
  return results;
}

std::vector<std::size_t> unfinished(const SweepResults& results) {
  std::vector<std::size_t> runs;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    if (!results.rows[i].record) runs.push_back(i);
  }
  return runs;
}

std::string status_of(const SweepRow& row) {
  if (row.record) return "done";
  return row.failure.empty() ? "missing" : "failed";
}

std::string message_of(const SweepRow& row) {
  return row.record ? fmt::format("{}", fmt::join(row.record->warnings, "; ")) : row.failure;
}

std::string results_csv(const SweepResults& results) {
  std::string text = "run";
  for (const std::string& key : results.plan.keys) text += "," + csv_cell(key);
  for (const MetricInfo& info : metric_table()) text += fmt::format(",{}", info.key);
  text += ",seconds,peak_memory_bytes,status,message\n";
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const SweepRow& row = results.rows[i];
    text += results.plan.runs[i].name;
    for (const std::string& value : results.plan.runs[i].values) text += "," + csv_cell(value);
    for (std::size_t k = 0; k < metric_table().size(); ++k) {
      const std::optional<double> value = row.record ? row.record->metrics[k] : std::nullopt;
      text += value ? fmt::format(",{}", *value) : ",";
    }
    text += row.record ? fmt::format(",{:.3f},{}", row.record->seconds, row.record->peak_memory_bytes) : ",,";
    text += fmt::format(",{},{}\n", status_of(row), csv_cell(message_of(row)));
  }
  return text;
}

}  // namespace ramify::cli
