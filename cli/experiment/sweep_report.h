// The report of `ramify sweep`: pictures with their configs, figures over the keys that vary, a table.
#pragma once

#include <string>
#include <vector>

#include "cli/experiment/sweep_figures.h"
#include "cli/experiment/sweep_results.h"

namespace ramify::cli {

/// Everything that the report shows.
struct SweepFindings {
  SweepResults results;
  Responses responses;
  std::vector<std::string> pictures;  // PNG, one a run; empty where there is none
  int picture_side = 0;               // pixels
  std::size_t picture_columns = 1;    // that stand side by side on the contact sheet
  std::vector<std::string>
      figure_svgs;  // one a response; none where there is no gnuplot or nothing to draw over
  bool has_gnuplot = false;
  std::vector<std::string> notes;  // what a reader should know, a sentence each
};

/// One paragraph: what was varied, how many runs there are, what changes most.
std::string sweep_in_words(const SweepFindings& findings);

/// The page, one HTML file.
std::string sweep_report(const SweepFindings& findings);

}  // namespace ramify::cli
