#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/film.h"
#include "cli/inputs.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/image.h"
#include "viewer/renderer.h"

namespace ramify::cli {
namespace {

struct RenderFlags {
  std::vector<std::string> inputs;
  std::string output;
  std::string size = "1024x1024";
  std::string view = "front";
  std::string look_at;  // X,Y,Z; empty: all of the tree
  double across = 0.0;  // metres; 0: kAcross
  std::string style = "lit";
  std::string color_by;
  std::string background;
  int at_step = -1;
  int columns = 0;  // 0: all in one row
  bool with_scale = false;
  FilmOptions film;
  std::optional<double> turn_deg;
  InputFlags reading;

  std::size_t images_a_row() const { return columns > 0 ? static_cast<std::size_t>(columns) : inputs.size(); }
  bool is_film() const { return !film.folder.empty(); }
};

// Metres that a close-up shows where nothing else is asked for.
constexpr double kAcross = 1.0;

std::optional<CloseUp> close_up_of(const RenderFlags& flags) {
  if (flags.look_at.empty()) {
    if (flags.across > 0.0) throw InputError("--across: goes with --look-at");
    return std::nullopt;
  }
  const std::optional<Vec3> point = parse_point(flags.look_at);
  if (!point) throw InputError(fmt::format("--look-at: '{}' (X,Y,Z in metres)", flags.look_at));
  return CloseUp{*point, flags.across > 0.0 ? flags.across : kAcross};
}

RenderStyle style_named(const std::string& name) {
  if (name == "lit") return RenderStyle::lit;
  if (name == "schematic") return RenderStyle::schematic;
  if (name == "skeleton") return RenderStyle::skeleton;
  throw InputError(fmt::format("--style: '{}' (lit | schematic | skeleton)", name));
}

RenderOptions options_of(const RenderFlags& flags) {
  RenderOptions options;
  int used = 0;
  const bool is_size =
      std::sscanf(flags.size.c_str(), "%5dx%5d%n", &options.width, &options.height, &used) == 2 &&
      used == static_cast<int>(flags.size.size());
  if (!is_size || options.width < 16 || options.height < 16 || options.width > 16384 ||
      options.height > 16384) {
    throw InputError(fmt::format("--size: '{}' is no WxH (16x16 to 16384x16384)", flags.size));
  }
  const auto view = parse_view(flags.view);
  if (!view)
    throw InputError(fmt::format("--view: '{}' (front | side | top | AZ,EL in degrees)", flags.view));
  options.view = *view;
  options.close_up = close_up_of(flags);
  options.style = style_named(flags.style);
  options.color_by = flags.color_by;
  options.with_scale = flags.with_scale;
  if (!flags.background.empty()) {
    options.background = parse_color(flags.background);
    if (!options.background) {
      throw InputError(
          fmt::format("--background: '{}' (#rrggbb, a colour's name or transparent)", flags.background));
    }
  }
  return options;
}

/// A picture or a film, and only the flags that go with it.
void check_flags(const RenderFlags& flags) {
  if (flags.is_film() == !flags.output.empty()) {
    throw InputError("render: wants one of -o PNG, for a picture, and --frames DIR, for a film");
  }
  const bool has_film_flags = flags.film.turntable > 0 || flags.turn_deg || flags.film.frames_per_second > 0;
  if (!flags.is_film() && has_film_flags) {
    throw InputError("--turntable, --turn, --fps: go with --frames DIR");
  }
  if (flags.is_film() && flags.film.turntable == 0 && flags.at_step >= 0) {
    throw InputError(
        "--at-step: a film shows all steps (--steps K ends it sooner, --turntable N stays at one)");
  }
  if (!flags.is_film() && std::filesystem::path(flags.output).extension() != ".png") {
    throw InputError(fmt::format("{}: a picture ends in .png", flags.output));
  }
}

void render_film(RenderFlags flags, const RenderOptions& options, const Session& session) {
  flags.film.turn_deg = flags.turn_deg.value_or(flags.film.turntable > 0 ? 360.0 : 0.0);
  const Film film =
      make_film(flags.inputs, flags.reading, options, flags.film, flags.images_a_row(), session);
  const std::string folder = flags.film.folder.string();
  if (flags.reading.running.is_json) {
    nlohmann::ordered_json object = {
        {"frames", film.frame_count}, {"folder", folder},      {"mp4", nullptr},
        {"width", film.width},        {"height", film.height}, {"device", film.device}};
    if (!film.mp4.empty()) object["mp4"] = film.mp4.string();
    fmt::print("{}\n", object.dump());
  } else if (!flags.reading.running.is_quiet) {
    fmt::print("{}  {} frames, {} x {}, drawn by {}\n", folder, film.frame_count, film.width, film.height,
               film.device);
    fmt::print("{}\n", film.mp4.empty() ? "no MP4: " + film.why_no_mp4 : film.mp4.string());
  }
}

void render(RenderFlags flags, const Session& session) {
  check_flags(flags);
  const RenderOptions options = options_of(flags);
  if (flags.at_step >= 0) flags.reading.at_step = static_cast<std::uint32_t>(flags.at_step);
  if (flags.is_film()) {
    render_film(std::move(flags), options, session);
    return;
  }
  require_writable(flags.output);

  Renderer renderer;
  std::vector<Image> images;
  for (const std::string& input : flags.inputs) {
    const Tree tree = read_tree(input, flags.reading, session);
    const Scene scene{.mesh = &tree.mesh,
                      .skeleton = tree.skeleton ? &*tree.skeleton : nullptr,
                      .obstacles = &tree.obstacles};
    images.push_back(renderer.render(scene, options));
    if (session.stop.stop_requested()) throw Interrupted();
  }
  const Image picture = contact_sheet(images, flags.images_a_row());
  OutputFiles files;
  write_png(picture, files.add(flags.output));
  files.commit();

  if (flags.reading.running.is_json) {
    const nlohmann::ordered_json object = {{"outputs", {flags.output}},
                                           {"width", picture.width},
                                           {"height", picture.height},
                                           {"device", renderer.device()}};
    fmt::print("{}\n", object.dump());
  } else if (!flags.reading.running.is_quiet) {
    fmt::print("{}  {} x {}, drawn by {}\n", flags.output, picture.width, picture.height, renderer.device());
  }
}

void add_film_flags(CLI::App& command, RenderFlags& flags) {
  command
      .add_option(
          "--frames", flags.film.folder,
          "Instead of a picture a film: this folder with a picture of each step, or level, and an MP4")
      ->type_name("DIR");
  command
      .add_option("--turntable", flags.film.turntable,
                  "The film turns about the finished trees in so many frames")
      ->type_name("N")
      ->check(CLI::Range(2, 9999));
  command
      .add_option("--turn", flags.turn_deg,
                  "Degrees that the camera turns by in the course of the film; 360 for a turntable, else 0")
      ->type_name("DEG")
      ->check(CLI::Range(-3600.0, 3600.0));
  command
      .add_option("--fps", flags.film.frames_per_second,
                  "Frames a second of the MP4; else it lasts about six seconds")
      ->type_name("N")
      ->check(CLI::Range(1, 120));
}

}  // namespace

void add_render(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* command = program.add_subcommand("render", "Draw a picture or a film, without window or display");
  command
      ->add_option("input", flags->inputs,
                   "A preset or TOML file, a skeleton (" + skeleton_endings() +
                       ") or a mesh (.glb, .gltf); several stand side by side")
      ->type_name("INPUT")
      ->required();
  command->add_option("-o,--output", flags->output, "Picture to write")->type_name("PNG");
  command->add_option("--size", flags->size, "Pixels, of each input's picture")
      ->type_name("WxH")
      ->capture_default_str();
  command->add_option("--view", flags->view, "front, side, top, or azimuth and elevation in degrees")
      ->type_name("VIEW")
      ->capture_default_str();
  command
      ->add_option("--look-at", flags->look_at,
                   "A close-up of this place, metres from the root's origin; else all of the tree")
      ->type_name("X,Y,Z");
  command
      ->add_option("--across", flags->across,
                   fmt::format("Metres that a close-up shows across its shorter side [{:g}]", kAcross))
      ->type_name("METRES")
      ->check(CLI::Range(1e-4, 1e4));
  command->add_option("--style", flags->style, "lit, schematic (black on white) or skeleton (lines)")
      ->type_name("STYLE")
      ->capture_default_str();
  command
      ->add_option("--color-by", flags->color_by, "order, birthStep, level, light, vigour, strahler or width")
      ->type_name("ATTRIBUTE");
  command->add_option("--at-step", flags->at_step, "The tree as it was after step K")
      ->type_name("K")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--background", flags->background, "#rrggbb, a colour's name or transparent")
      ->type_name("COLOR");
  command->add_option("--columns", flags->columns, "Begin a new row after so many inputs")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_flag("--scale", flags->with_scale, "Show a scale bar and a person 1.75 m tall");
  add_film_flags(*command, *flags);
  add_up_flag(*command, flags->reading.skeleton);
  flags->reading.configuring.add_to(*command);
  flags->reading.running.add_to(*command);
  command->callback([flags, &session] { render(*flags, session); });
}

}  // namespace ramify::cli
