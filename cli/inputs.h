// What commands that show trees can be given: a config or preset, a skeleton table, a mesh.
#pragma once

#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/flags.h"
#include "common/mesh/mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify::cli {

/// A tree from anywhere; a mesh that was read has no skeleton.
struct Tree {
  std::optional<Skeleton> skeleton;
  Mesh mesh;
};

struct InputFlags {
  std::optional<std::uint32_t> at_step;
  ConfigFlags configuring;  // of configs only
  RunFlags running;
};

/// Whether the input is a preset's name or a config file, by its ending.
bool is_config(const std::string& input);

/// Reads, or makes, one tree. Throws InputError for flags that do not go with the kind of input.
Tree read_tree(const std::string& input, const InputFlags& flags, const Session& session);

}  // namespace ramify::cli
