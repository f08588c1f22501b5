#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
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
  std::string style = "lit";
  std::string color_by;
  std::string background;
  int at_step = -1;
  int columns = 0;  // 0: all in one row
  bool with_scale = false;
  InputFlags reading;
};

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

void render(RenderFlags flags, const Session& session) {
  if (std::filesystem::path(flags.output).extension() != ".png") {
    throw InputError(fmt::format("{}: a picture ends in .png", flags.output));
  }
  require_writable(flags.output);
  const RenderOptions options = options_of(flags);
  if (flags.at_step >= 0) flags.reading.at_step = static_cast<std::uint32_t>(flags.at_step);

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
  const std::size_t columns = flags.columns > 0 ? static_cast<std::size_t>(flags.columns) : images.size();
  const Image picture = contact_sheet(images, columns);
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

}  // namespace

void add_render(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* command = program.add_subcommand("render", "Draw a picture, without window or display");
  command
      ->add_option("input", flags->inputs,
                   "A preset or TOML file, a skeleton (" + skeleton_endings() +
                       ") or a mesh (.glb, .gltf); several stand side by side")
      ->type_name("INPUT")
      ->required();
  command->add_option("-o,--output", flags->output, "Picture to write")->type_name("PNG")->required();
  command->add_option("--size", flags->size, "Pixels, of each input's picture")
      ->type_name("WxH")
      ->capture_default_str();
  command->add_option("--view", flags->view, "front, side, top, or azimuth and elevation in degrees")
      ->type_name("VIEW")
      ->capture_default_str();
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
  add_up_flag(*command, flags->reading.skeleton);
  flags->reading.configuring.add_to(*command);
  flags->reading.running.add_to(*command);
  command->callback([flags, &session] { render(*flags, session); });
}

}  // namespace ramify::cli
