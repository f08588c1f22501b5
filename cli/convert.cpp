#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/flags.h"
#include "cli/text.h"
#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/format/embedded_config.h"
#include "common/format/skeleton_files.h"

namespace ramify::cli {
namespace {

struct ConvertFlags {
  std::string input;
  std::string output;
  std::string qsm;
  SkeletonReading reading;
  bool is_quiet = false;
};

SkeletonForm form_of(const ConvertFlags& flags) {
  const std::optional<SkeletonForm> form = skeleton_form(flags.output);
  if (!form) {
    throw InputError(fmt::format("{}: not written by convert (.csv, .skel.ply, .swc, .mtg)", flags.output));
  }
  if (flags.qsm.empty()) return *form;
  if (flags.qsm != "simpleforest") throw InputError(fmt::format("--qsm: '{}' (simpleforest)", flags.qsm));
  if (form != SkeletonForm::table) {
    throw InputError(fmt::format("--qsm: {}: SimpleForest's table ends in .csv", flags.output));
  }
  return SkeletonForm::simpleforest;
}

void require_skeleton(const std::string& input) {
  if (is_skeleton_file(input)) return;
  if (may_embed_config(input)) {
    throw InputError(
        fmt::format("{0}: a mesh, it holds no skeleton; if ramify made it, `ramify generate {0} -o tree.csv` "
                    "makes its tree "
                    "again",
                    input));
  }
  throw InputError(fmt::format("{}: no skeleton file ({})", input, skeleton_endings()));
}

void convert(const ConvertFlags& flags) {
  require_skeleton(flags.input);
  const SkeletonForm form = form_of(flags);
  require_writable(flags.output);
  const SkeletonFile file = read_skeleton(flags.input, flags.reading);
  if (!flags.is_quiet) note(file.notes);
  const std::vector<std::string> lost = left_out(file.skeleton, form);
  if (!lost.empty() && !flags.is_quiet) {
    note({fmt::format("{}: this form does not carry, left out: {}", flags.output, fmt::join(lost, ", "))});
  }

  OutputFiles files;
  write_skeleton(file.skeleton, form, file.provenance, files.add(flags.output));
  files.commit();
  if (!flags.is_quiet) {
    fmt::print("{}  {} internodes, {} axes\n", flags.output, grouped(file.skeleton.internode_count()),
               grouped(file.skeleton.axis_count()));
  }
}

}  // namespace

void add_convert(CLI::App& program) {
  auto flags = std::make_shared<ConvertFlags>();
  CLI::App* command =
      program.add_subcommand("convert", "From one skeleton file to another, by their endings");
  command->add_option("input", flags->input, "Skeleton to read (" + skeleton_endings() + ")")
      ->type_name("IN")
      ->required();
  command->add_option("output", flags->output, "Skeleton to write (.csv, .skel.ply, .swc, .mtg)")
      ->type_name("OUT")
      ->required();
  command
      ->add_option("--qsm", flags->qsm,
                   "Write a .csv as the table of cylinders of this program: simpleforest")
      ->type_name("PROGRAM");
  add_up_flag(*command, flags->reading);
  command->add_flag("--quiet", flags->is_quiet, "No notes, no summary");
  command->callback([flags] { convert(*flags); });
}

}  // namespace ramify::cli
