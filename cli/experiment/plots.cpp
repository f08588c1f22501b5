#include "cli/experiment/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "cli/experiment/process.h"
#include "cli/experiment/process_pool.h"
#include "cli/text.h"
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

// More than it was seen to take.
constexpr std::uint64_t kGnuplotMemory = 64ull << 20;  // bytes

/// What is drawn once for each kind of file.
struct Drawing {
  std::string name;   // of its files, without ending
  std::string setup;  // gnuplot commands before the first file
  std::string plot;   // the command that draws
};

std::string data_block(const Series& series, std::size_t index) {
  std::string block = fmt::format("$data{} << END\n", index);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double deviation = series.deviation.empty() ? 0.0 : series.deviation[i];
    block += fmt::format("{} {} {}\n", series.x[i], series.y[i], deviation);
  }
  return block + "END\n";
}

std::string plot_command(const Plot& plot) {
  std::string command = "plot ";
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const bool has_bars = !plot.series[i].deviation.empty();
    const char* with = plot.style == PlotStyle::steps ? "1:2 with histeps"
                       : has_bars                     ? "1:2:3 with yerrorlines pointsize 0.8"
                                                      : "1:2 with linespoints pointsize 0.8";
    command += fmt::format("{}$data{} using {} linetype {} linewidth 2 title {}", i > 0 ? ", " : "", i, with,
                           i + 1, quoted(plot.series[i].label));
  }
  return command + "\n";
}

/// Names in place of the numbers 0, 1, ... of an axis; of many, some.
std::string named_tics(const char* axis, const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 25;
  const std::size_t every = (names.size() + kMostNames - 1) / kMostNames;
  std::string tics;
  for (std::size_t i = 0; i < names.size(); i += every) {
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", quoted(names[i]), i);
  }
  return fmt::format("set {}tics ({})\n", axis, tics);
}

std::string labels(const std::string& x, const std::string& y) {
  return fmt::format("set xlabel {}\nset ylabel {}\n", quoted(x), quoted(y));
}

Drawing drawing_of(const Plot& plot) {
  std::string setup;
  for (std::size_t i = 0; i < kColors.size(); ++i) {
    setup += fmt::format("set linetype {} linecolor rgb '{}' dashtype {} pointtype {}\n", i + 1, kColors[i],
                         i % 4 + 1, i + 4);
  }
  for (std::size_t i = 0; i < plot.series.size(); ++i) setup += data_block(plot.series[i], i);
  setup += labels(plot.x_label, plot.y_label);
  setup += plot.series.size() > 1 || !plot.series.front().label.empty()
               ? "set key outside top center horizontal\n"
               : "unset key\n";
  setup += "set border 3\nset tics nomirror out\nset grid linecolor rgb '#909090' dashtype 3\n";
  if (plot.x_low < plot.x_high) setup += fmt::format("set xrange [{}:{}]\n", plot.x_low, plot.x_high);
  if (!plot.x_names.empty()) {
    setup += named_tics("x", plot.x_names) + fmt::format("set xrange [-0.5:{}.5]\n", plot.x_names.size() - 1);
  }
  if (plot.is_x_logarithmic) setup += "set logscale x\n";
  if (plot.is_y_logarithmic) setup += "set logscale y\n";
  if (plot.style == PlotStyle::steps) setup += "set yrange [0:*]\n";
  return {plot.name, setup, plot_command(plot)};
}

Drawing drawing_of(const HeatMap& map) {
  std::string cells = "$cells << END\n";
  std::string numbers = "$numbers << END\n";
  const std::size_t columns = map.x_names.size();
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    const auto place = fmt::format("{} {}", i % columns, i / columns);
    const auto& value = map.values[i];
    cells += value ? fmt::format("{} {}\n", place, *value) : fmt::format("{} NaN\n", place);
    numbers += fmt::format("{} {}\n", place, value ? short_number(*value) : "-");
  }
  std::string setup = cells + "END\n" + numbers + "END\n" + labels(map.x_label, map.y_label);
  setup += named_tics("x", map.x_names) + named_tics("y", map.y_names);
  setup += fmt::format("set title {}\nunset key\nset border 3\nset tics nomirror out scale 0\n",
                       quoted(map.label));
  setup +=
      fmt::format("set xrange [-0.5:{}.5]\nset yrange [-0.5:{}.5]\n", columns - 1, map.y_names.size() - 1);
  setup += "set palette defined (0 '#f7fbff', 1 '#c6dbef', 2 '#5fa8d8')\nset cbtics scale 0\n";
  std::string plot = "plot $cells using 1:2:3 with image pixels";
  constexpr std::size_t kMostNumbers = 12;  // side by side
  if (columns <= kMostNumbers && map.y_names.size() <= 2 * kMostNumbers) {
    plot += ", $numbers using 1:2:3 with labels textcolor rgb '#202020'";
  }
  return {map.name, setup, plot + "\n"};
}

std::string script_of(const Drawing& drawing, const fs::path& folder) {
  std::string script = "reset\nset encoding utf8\n" + drawing.setup;
  const std::string terminals[] = {"svg noenhanced dynamic size 640,400 font 'sans-serif,14' name 'plot'",
                                   "pngcairo noenhanced size 1280,800 font 'sans-serif,24' linewidth 2"};
  const char* endings[] = {".svg", ".png"};
  for (int i = 0; i < 2; ++i) {
    script += fmt::format("set terminal {}\nset output {}\n", terminals[i],
                          quoted((folder / (drawing.name + endings[i])).string()));
    script += drawing.plot;
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

Process start_gnuplot(const std::string& script) {
  std::optional<Process> process = Process::start({"gnuplot", "-"}, MemoryFile(script));
  if (!process) throw RunError("gnuplot: is not there any more");
  return std::move(*process);
}

// gnuplot takes as long to start as to draw one of them. It also counts the parts of all SVGs that it draws,
// so who draws what must not depend on the number of processes.
constexpr std::size_t kDrawingsAProcess = 4;

void draw(std::span<const Drawing> drawings, const fs::path& folder, int processes) {
  ProcessPool pool({processes, {}}, kGnuplotMemory);
  std::string failure;
  for (std::size_t first = 0; first < drawings.size(); first += kDrawingsAProcess) {
    const std::size_t count = std::min(kDrawingsAProcess, drawings.size() - first);
    std::string script;
    for (const Drawing& drawing : drawings.subspan(first, count)) script += script_of(drawing, folder);
    pool.add({[script] { return start_gnuplot(script); },
              [&failure](const ProcessEnd& end) {
                if (end.code != 0) failure = end.errors.substr(0, 300);
              }});
  }
  pool.work([](double) {});
  if (!failure.empty()) throw RunError(fmt::format("gnuplot failed: {}", failure));
  for (const Drawing& drawing : drawings) add_dark_ink(folder / (drawing.name + ".svg"));
}

template <class Kind>
void draw_each(std::span<const Kind> kinds, const fs::path& folder, int processes) {
  std::vector<Drawing> drawings;
  for (const Kind& kind : kinds) drawings.push_back(drawing_of(kind));
  draw(drawings, folder, processes);
}

}  // namespace

std::string series_color(std::size_t index) {
  return kColors[index % kColors.size()];
}

bool has_gnuplot() {
  const auto end = run_process({"gnuplot", "--version"});
  return end && end->code == 0;
}

void draw_plots(std::span<const Plot> plots, const fs::path& folder, int processes) {
  draw_each(plots, folder, processes);
}

void draw_heat_maps(std::span<const HeatMap> maps, const fs::path& folder, int processes) {
  draw_each(maps, folder, processes);
}

}  // namespace ramify::cli
