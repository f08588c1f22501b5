#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/outputs.h"
#include "common/base/errors.h"
#include "common/format/embedded_config.h"
#include "common/format/skeleton_files.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"
#include "viewer/view.h"

namespace ramify::cli {
namespace {

struct ViewFlags {
  std::vector<std::string> inputs;
  std::string size;  // empty: as it was left
  bool is_driven = false;
  ConfigFlags configuring;
};

/// The config of a mesh that ramify made; nothing for one of others.
std::optional<Job> embedded_job(const std::string& input, const Session& session) {
  if (is_config(input) || !may_embed_config(input)) return std::nullopt;
  try {
    embedded_config(input);
  } catch (const InputError&) {
    return std::nullopt;
  }
  return load_job(session.registry, input);
}

Opened open(const std::string& input, const ViewFlags& flags, const Session& session) {
  Opened opened{.input = input, .job = {}, .tree = {}, .mesh = {}};
  if (is_config(input)) {
    // What is opened later comes as it is.
    const bool is_told = std::find(flags.inputs.begin(), flags.inputs.end(), input) != flags.inputs.end();
    opened.job =
        load_job(session.registry, input, is_told ? flags.configuring.overrides() : std::vector<Override>());
  } else if (is_skeleton_file(input)) {
    SkeletonFile file = read_skeleton(input);
    auto run = std::make_shared<RunResult>();
    run->skeleton = std::move(file.skeleton);
    run->report.warnings = std::move(file.notes);
    opened.tree = std::move(run);
  } else {
    opened.job = embedded_job(input, session);
    if (!opened.job) opened.mesh = read_tree(input, {}, session).mesh;
  }
  return opened;
}

/// A layer that the tree on show was made without is made with it anew.
void write(const Export& wanted) {
  const Output output = output_of(wanted.path.string());
  for (const std::filesystem::path& file : output.files()) require_writable(file);
  RunResult run = *wanted.run;
  if (!output.layer().empty()) {
    RunContext context;
    context.layers = {output.layer()};
    run = wanted.job.run(context);
    if (run.layers.empty()) {
      throw InputError(fmt::format("{}: {} with this config makes no {}", wanted.path.string(),
                                   wanted.job.engine->name, output.layer()));
    }
  } else {
    run.skeleton = wanted.skeleton;
  }
  const TreeMesh tree =
      output.needs_mesh() ? make_tree_mesh(run.skeleton, wanted.job.looks(), wanted.job.seed()) : TreeMesh();
  OutputFiles files;
  write_output(output, {wanted.job, run, tree}, files);
  files.commit();
}

void run(ViewFlags flags, const Session& session) {
  const bool is_bare = flags.inputs.empty();
  if (is_bare) flags.inputs = {"s4-fig6", "xm12-fig5"};
  ViewOptions options{.inputs = flags.inputs, .shows_gallery = is_bare, .is_driven = flags.is_driven};
  int used = 0;
  const bool is_size =
      std::sscanf(flags.size.c_str(), "%5dx%5d%n", &options.width, &options.height, &used) == 2 &&
      used == static_cast<int>(flags.size.size());
  if (!flags.size.empty() && (!is_size || options.width < 1 || options.height < 1 || options.width > 32'768 ||
                              options.height > 32'768)) {
    throw InputError(fmt::format("--size: '{}' is no WxH (1x1 to 32768x32768)", flags.size));
  }
  const ViewServices services{.registry = session.registry,
                              .open = [&](const std::string& input) { return open(input, flags, session); },
                              .write = write,
                              .stop = session.stop,
                              .endings = known_endings()};
  view(services, options);
  if (session.stop.stop_requested()) throw Interrupted();
}

}  // namespace

void add_view(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<ViewFlags>();
  CLI::App* command =
      program.add_subcommand("view", "Open the window: two trees side by side, live parameters");
  command
      ->add_option("input", flags->inputs,
                   "A preset or TOML file, a skeleton table or a mesh; two stand side by side")
      ->type_name("INPUT")
      ->expected(0, 2);
  command->add_option("--size", flags->size, "Width and height of the window; without, as it was left")
      ->type_name("WxH");
  command->add_flag("--driven", flags->is_driven,
                    "For tests: print where the widgets are and what is done, check every OpenGL call");
  flags->configuring.add_to(*command);
  command->callback([flags, &session] { run(*flags, session); });
}

}  // namespace ramify::cli
