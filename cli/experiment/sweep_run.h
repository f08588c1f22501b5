// The runs of one family, made in this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "cli/commands.h"
#include "common/config/job.h"

namespace ramify::cli {

/// Makes the tree of `job` and writes its folder into `runs`, and one for each of the earlier steps
/// `at_steps`: byte for byte those of runs that end there. Throws what the engine throws, IoError, and
/// Interrupted after Ctrl-C.
void make_runs(const Job& job, std::span<const int> at_steps, const std::filesystem::path& runs,
               const Session& session);

}  // namespace ramify::cli
