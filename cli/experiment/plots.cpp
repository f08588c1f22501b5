#include "cli/experiment/plots.h"

#include <fmt/format.h>

#include <array>

#include "cli/experiment/process.h"
#include "common/base/errors.h"
#include "common/base/files.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array kColors = {"#2a85c7", "#d55e00", "#009e73", "#cc79a7",
                                "#e69f00", "#56b4e9", "#8a6d3b", "#808080"};

// gnuplot's black is what it draws frames and letters with.
constexpr const char* kDarkInk =
    "<style>@media (prefers-color-scheme: dark) {"
    " [color=\"black\"] { color: #d8d8d8 } [fill=\"black\"] { fill: #d8d8d8 }"
    " [stroke=\"black\"] { stroke: #d8d8d8 } }</style>";

/// A string of gnuplot's in single quotes, in which nothing but the quote means anything.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20;
    result += is_control ? " " : (c == '\'' ? "''" : std::string(1, c));
  }
  return result + '\'';
}

std::string data_block(const Series& series, std::size_t index) {
  std::string block = fmt::format("$data{} << END\n", index);
  for (std::size_t i = 0; i < series.x.size(); ++i) block += fmt::format("{} {}\n", series.x[i], series.y[i]);
  return block + "END\n";
}

std::string plot_command(const Plot& plot) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const char* with = plot.style == PlotStyle::steps ? "histeps" : "linespoints pointsize 0.8";
    command += fmt::format("{}$data{} using 1:2 with {} linetype {} linewidth 2 title {}", i > 0 ? ", " : "",
                           i, with, i + 1, quoted(plot.series[i].label));
  }
  return command + "\n";
}

std::string script_of(const Plot& plot, const fs::path& folder) {
  std::string script = "set encoding utf8\n";
  for (std::size_t i = 0; i < kColors.size(); ++i) {
    script += fmt::format("set linetype {} linecolor rgb '{}' dashtype {} pointtype {}\n", i + 1, kColors[i],
                          i % 4 + 1, i + 4);
  }
  for (std::size_t i = 0; i < plot.series.size(); ++i) script += data_block(plot.series[i], i);
  script += fmt::format("set xlabel {}\nset ylabel {}\n", quoted(plot.x_label), quoted(plot.y_label));
  script +=
      "set key outside top center horizontal\nset border 3\nset tics nomirror out\nset "
      "grid linecolor rgb '#909090' dashtype 3\n";
  if (plot.x_low < plot.x_high) script += fmt::format("set xrange [{}:{}]\n", plot.x_low, plot.x_high);
  if (plot.is_x_logarithmic) script += "set logscale x\n";
  if (plot.is_y_logarithmic) script += "set logscale y\n";
  if (plot.style == PlotStyle::steps) script += "set yrange [0:*]\n";
  const std::string terminals[] = {"svg noenhanced dynamic size 640,400 font 'sans-serif,14' name 'plot'",
                                   "pngcairo noenhanced size 1280,800 font 'sans-serif,24' linewidth 2"};
  const char* endings[] = {".svg", ".png"};
  for (int i = 0; i < 2; ++i) {
    script += fmt::format("set terminal {}\nset output {}\n", terminals[i],
                          quoted((folder / (plot.name + endings[i])).string()));
    script += plot_command(plot);
  }
  return script + "set output\n";
}

void rewrite(const fs::path& path, const std::string& bytes) {
  OutputFiles files;
  files.add(path) << bytes;
  files.commit();
}

void add_dark_ink(const fs::path& svg) {
  std::string text = read_file(svg);
  const std::size_t root = text.find("<svg");
  const std::size_t end = root == std::string::npos ? root : text.find('>', root);
  if (end == std::string::npos) throw RunError(fmt::format("gnuplot: no SVG in {}", svg.string()));
  rewrite(svg, text.insert(end + 1, kDarkInk));
}

}  // namespace

std::string series_color(std::size_t index) {
  return kColors[index % kColors.size()];
}

bool has_gnuplot() {
  const auto end = run_process({"gnuplot", "--version"});
  return end && end->code == 0;
}

void draw_plots(std::span<const Plot> plots, const fs::path& folder) {
  for (const Plot& plot : plots) {
    const fs::path script = folder / (plot.name + ".gnuplot");
    rewrite(script, script_of(plot, folder));
    const auto end = run_process({"gnuplot", script.string()});
    fs::remove(script);
    if (!end || end->code != 0) {
      throw RunError(
          fmt::format("gnuplot failed on {}: {}", plot.name, end ? end->errors.substr(0, 300) : "missing"));
    }
    add_dark_ink(folder / (plot.name + ".svg"));
  }
}

}  // namespace ramify::cli
