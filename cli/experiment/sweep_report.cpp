#include "cli/experiment/sweep_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/experiment/html.h"
#include "cli/text.h"

namespace ramify::cli {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string values_text(const std::vector<std::string>& keys, const std::vector<std::string>& values) {
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    text += fmt::format("{}{} = {}", k > 0 ? ", " : "", short_key(keys, k), values[k]);
  }
  return text;
}

/// The flags that make the i-th run's config out of the sweep's.
std::string run_flags(const SweepPlan& plan, std::size_t i) {
  std::string text = plan.flags;
  for (std::size_t k = 0; k < plan.keys.size(); ++k) {
    const std::string& value = plan.runs[i].values[k];
    const bool has_flag = plan.keys[k] == "seed" || plan.keys[k] == "steps";
    text += has_flag ? fmt::format(" --{} {}", plan.keys[k], shell_quoted(value))
                     : " --set " + shell_quoted(plan.keys[k] + "=" + value);
  }
  return text;
}

/// What is said of a key: "growth.lambda (5 values, 0.46 to 0.54)".
std::string key_in_words(const SweepPlan& plan, std::size_t k) {
  std::vector<std::string> values;
  for (const PlannedRun& run : plan.runs) {
    if (std::find(values.begin(), values.end(), run.values[k]) == values.end())
      values.push_back(run.values[k]);
  }
  if (values.size() <= 3) return fmt::format("{} ({})", plan.keys[k], fmt::join(values, ", "));
  return fmt::format("{} ({} values, {} to {})", plan.keys[k], values.size(), values.front(), values.back());
}

/// How far a quantity's values are from each other, against their size; with the points of the extremes.
struct Reach {
  double share = 0.0;
  std::size_t lowest = 0;
  std::size_t highest = 0;
};

Reach reach_of(const Response& response) {
  Reach reach;
  double size = 0.0;
  bool has_value = false;
  for (std::size_t i = 0; i < response.mean.size(); ++i) {
    if (!response.mean[i]) continue;
    if (!has_value) reach.lowest = reach.highest = i;
    has_value = true;
    if (*response.mean[i] < *response.mean[reach.lowest]) reach.lowest = i;
    if (*response.mean[i] > *response.mean[reach.highest]) reach.highest = i;
    size = std::max(size, std::abs(*response.mean[i]));
  }
  if (size > 0.0) reach.share = (*response.mean[reach.highest] - *response.mean[reach.lowest]) / size;
  return reach;
}

/// The metrics that differ most between the points; what the machine takes is none of them.
std::string changes_in_words(const Responses& responses) {
  std::vector<std::pair<Reach, const Response*>> reaches;
  for (const Response& response : responses.responses) {
    const bool is_cost = response.quantity.key == "seconds" || response.quantity.key == "peak_memory";
    if (!is_cost) reaches.emplace_back(reach_of(response), &response);
  }
  if (reaches.empty()) return "No metric changes.";
  std::stable_sort(reaches.begin(), reaches.end(),
                   [](const auto& a, const auto& b) { return a.first.share > b.first.share; });
  std::string words = "What changes most: ";
  for (std::size_t i = 0; i < std::min<std::size_t>(3, reaches.size()); ++i) {
    const auto& [reach, response] = reaches[i];
    const std::string unit = response->quantity.unit.empty() ? "" : " " + response->quantity.unit;
    words += fmt::format("{}{} from {}{} ({}) to {}{} ({})", i > 0 ? "; " : "", response->quantity.key,
                         short_number(*response->mean[reach.lowest]), unit,
                         values_text(responses.keys, responses.points[reach.lowest]),
                         short_number(*response->mean[reach.highest]), unit,
                         values_text(responses.keys, responses.points[reach.highest]));
  }
  return words + ".";
}

/// The grid of pictures: a row a value of the first key, where the page is wide enough for the last one's.
std::string grid_start(const SweepFindings& findings) {
  constexpr std::size_t kMostColumns = 6;
  const bool has_rows = findings.results.plan.keys.size() > 1 && findings.picture_columns <= kMostColumns;
  if (!has_rows) return "<div class=\"figures\">\n";
  return fmt::format(
      "<div class=\"figures\" style=\"grid-template-columns: repeat({}, minmax(0, 15rem))\">\n",
      findings.picture_columns);
}

Section pictures_section(const SweepFindings& findings) {
  const SweepPlan& plan = findings.results.plan;
  std::string content =
      "<p>All at one scale, roots at the same place; a picture leads to its config. The command under a "
      "picture "
      "draws that tree alone, as large as it fits. contact-sheet.png has them all.</p>\n" +
      grid_start(findings);
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    if (findings.pictures[i].empty()) continue;
    const std::string values = values_text(plan.keys, plan.runs[i].values);
    Picture picture{"image/png", findings.pictures[i], "The tree with " + values, findings.picture_side,
                    findings.picture_side};
    picture.link = fmt::format("#config-{}", i + 1);
    const std::string command =
        fmt::format("ramify render {}{} --size {}x{} -o {}.png", shell_quoted(plan.config),
                    run_flags(plan, i), findings.picture_side, findings.picture_side, plan.runs[i].name);
    content += figure(picture, html_text(values), command);
  }
  return {"pictures", "Pictures", content + "</div>\n"};
}

std::string number_text(const std::optional<double>& value) {
  return value ? (std::abs(*value) < 1000.0 ? fmt::format("{:.4g}", *value) : short_number(*value)) : "-";
}

/// The numbers of a figure, one row a point.
std::string response_table(const Responses& responses, const Response& response) {
  Rows rows(1);
  for (const std::string& key : responses.keys) rows[0].push_back(html_text(key));
  rows[0].push_back(html_text(label_of(response.quantity)));
  if (responses.seeds > 1) rows[0].push_back("deviation between seeds");
  for (std::size_t i = 0; i < responses.points.size(); ++i) {
    rows.emplace_back();
    for (const std::string& value : responses.points[i]) rows.back().push_back(html_text(value));
    rows.back().push_back(number_text(response.mean[i]));
    if (responses.seeds > 1) rows.back().push_back(number_text(response.deviation[i]));
  }
  return table(label_of(response.quantity), rows);
}

Section figures_section(const SweepFindings& findings) {
  const Responses& responses = findings.responses;
  std::string content;
  if (!findings.has_gnuplot) {
    content +=
        "<p>gnuplot is not installed, so there are no plots: the tables have their numbers. (Debian: "
        "<code>apt install gnuplot-nox</code>.)</p>\n";
  }
  if (responses.keys.size() > 2) {
    content += fmt::format("<p>{} keys vary, too many for a plot: results.csv has all numbers.</p>\n",
                           responses.keys.size());
    return {"figures", "Figures", content};
  }
  if (responses.seeds > 1) {
    content += fmt::format("<p>Means over {} seeds{}.</p>\n", responses.seeds,
                           responses.keys.size() == 1 ? "; bars show their standard deviation" : "");
  }
  content += "<div class=\"plots\">\n";
  for (std::size_t i = 0; i < responses.responses.size(); ++i) {
    const Response& response = responses.responses[i];
    const std::string numbers = response_table(responses, response);
    content += "<div>";
    if (i < findings.figure_svgs.size()) {
      const std::string caption =
          fmt::format("{} over {}", label_of(response.quantity), fmt::join(responses.keys, " and "));
      content += figure({"image/svg+xml", findings.figure_svgs[i], caption, 640, 400}, html_text(caption),
                        findings.results.plan.command) +
                 foldable("Numbers", numbers);
    } else {
      content += numbers;
    }
    content += "</div>\n";
  }
  return {"figures", "Figures", content + "</div>\n"};
}

Section runs_section(const SweepFindings& findings) {
  const SweepResults& results = findings.results;
  Rows rows = {{"run"}};
  for (const std::string& key : results.plan.keys) rows[0].push_back(html_text(key));
  for (const Quantity& quantity : shown_quantities()) rows[0].push_back(html_text(label_of(quantity)));
  rows[0].push_back("status");
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const SweepRow& row = results.rows[i];
    rows.push_back({fmt::format("<a href=\"#config-{0}\">{0}</a>", i + 1)});
    for (const std::string& value : results.plan.runs[i].values) rows.back().push_back(html_text(value));
    for (const Quantity& quantity : shown_quantities())
      rows.back().push_back(number_text(value_of(row, quantity)));
    const std::string message = message_of(row);
    const std::string status = row.record ? status_of(row) : "<mark>" + status_of(row) + "</mark>";
    rows.back().push_back(message.empty() ? status : status + ": " + html_text(message));
  }
  return {
      "runs", "Runs",
      table("One row a run; a number leads to the run's config. results.csv has all metrics.", rows, true)};
}

Section configs_section(const SweepFindings& findings) {
  const SweepPlan& plan = findings.results.plan;
  std::string content = fmt::format(
      "<p>This report and the files beside it were made by</p>\n<pre>{}</pre>\n<p>The same command goes on "
      "where "
      "it was interrupted and makes no finished run again. A run's folder, runs/NAME, has its complete "
      "config and "
      "its tree.</p>\n",
      html_text(plan.command));
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    content += foldable(
        fmt::format("{}: {}", i + 1, values_text(plan.keys, run.values)),
        fmt::format("<p id=\"config-{}\">runs/{}; the same tree: <code>ramify generate {}{}</code></p>\n<pre "
                    "tabindex=\"0\">{}</pre>",
                    i + 1, run.name, html_text(shell_quoted(plan.config)), html_text(run_flags(plan, i)),
                    html_text(run.config)));
  }
  return {"configs", "Configs, and how this was made", content};
}

}  // namespace

std::string sweep_in_words(const SweepFindings& findings) {
  const SweepResults& results = findings.results;
  std::vector<std::string> keys;
  for (std::size_t k = 0; k < results.plan.keys.size(); ++k) keys.push_back(key_in_words(results.plan, k));
  std::string words =
      fmt::format("{} {} of {}: {}. ", grouped(results.rows.size()),
                  results.rows.size() == 1 ? "run" : "runs", results.plan.config, fmt::join(keys, " by "));
  const std::size_t lacking = results.rows.size() - results.count_done();
  if (lacking > 0) words += fmt::format("{} of them failed; the table of runs says why. ", grouped(lacking));
  return words + changes_in_words(findings.responses);
}

std::string sweep_report(const SweepFindings& findings) {
  std::string opening = fmt::format("<p>{}</p>\n", html_text(sweep_in_words(findings)));
  for (const std::string& note : findings.notes) opening += fmt::format("<p>{}</p>\n", html_text(note));
  return page(
      fmt::format("{} over {}", findings.results.plan.config, fmt::join(findings.results.plan.keys, ", ")),
      opening,
      {pictures_section(findings), figures_section(findings), runs_section(findings),
       configs_section(findings)});
}

}  // namespace ramify::cli
