// Plots, drawn by gnuplot (http://www.gnuplot.info) where it is installed.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramify::cli {

enum class PlotStyle {
  steps,   // a histogram's outline: x is the middle of a bin
  points,  // points joined by lines
};

/// x and y have the same size.
struct Series {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> deviation = {};  // of y, drawn as bars up and down; of points only, may be empty
};

struct Plot {
  std::string name;  // of its files, without ending
  std::string x_label;
  std::string y_label;
  PlotStyle style = PlotStyle::points;
  double x_low = 0.0;  // what the x axis shows; as the series have it if both are the same
  double x_high = 0.0;
  bool is_x_logarithmic = false;
  bool is_y_logarithmic = false;
  std::vector<Series> series;             // drawn in colours and dashes that tell eight apart
  std::vector<std::string> x_names = {};  // what stands at x = 0, 1, ... in place of numbers; may be empty
};

/// A coloured cell for each pair of values, with its number where there is room.
struct HeatMap {
  std::string name;  // of its files, without ending
  std::string label;
  std::string x_label;
  std::string y_label;
  std::vector<std::string> x_names;           // from left to right
  std::vector<std::string> y_names;           // from the bottom up
  std::vector<std::optional<double>> values;  // row by row: y is the same for a row
};

/// Whether there is a gnuplot to draw with.
bool has_gnuplot();

/// Draws NAME.svg and NAME.png of each plot into `folder`, which is there. The SVG has no background of its
/// own and takes light ink on pages that are dark. So many `processes` share the work; 0: as many as there
/// are cores. Throws RunError with gnuplot's words if it fails.
void draw_plots(std::span<const Plot> plots, const std::filesystem::path& folder, int processes);
void draw_heat_maps(std::span<const HeatMap> maps, const std::filesystem::path& folder, int processes);

/// The colour of the i-th series, "#rrggbb", for legends beside plots (after Okabe and Ito 2008, told apart
/// by the colour-blind too).
std::string series_color(std::size_t index);

}  // namespace ramify::cli
