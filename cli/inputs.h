// What commands that show trees can be given: a config or preset, a skeleton file, a mesh.
#pragma once

#include <optional>
#include <string>

#include "cli/commands.h"
#include "cli/flags.h"
#include "common/format/skeleton_files.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/skeleton.h"

namespace ramify::cli {

/// A tree from anywhere; a mesh that was read has no skeleton.
struct Tree {
  std::optional<Skeleton> skeleton;
  Mesh mesh;
  Mesh obstacles = {};  // of a config
};

struct InputFlags {
  std::optional<std::uint32_t> at_step;
  SkeletonReading skeleton;  // of skeleton files only
  ConfigFlags configuring;   // of configs only
  RunFlags running;
};

/// A skeleton and how its config wants it dressed.
struct Grown {
  Skeleton skeleton;
  Looks looks = {};
  std::uint64_t seed = 0;
  Mesh obstacles = {};
};

/// What is alive after `step`, or at the end. Throws InputError if a step is asked for and `input` has none.
Skeleton living_at(const Skeleton& skeleton, std::optional<std::uint32_t> step, const std::string& input);

/// Whether the input is a preset's name or a config file: what no other ending tells of.
bool is_config(const std::string& input);

/// The skeleton of a config, a skeleton file or, made again from the config inside, a mesh of ramify's;
/// `with_history`: and all that was ever shed, where the input knows. Whatever step flags.at_step asks for.
/// Throws InputError for other meshes, and for flags that do not go with the kind of input.
Grown read_grown(const std::string& input, const InputFlags& flags, bool with_history,
                 const Session& session);

/// What of read_grown() is alive at the step asked for.
Skeleton read_living(const std::string& input, const InputFlags& flags, const Session& session);

/// Reads, or makes, one tree. A mesh is shown as it is in its file, unless flags ask for another tree of its
/// config. Throws InputError for flags that do not go with the kind of input.
Tree read_tree(const std::string& input, const InputFlags& flags, const Session& session);

}  // namespace ramify::cli
