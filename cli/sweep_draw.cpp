#include <unistd.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/experiment/process.h"
#include "cli/experiment/run_picture.h"
#include "cli/experiment/sweep_folder.h"
#include "cli/experiment/sweep_plan.h"
#include "cli/flags.h"
#include "common/base/errors.h"
#include "common/base/parallel.h"
#include "viewer/camera.h"

namespace ramify::cli {
namespace {

struct SweepDrawFlags {
  std::string folder;
  std::string low;
  std::string high;
  int side = 0;
  RunFlags running;
};

PictureFrame frame_of(const SweepDrawFlags& flags) {
  const std::optional<Vec3> low = parse_point(flags.low);
  const std::optional<Vec3> high = parse_point(flags.high);
  if (!low || !high) throw InputError("--low, --high: corners of a box, X,Y,Z in metres");
  return {{*low, *high}, flags.side};
}

/// The next line of the list on stdin. Other processes read the same open file: each read moves on for all of
/// them, so every line goes to one. Nothing at its end.
std::optional<std::string> next_name() {
  std::string line(kRunNameLength + 1, '\0');
  const ssize_t count = read(STDIN_FILENO, line.data(), line.size());
  if (count != static_cast<ssize_t>(line.size())) return std::nullopt;
  line.pop_back();
  return line;
}

void sweep_draw(const SweepDrawFlags& flags, const Session& session) {
  end_with_parent();
  const ThreadLimit limit(flags.running.threads);
  // Where Mesa draws in software, it draws in this thread, too. Does not replace a value.
  if (flags.running.threads == 1) setenv("LP_NUM_THREADS", "0", 0);
  const SweepFolder folder(flags.folder);
  Studio studio(frame_of(flags));
  while (const std::optional<std::string> name = next_name()) {
    folder.write(picture_name(*name), studio.draw(folder.runs() / *name, session.registry));
    if (session.stop.stop_requested()) throw Interrupted{"what is drawn is kept"};
  }
}

}  // namespace

void add_sweep_draw(CLI::App& program, const Session& session) {
  auto flags = std::make_shared<SweepDrawFlags>();
  CLI::App* command = program.add_subcommand("sweep-draw", "Pictures of a sweep's runs, named on stdin");
  command->group("");  // for sweep alone
  command->add_option("-o,--output", flags->folder)->required();
  command->add_option("--low", flags->low)->required();
  command->add_option("--high", flags->high)->required();
  command->add_option("--side", flags->side)->required()->check(CLI::PositiveNumber);
  flags->running.add_to(*command);
  command->callback([flags, &session] { sweep_draw(*flags, session); });
}

}  // namespace ramify::cli
