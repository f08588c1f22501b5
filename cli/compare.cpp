#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/commands.h"
#include "cli/experiment/compare_report.h"
#include "cli/experiment/result_folder.h"
#include "cli/inputs.h"
#include "cli/progress_bar.h"
#include "cli/text.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/parallel.h"
#include "common/mesh/obstacle_mesh.h"
#include "common/mesh/tree_mesh.h"
#include "viewer/renderer.h"

namespace ramify::cli {
namespace {

struct CompareFlags {
  std::vector<std::string> inputs;
  std::string folder;
  int at_step = -1;
  int seeds = 1;
  InputFlags reading;
};

/// An input, read and checked but not yet grown.
struct Source {
  std::string input;
  std::optional<Job> job;        // with the first seed; none for a tree from a file
  std::optional<Skeleton> tree;  // from a file
};

constexpr int kPictureSize = 480;  // pixels a side

struct View {
  const char* name;
  const char* flags;  // of `ramify render`
  ViewDirection direction;
  RenderStyle style;
};

constexpr View kViews[] = {
    {"front", "--view front", {0.0, 0.0}, RenderStyle::lit},
    {"side", "--view side", {90.0, 0.0}, RenderStyle::lit},
    {"top", "--view top", {0.0, 90.0}, RenderStyle::lit},
    {"schematic", "--style schematic", {0.0, 0.0}, RenderStyle::schematic},
};

/// The flags that say which trees are compared, as they would be typed.
std::string tree_flags(const CompareFlags& flags, bool is_file) {
  std::string text;
  if (!is_file) {
    for (const Override& given : flags.reading.configuring.overrides()) {
      const std::string value = given.flag == "--set" ? given.key + "=" + given.value : given.value;
      text += fmt::format(" {} {}", given.flag, shell_quoted(value));
    }
  }
  if (is_file && flags.reading.skeleton.up)
    text += *flags.reading.skeleton.up == UpAxis::y ? " --up y" : " --up z";
  if (flags.at_step >= 0) text += fmt::format(" --at-step {}", flags.at_step);
  return text;
}

std::string command_line(const CompareFlags& flags) {
  std::string text = "ramify compare";
  bool has_file = false;
  for (const std::string& input : flags.inputs) {
    text += " " + shell_quoted(input);
    has_file = has_file || is_skeleton_file(input);
  }
  text += tree_flags(flags, false);
  if (has_file && flags.reading.skeleton.up)
    text += *flags.reading.skeleton.up == UpAxis::y ? " --up y" : " --up z";
  if (flags.seeds > 1) text += fmt::format(" --seeds {}", flags.seeds);
  return text + " -o " + shell_quoted(flags.folder);
}

/// Flags of configs and of files are for those among the inputs that they fit; one at least must.
void check_flags(const CompareFlags& flags) {
  if (flags.inputs.size() < 2) {
    throw InputError(fmt::format("compare: {} alone (two inputs or more)", flags.inputs.front()));
  }
  const auto files = std::count_if(flags.inputs.begin(), flags.inputs.end(),
                                   [](const auto& i) { return is_skeleton_file(i); });
  const std::vector<Override> overrides = flags.reading.configuring.overrides();
  if (static_cast<std::size_t>(files) == flags.inputs.size() && !overrides.empty()) {
    throw InputError(fmt::format("{}: no input is a config", overrides.front().flag));
  }
  if (files == 0 && flags.reading.skeleton.up) throw InputError("--up: no input is a skeleton file");
}

Source source_of(const std::string& input, const CompareFlags& flags, const Session& session) {
  Source source{input, {}, std::nullopt};
  if (is_skeleton_file(input)) {
    InputFlags reading = flags.reading;
    reading.configuring = {};
    source.tree = read_living(input, reading, session);
    return source;
  }
  source.job = load_job(session.registry, input, flags.reading.configuring.overrides());
  for (const std::string& warning : source.job->warnings) warn(fmt::format("{}: {}", input, warning));
  return source;
}

/// The source's job with the i-th of its seeds.
Job job_with_seed(const Source& source, int i, const CompareFlags& flags, const Session& session) {
  if (i == 0) return *source.job;
  std::vector<Override> overrides = flags.reading.configuring.overrides();
  const std::uint64_t seed = source.job->seed() + static_cast<std::uint64_t>(i);
  overrides.push_back({"--seeds", "seed", std::to_string(seed)});
  return load_job(session.registry, source.input, overrides);
}

/// File names and presets; numbered where two are alike.
std::vector<std::string> labels_of(const std::vector<std::string>& inputs) {
  std::vector<std::string> labels;
  for (const std::string& input : inputs) {
    const std::string name = std::filesystem::path(input).filename().string();
    std::string label = name;
    for (int i = 2; std::find(labels.begin(), labels.end(), label) != labels.end(); ++i) {
      label = fmt::format("{} ({})", name, i);
    }
    labels.push_back(label);
  }
  return labels;
}

/// What is kept of all trees, and the first tree of each subject for its picture.
struct Grown {
  std::vector<Subject> subjects;
  std::vector<Skeleton> first;
};

/// With the lowest root at the origin.
Skeleton planted(Skeleton skeleton) {
  const Vec3 base = base_of({.mesh = nullptr, .skeleton = &skeleton});
  for (Vec3& position : skeleton.position) position -= base;
  return skeleton;
}

Skeleton grow(const Job& job, const CompareFlags& flags, const Session& session,
              const std::function<void(const Progress&)>& progress) {
  RunContext context;
  context.stop = session.stop;
  context.wants_history = flags.reading.at_step.has_value();
  context.progress = progress;
  RunResult run = job.run(context);
  if (session.stop.stop_requested()) throw Interrupted();
  for (const std::string& warning : run.report.warnings) warn(fmt::format("{}: {}", job.name, warning));
  return living_at(run.skeleton, flags.reading.at_step, job.name);
}

Grown grow_all(const std::vector<Source>& sources, const CompareFlags& flags, const Session& session,
               ProgressBar& bar) {
  double total = 0.0;
  for (const Source& source : sources) total += source.job ? flags.seeds : 1;
  double done = 0.0;
  const auto progress = [&](const Progress& now) {
    const double part = now.total > 0 ? std::clamp(now.done / now.total, 0.0, 1.0) : 0.0;
    bar.show({"growing trees", done + part, total, "tree"});
  };
  const std::vector<std::string> labels = labels_of(flags.inputs);
  Grown grown;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    Subject subject{labels[i], {}};
    if (sources[i].tree) {
      subject.samples.push_back(sample_of(*sources[i].tree, 0));
      grown.first.push_back(planted(*sources[i].tree));
      done += 1.0;
    }
    for (int k = 0; sources[i].job && k < flags.seeds; ++k) {
      const Job job = job_with_seed(sources[i], k, flags, session);
      Skeleton tree = grow(job, flags, session, progress);
      subject.samples.push_back(sample_of(tree, job.seed()));
      if (subject.samples.size() == 1) grown.first.push_back(planted(std::move(tree)));
      done += 1.0;
    }
    grown.subjects.push_back(std::move(subject));
  }
  return grown;
}

/// A label as a part of a file's name.
std::string file_stem(const std::string& label) {
  std::string stem;
  for (const char c : label)
    stem += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '-';
  return stem;
}

std::vector<TreePicture> draw(const std::vector<Source>& sources, const Grown& grown,
                              const CompareFlags& flags, const Session& session, ProgressBar& bar) {
  Renderer renderer;
  std::vector<Mesh> meshes;
  std::vector<Mesh> obstacles;
  std::vector<Vec3f> room;  // for all, so that they have one scale
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::optional<Job>& job = sources[i].job;
    meshes.push_back(
        make_tree_mesh(grown.first[i], job ? job->looks() : Looks{}, job ? job->seed() : 0).mesh);
    obstacles.push_back(job ? obstacle_mesh(*job) : Mesh());
    room.insert(room.end(), meshes.back().positions.begin(), meshes.back().positions.end());
    if (session.stop.stop_requested()) throw Interrupted();
  }
  Box trees;
  for (const Vec3f& point : room) trees.include(Vec3(point));
  for (const Mesh& mesh : obstacles) {
    const Box near = obstacle_room(mesh, trees);
    if (near.is_empty()) continue;
    for (const Vec3& corner : corners(near)) room.emplace_back(corner);
  }
  const std::size_t total = sources.size() * std::size(kViews);
  std::vector<TreePicture> pictures;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (const View& view : kViews) {
      bar.show({"drawing", static_cast<double>(pictures.size()), static_cast<double>(total), "picture"});
      RenderOptions options;
      options.width = options.height = kPictureSize;
      options.view = view.direction;
      options.style = view.style;
      options.room_for = room;
      options.obstacles_take_room = false;
      options.with_scale = view.style == RenderStyle::schematic;
      std::ostringstream png;
      const Scene scene{.mesh = &meshes[i], .skeleton = &grown.first[i], .obstacles = &obstacles[i]};
      write_png(renderer.render(scene, options), png);
      const std::string name =
          fmt::format("{}-{}-{}.png", i + 1, file_stem(grown.subjects[i].label), view.name);
      const bool is_file = !sources[i].job;
      pictures.push_back(
          {i, name, view.name, std::move(png).str(),
           fmt::format("ramify render {}{} {} --size {}x{}{} -o {}", shell_quoted(sources[i].input),
                       tree_flags(flags, is_file), view.flags, kPictureSize, kPictureSize,
                       options.with_scale ? " --scale" : "", name)});
      if (session.stop.stop_requested()) throw Interrupted();
    }
  }
  return pictures;
}

std::vector<std::string> notes_on(const std::vector<Source>& sources, const Grown& grown, int seeds) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (seeds > 1 && !sources[i].job) {
      notes.push_back(fmt::format("{} is a tree from a file: there is one tree of it, whatever --seeds says.",
                                  grown.subjects[i].label));
    }
  }
  return notes;
}

/// Draws the plots beside the report where there is gnuplot, and keeps the SVGs for it.
void draw_distributions(CompareResults& results, ResultFolder& folder, int processes) {
  results.plots = distribution_plots(results.subjects);
  if (!has_gnuplot()) return;
  std::vector<Plot> plots;
  for (const DistributionPlot& distribution : results.plots) plots.push_back(distribution.plot);
  const std::filesystem::path place = folder.staging() / "plots";
  std::filesystem::create_directory(place);
  draw_plots(plots, place, processes);
  for (const Plot& plot : plots) results.plot_svgs.push_back(read_file(place / (plot.name + ".svg")));
}

void print_outcome(const CompareResults& results, const CompareFlags& flags) {
  const std::string report = (std::filesystem::path(flags.folder) / "report.html").string();
  if (flags.reading.running.is_json) {
    nlohmann::ordered_json object = {{"report", report}, {"gnuplot", !results.plot_svgs.empty()}};
    for (const Subject& subject : results.subjects) {
      object["inputs"].push_back({{"input", subject.label}, {"trees", subject.samples.size()}});
    }
    object["distances"] = nlohmann::ordered_json::array();
    for (std::size_t a = 0; a < results.subjects.size(); ++a) {
      for (std::size_t b = a + 1; b < results.subjects.size(); ++b) {
        for (std::size_t k = 0; k < kDistanceCount; ++k) {
          const auto ratio = between_over_within(results.pairs, k, a, b);
          object["distances"].push_back(
              {{"distance", distance_table()[k].key},
               {"a", results.subjects[a].label},
               {"b", results.subjects[b].label},
               {"between", *mean_distance(results.pairs, k, a, b)},
               {"between_over_within", ratio ? nlohmann::ordered_json(*ratio) : nullptr}});
        }
      }
    }
    fmt::print("{}\n", object.dump());
  } else if (!flags.reading.running.is_quiet) {
    fmt::print("{}\n  {}\n", differences_in_words(results), report);
  }
}

void compare(CompareFlags flags, const Session& session) {
  if (flags.at_step >= 0) flags.reading.at_step = static_cast<std::uint32_t>(flags.at_step);
  check_flags(flags);
  const ThreadLimit limit(flags.reading.running.threads);
  std::vector<Source> sources;
  for (const std::string& input : flags.inputs) sources.push_back(source_of(input, flags, session));
  ResultFolder folder(flags.folder, "ramify compare");

  ProgressBar bar(flags.reading.running.is_quiet);
  Grown grown = grow_all(sources, flags, session, bar);
  CompareResults results;
  results.command = command_line(flags);
  results.pictures = draw(sources, grown, flags, session, bar);
  results.notes = notes_on(sources, grown, flags.seeds);
  results.subjects = std::move(grown.subjects);
  for (const Source& source : sources) results.configs.push_back(source.job ? to_toml(*source.job) : "");
  results.metrics = compare_metrics(results.subjects);
  results.pairs = pair_distances(results.subjects, [&](std::size_t done, std::size_t total) {
    bar.show({"distances", static_cast<double>(done), static_cast<double>(total), "pair"});
    if (session.stop.stop_requested()) throw Interrupted();
  });
  draw_distributions(results, folder, flags.reading.running.threads);
  bar.clear();

  for (const TreePicture& picture : results.pictures) folder.write("pictures/" + picture.name, picture.png);
  for (const DataTable& table : compare_tables(results)) folder.write(table.name, table.text);
  folder.write("report.html", compare_report(results));
  if (session.stop.stop_requested()) throw Interrupted();
  folder.commit(results.command);
  if (!flags.reading.running.is_quiet) note(results.notes);
  print_outcome(results, flags);
}

}  // namespace

void add_compare(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<CompareFlags>();
  CLI::App* command = program.add_subcommand(
      "compare", "Set trees against each other: pictures, metrics, distances, one report");
  command
      ->add_option("input", flags->inputs,
                   "Two or more: a preset or TOML file, a skeleton file (" + skeleton_endings() +
                       "), or a mesh that ramify made (.glb, .gltf)")
      ->type_name("INPUT")
      ->required();
  command->add_option("-o,--output", flags->folder, "Folder for report.html, its data, plots and pictures")
      ->type_name("DIR")
      ->required();
  command->add_option("--seeds", flags->seeds, "Make so many trees of each config, with successive seeds")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--at-step", flags->at_step, "The trees as they were after step K")
      ->type_name("K")
      ->check(CLI::NonNegativeNumber);
  add_up_flag(*command, flags->reading.skeleton);
  flags->reading.configuring.add_to(*command);
  flags->reading.running.add_to(*command);
  command->callback([flags, &session] { compare(*flags, session); });
}

}  // namespace ramify::cli
