#include <fmt/format.h>

#include "cli/experiment/compare_report.h"
#include "cli/text.h"

namespace ramify::cli {
namespace {

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}

/// What a tree is called: its subject, and its seed where it has one.
std::string tree_cells(const CompareResults& results, std::size_t subject, std::size_t sample) {
  const std::uint64_t seed = results.subjects[subject].samples[sample].seed;
  const bool has_seed = !results.configs[subject].empty();
  return csv_cell(results.subjects[subject].label) + "," + (has_seed ? std::to_string(seed) : "");
}

DataTable metrics_table(const CompareResults& results) {
  std::string text = "input,seed";
  for (const MetricInfo& info : metric_table()) text += fmt::format(",{}", info.key);
  text += '\n';
  for (std::size_t i = 0; i < results.subjects.size(); ++i) {
    for (std::size_t k = 0; k < results.subjects[i].samples.size(); ++k) {
      text += tree_cells(results, i, k);
      for (const MetricInfo& info : metric_table()) {
        text += "," + cell(info.value(results.subjects[i].samples[k].metrics));
      }
      text += '\n';
    }
  }
  return {"metrics.csv", text};
}

DataTable orders_table(const CompareResults& results) {
  std::string text = "input,seed,order,axes,length,volume,angle_mean,angle_median,tortuosity_mean\n";
  for (std::size_t i = 0; i < results.subjects.size(); ++i) {
    for (std::size_t k = 0; k < results.subjects[i].samples.size(); ++k) {
      for (const OrderMetrics& own : results.subjects[i].samples[k].metrics.by_order) {
        text += fmt::format("{},{},{},{},{},{},{},{}\n", tree_cells(results, i, k), own.order, own.axes,
                            own.length, own.volume, cell(own.angle_mean_deg), cell(own.angle_median_deg),
                            cell(own.tortuosity_mean));
      }
    }
  }
  return {"orders.csv", text};
}

/// Means and deviations a subject; the spread, the difference and its factor.
DataTable spread_table(const CompareResults& results) {
  std::string text = "metric,unit";
  for (const Subject& subject : results.subjects) {
    text += "," + csv_cell(subject.label + " mean") + "," + csv_cell(subject.label + " deviation");
  }
  text += ",spread,difference,difference_over_spread\n";
  for (const MetricComparison& metric : results.metrics) {
    text += fmt::format("{},{}", metric.info->key, metric.info->unit);
    for (std::size_t i = 0; i < results.subjects.size(); ++i) {
      text += "," + cell(metric.mean[i]) + "," + cell(metric.deviation[i]);
    }
    text += "," + cell(metric.spread) + "," + cell(metric.difference) + "," + cell(metric.factor) + "\n";
  }
  return {"spread.csv", text};
}

DataTable distances_table(const CompareResults& results) {
  std::string text = "input_a,seed_a,input_b,seed_b";
  for (const DistanceInfo& info : distance_table()) text += fmt::format(",{}", info.key);
  text += '\n';
  for (const PairDistance& pair : results.pairs) {
    text += tree_cells(results, pair.subject_a, pair.sample_a) + "," +
            tree_cells(results, pair.subject_b, pair.sample_b);
    for (const double value : pair.values) text += fmt::format(",{}", value);
    text += '\n';
  }
  return {"distances.csv", text};
}

DataTable distributions_table(const CompareResults& results) {
  std::string text = "plot,input,x,y\n";
  for (const DistributionPlot& distribution : results.plots) {
    for (const Series& series : distribution.plot.series) {
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        text += fmt::format("{},{},{},{}\n", distribution.plot.name, csv_cell(series.label), series.x[i],
                            series.y[i]);
      }
    }
  }
  return {"distributions.csv", text};
}

}  // namespace

std::vector<DataTable> compare_tables(const CompareResults& results) {
  return {metrics_table(results), orders_table(results), spread_table(results), distances_table(results),
          distributions_table(results)};
}

}  // namespace ramify::cli
