#include "viewer/commands.h"

#include <algorithm>

#include "viewer/actions.h"
#include "viewer/show_view.h"

namespace ramify {
namespace {

bool has_job(const Workbench& bench) {
  return bench.document().has_job();
}

bool has_two(const Workbench& bench) {
  return bench.seats.size() == 2;
}

Command style_command(const std::string& label, const std::string& key, RenderStyle style) {
  return {.menu = "View",
          .label = label,
          .key = {key},
          .run = [style](Workbench& bench) { bench.show.style = style; },
          .is_on = [style](const Workbench& bench) { return bench.show.style == style; }};
}

Command view_command(const std::string& label, const std::string& key, double azimuth, double elevation) {
  return {.menu = "View", .label = label, .key = {key}, .run = [=](Workbench& bench) {
            look_from(bench, azimuth, elevation);
          }};
}

Command switch_command(const std::string& label, const std::string& key, bool Workbench::*member,
                       std::function<bool(const Workbench&)> is_possible = {}) {
  return {.menu = "View",
          .label = label,
          .key = {key},
          .run = [member](Workbench& bench) { bench.*member = !(bench.*member); },
          .is_possible = std::move(is_possible),
          .is_on = [member](const Workbench& bench) { return bench.*member; }};
}

void ask(Workbench& bench, Prompt prompt) {
  bench.prompt = std::move(prompt);
}

std::vector<Command> file_commands() {
  return {
      {.menu = "File",
       .label = "Open...",
       .key = {"o", true},
       .run =
           [](Workbench& bench) {
             ask(bench, {"Open", "a preset, a config, a skeleton table or a mesh", "", open_input});
           }},
      {.menu = "File",
       .label = "Open beside...",
       .key = {"o", true, true},
       .run =
           [](Workbench& bench) {
             ask(bench, {"Open beside", "stands beside the other tree", "", open_beside});
           }},
      {.menu = "File",
       .label = "Save config...",
       .key = {"s", true},
       .run =
           [](Workbench& bench) {
             const auto& watch = bench.seat().watch;
             const std::string path = watch ? watch->path.string() : bench.document().job().name + ".toml";
             ask(bench, {"Save config", "all parameters, as TOML", path, save_config});
           },
       .is_possible = has_job},
      {.menu = "File",
       .label = "Export...",
       .key = {"e", true},
       .run =
           [](Workbench& bench) {
             ask(bench, {"Export", bench.services.endings, "tree.glb", export_tree});
           },
       .is_possible = [](const Workbench& bench) { return has_job(bench) && !bench.writing.valid(); }},
      {.menu = "File", .label = "Screenshot", .key = {"F12"}, .run = take_screenshot},
      {.menu = "File",
       .label = "Quit",
       .key = {"q", true},
       .run = [](Workbench& bench) { bench.window.close(); }},
  };
}

std::vector<Command> edit_commands() {
  return {
      {.menu = "Edit",
       .label = "Undo",
       .key = {"z", true},
       .run =
           [](Workbench& bench) {
             bench.document().undo(bench.window.last_input());
             bench.last_motion = Window::now();
           },
       .is_possible = [](const Workbench& bench) { return bench.document().can_undo(); }},
      {.menu = "Edit",
       .label = "Redo",
       .key = {"y", true},
       .run =
           [](Workbench& bench) {
             bench.document().redo(bench.window.last_input());
             bench.last_motion = Window::now();
           },
       .is_possible = [](const Workbench& bench) { return bench.document().can_redo(); }},
      {.menu = "Edit",
       .label = "Copy command",
       .key = {"c", true, true},
       .run = copy_command,
       .is_possible = has_job},
      {.menu = "Edit",
       .label = "Change both trees alike",
       .key = {},
       .run = [](Workbench& bench) { bench.are_parameters_linked = !bench.are_parameters_linked; },
       .is_possible =
           [](const Workbench& bench) {
             return has_two(bench) && bench.seats[0]->document.has_job() &&
                    bench.seats[1]->document.has_job() &&
                    bench.seats[0]->document.job().engine == bench.seats[1]->document.job().engine;
           },
       .is_on = [](const Workbench& bench) { return bench.are_parameters_linked; }},
  };
}

std::vector<Command> view_commands() {
  return {
      {.menu = "View", .label = "Frame", .key = {"f"}, .run = frame_trees},
      view_command("Front", "1", 0.0, 0.0),
      view_command("Side", "3", 90.0, 0.0),
      view_command("Top", "7", 0.0, 90.0),
      style_command("Lit", "l", RenderStyle::lit),
      style_command("Schematic", "b", RenderStyle::schematic),
      style_command("Skeleton", "k", RenderStyle::skeleton),
      {.menu = "View",
       .label = "Scale bar and figure",
       .key = {"m"},
       .run =
           [](Workbench& bench) {
             bench.show.with_scale = !bench.show.with_scale;
             frame_trees(bench);
           },
       .is_on = [](const Workbench& bench) { return bench.show.with_scale; }},
      {.menu = "View",
       .label = "Fields as a slice",
       .key = {"v"},
       .run = [](Workbench& bench) { bench.show.are_slices = !bench.show.are_slices; },
       .is_on = [](const Workbench& bench) { return bench.show.are_slices; }},
      switch_command("Link cameras", "c", &Workbench::are_cameras_linked, has_two),
      {.menu = "View",
       .label = "Same scale",
       .key = {"s"},
       .run =
           [](Workbench& bench) {
             bench.is_same_scale = !bench.is_same_scale;
             frame_trees(bench);
           },
       .is_possible = has_two,
       .is_on = [](const Workbench& bench) { return bench.is_same_scale; }},
      switch_command("Gallery of presets", "g", &Workbench::shows_gallery),
      {.menu = "View",
       .label = "Overlay both trees",
       .key = {"o"},
       .run =
           [](Workbench& bench) {
             const bool is_overlaid = bench.show.arrangement == Arrangement::overlaid;
             bench.show.arrangement = is_overlaid ? Arrangement::side_by_side : Arrangement::overlaid;
           },
       .is_possible = has_two,
       .is_on = [](const Workbench& bench) { return bench.show.arrangement == Arrangement::overlaid; }},
  };
}

std::vector<Command> time_commands() {
  return {
      {.menu = "Time", .label = "Play or pause", .key = {"space"}, .run = play_or_pause},
      {.menu = "Time",
       .label = "Step on",
       .key = {"right"},
       .run = [](Workbench& bench) { step_by(bench, 1); }},
      {.menu = "Time",
       .label = "Step back",
       .key = {"left"},
       .run = [](Workbench& bench) { step_by(bench, -1); }},
  };
}

/// F2 is the first overlay.
void switch_overlay_by_key(Workbench& bench, const KeyPress& pressed) {
  const std::vector<std::string> names = overlays_of(bench);
  for (std::size_t index = 0; index < names.size(); ++index) {
    if (pressed.key == "F" + std::to_string(index + 2)) switch_overlay(bench, names[index]);
  }
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> all = [] {
    std::vector<Command> result;
    for (auto group : {file_commands(), edit_commands(), view_commands(), time_commands()}) {
      result.insert(result.end(), group.begin(), group.end());
    }
    result.push_back({.menu = "Help", .label = "Keys", .key = {"h"}, .run = [](Workbench& bench) {
                        bench.shows_help = !bench.shows_help;
                      }});
    return result;
  }();
  return all;
}

std::string key_text(const KeyPress& key) {
  std::string name = key.key;
  if (name.size() == 1) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return (key.with_control ? "Ctrl+" : "") + std::string(key.with_shift ? "Shift+" : "") + name;
}

void obey_keys(Workbench& bench) {
  for (const KeyPress& pressed : bench.window.take_keys()) {
    if (pressed.key == "escape") bench.shows_help = false;
    const auto found = std::find_if(commands().begin(), commands().end(), [&](const Command& command) {
      return command.key.key == pressed.key && command.key.with_control == pressed.with_control &&
             command.key.with_shift == pressed.with_shift;
    });
    if (bench.prompt) continue;
    if (found == commands().end()) {
      switch_overlay_by_key(bench, pressed);
      continue;
    }
    if (!found->is_possible || found->is_possible(bench)) found->run(bench);
  }
}

}  // namespace ramify
