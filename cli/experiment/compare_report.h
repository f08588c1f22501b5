// The report of `ramify compare`: what differs, in words, pictures, tables and plots.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/experiment/comparison.h"
#include "cli/experiment/distributions.h"

namespace ramify::cli {

/// A picture of a subject's first tree.
struct TreePicture {
  std::size_t subject = 0;
  std::string name;  // of its file, without folder: "s4-fig8-front.png"
  std::string view;  // "front"
  std::string png;   // the file's bytes
  std::string command;
};

/// Everything that the report shows.
struct CompareResults {
  std::string command;             // that made it
  std::vector<std::string> notes;  // what a reader should know, a sentence each
  std::vector<Subject> subjects;
  std::vector<std::string> configs;  // TOML, a subject each; empty for trees from files
  std::vector<MetricComparison> metrics;
  std::vector<PairDistance> pairs;
  std::vector<DistributionPlot> plots;
  std::vector<std::string> plot_svgs;  // one a plot; none without gnuplot
  std::vector<TreePicture> pictures;   // subject by subject, the same views for each
};

/// One paragraph: which metrics differ by more than the spread between seeds, and by how much; how far trees
/// of different inputs are from each other, compared with two seeds of one.
std::string differences_in_words(const CompareResults& results);

/// The page, one HTML file.
std::string compare_report(const CompareResults& results);

/// A table of the results as CSV, and its file's name.
struct DataTable {
  std::string name;
  std::string text;
};

/// Metrics a tree, branch orders a tree, means and spreads a metric, distances a pair of trees,
/// distributions.
std::vector<DataTable> compare_tables(const CompareResults& results);

}  // namespace ramify::cli
