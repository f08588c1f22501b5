#include "cli/experiment/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/experiment/html.h"
#include "cli/text.h"

namespace ramify::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// A subject's name with the colour that plots give it.
std::string keyed(const CompareResults& results, std::size_t subject) {
  return fmt::format("<span class=\"key\" style=\"background:{}\"></span>{}", series_color(subject),
                     html_text(results.subjects[subject].label));
}

std::string title_of(const CompareResults& results) {
  std::string title;
  for (std::size_t i = 0; i < results.subjects.size(); ++i) {
    const bool is_last = i + 1 == results.subjects.size();
    title += (i == 0 ? "" : (is_last ? " and " : ", ")) + results.subjects[i].label;
  }
  return title + " compared";
}

Section pictures_section(const CompareResults& results) {
  std::string content =
      "<p>All at one scale, roots at the same place. The command under a picture draws that tree alone, as "
      "large as "
      "it fits.</p>\n";
  for (std::size_t i = 0; i < results.subjects.size(); ++i) {
    content += "<div class=\"figures\">\n";
    for (const TreePicture& picture : results.pictures) {
      if (picture.subject != i) continue;
      const std::string alternative = fmt::format("{}, {} view", results.subjects[i].label, picture.view);
      content += figure({"image/png", picture.png, alternative}, keyed(results, i) + ", " + picture.view,
                        picture.command);
    }
    content += "</div>\n";
  }
  return {"pictures", "Pictures", content};
}

/// Four digits, or a whole number.
std::string value_number(double value) {
  return std::abs(value) < 1000.0 ? fmt::format("{:.4g}", value) : short_number(value);
}

/// Two digits, or a whole number.
std::string deviation_number(double value) {
  return value < 99.5 ? fmt::format("{:.2g}", value) : short_number(std::round(value));
}

std::string value_text(const MetricComparison& metric, std::size_t subject) {
  if (!metric.mean[subject]) return "-";
  const bool is_whole = metric.info->is_count && !metric.deviation[subject];
  const std::string mean =
      is_whole ? metric_text(*metric.info, metric.mean[subject]) : value_number(*metric.mean[subject]);
  return metric.deviation[subject]
             ? fmt::format("{} &#177; {}", mean, deviation_number(*metric.deviation[subject]))
             : mean;
}

Section metrics_section(const CompareResults& results) {
  Rows rows = {{"metric"}};
  for (std::size_t i = 0; i < results.subjects.size(); ++i) rows[0].push_back(keyed(results, i));
  rows[0].insert(rows[0].end(), {"unit", "difference", "over spread", "real trees"});
  for (const MetricComparison& metric : results.metrics) {
    std::vector<std::string> row = {std::string(metric.info->key)};
    for (std::size_t i = 0; i < results.subjects.size(); ++i) row.push_back(value_text(metric, i));
    row.push_back(html_text(metric.info->unit));
    row.push_back(metric.difference ? short_number(*metric.difference) : "-");
    const std::string factor = metric.factor ? html_text(factor_text(*metric.factor, false)) : "-";
    row.push_back(metric.factor.value_or(0.0) > 1.0 ? "<mark>" + factor + "</mark>" : factor);
    row.push_back(html_text(metric.info->reference));
    rows.push_back(std::move(row));
  }
  Rows meanings = {{"metric", "meaning"}};
  for (const MetricInfo& info : metric_table())
    meanings.push_back({std::string(info.key), html_text(info.help)});
  return {"metrics", "Metrics",
          table("Means, with the standard deviation between seeds where there are several. The spread is the "
                "root mean "
                "square of these deviations; differences that exceed it are marked.",
                rows, true) +
              foldable("What the metrics mean", table("In short", meanings, true))};
}

Section distances_section(const CompareResults& results) {
  std::string content =
      "<p>A distance is 0 for identical trees. On the diagonal: the mean between two seeds of one input. In "
      "brackets: "
      "how many times that within both inputs.</p>\n<div class=\"tables\">\n";
  for (std::size_t k = 0; k < kDistanceCount; ++k) {
    const DistanceInfo& info = distance_table()[k];
    Rows rows = {{std::string(info.key)}};
    for (std::size_t b = 0; b < results.subjects.size(); ++b) rows[0].push_back(keyed(results, b));
    for (std::size_t a = 0; a < results.subjects.size(); ++a) {
      rows.push_back({keyed(results, a)});
      for (std::size_t b = 0; b < results.subjects.size(); ++b) {
        const auto distance = mean_distance(results.pairs, k, a, b);
        std::string text = distance ? fmt::format("{:.3f}", *distance) : "-";
        const auto ratio = a == b ? std::nullopt : between_over_within(results.pairs, k, a, b);
        if (ratio) text += fmt::format(" ({:.1f})", *ratio);
        rows.back().push_back(text);
      }
    }
    content += table(fmt::format("{}: {}", info.key, info.help), rows);
  }
  return {"distances", "Distances", content + "</div>\n"};
}

std::string plot_table(const CompareResults& results, const Plot& plot) {
  Rows rows = {{html_text(plot.x_label)}};
  std::vector<double> places;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    rows[0].push_back(keyed(results, i));
    places.insert(places.end(), plot.series[i].x.begin(), plot.series[i].x.end());
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const double place : places) {
    rows.push_back({fmt::format("{:.4g}", place)});
    for (const Series& series : plot.series) {
      const auto at = std::find(series.x.begin(), series.x.end(), place);
      const bool has_value = at != series.x.end();
      rows.back().push_back(
          has_value ? fmt::format("{:.3g}", series.y[static_cast<std::size_t>(at - series.x.begin())]) : "-");
    }
  }
  return table(plot.y_label, rows);
}

Section distributions_section(const CompareResults& results) {
  const bool has_plots = !results.plot_svgs.empty();
  std::string content = has_plots
                            ? "<p>All trees of an input together.</p>\n"
                            : "<p>gnuplot is not installed, so there are no plots: the tables have their "
                              "numbers. (Debian: <code>apt install gnuplot-nox</code>.)</p>\n";
  content += "<div class=\"plots\">\n";
  for (std::size_t i = 0; i < results.plots.size(); ++i) {
    const DistributionPlot& distribution = results.plots[i];
    std::string words;
    for (std::size_t k = 0; k < results.subjects.size(); ++k) {
      words +=
          fmt::format("{}{}: {}", k == 0 ? "" : "; ", results.subjects[k].label, distribution.summaries[k]);
    }
    const std::string caption =
        fmt::format("<strong>{}.</strong> {}.", html_text(distribution.heading), html_text(words));
    const std::string numbers = plot_table(results, distribution.plot);
    content += "<div>";
    if (has_plots) {
      content +=
          figure({"image/svg+xml", results.plot_svgs[i], distribution.heading + ". " + words + ".", 640, 400},
                 caption, results.command) +
          foldable("Numbers", numbers);
    } else {
      content += "<p>" + caption + "</p>" + numbers;
    }
    content += "</div>\n";
  }
  return {"distributions", "Distributions", content + "</div>\n"};
}

Section method_section(const CompareResults& results) {
  std::string content = fmt::format(
      "<p>This report and the files beside it were made by</p>\n<pre>{}</pre>\n", html_text(results.command));
  Rows rows = {{"input", "trees", "seeds"}};
  for (std::size_t i = 0; i < results.subjects.size(); ++i) {
    const std::vector<Sample>& samples = results.subjects[i].samples;
    const std::string seeds =
        results.configs[i].empty()
            ? "from a file"
            : (samples.size() == 1 ? std::to_string(samples.front().seed)
                                   : fmt::format("{} to {}", samples.front().seed, samples.back().seed));
    rows.push_back({keyed(results, i), std::to_string(samples.size()), seeds});
  }
  content += table("Trees", rows);
  for (std::size_t i = 0; i < results.subjects.size(); ++i) {
    if (results.configs[i].empty()) continue;
    content += foldable("Config of " + results.subjects[i].label,
                        fmt::format("<pre tabindex=\"0\">{}</pre>", html_text(results.configs[i])));
  }
  return {"method", "How this was made", content};
}

}  // namespace

std::string compare_report(const CompareResults& results) {
  std::string opening = fmt::format("<p>{}</p>\n", html_text(differences_in_words(results)));
  for (const std::string& note : results.notes) opening += fmt::format("<p>{}</p>\n", html_text(note));
  return page(title_of(results), opening,
              {pictures_section(results), metrics_section(results), distances_section(results),
               distributions_section(results), method_section(results)});
}

}  // namespace ramify::cli
