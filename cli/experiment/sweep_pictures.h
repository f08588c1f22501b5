// Pictures of a sweep's trees, all at one scale.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/experiment/process_pool.h"
#include "cli/experiment/sweep_folder.h"
#include "cli/experiment/sweep_results.h"
#include "common/base/image.h"

namespace ramify::cli {

/// One a row of the results.
struct SweepPictures {
  std::vector<std::string> files;      // PNG; empty where there is no tree or drawing it failed
  std::optional<std::string> failure;  // why pictures of trees are missing
};

/// Has each finished run's tree drawn, but for those that were drawn before at the same scale, by child
/// processes with one thread each. The pictures are kept in pictures/NAME.png. `report(done, total)` is
/// called now and then. Throws Interrupted after Ctrl-C, IoError, and RunError if no process can be started.
SweepPictures draw_runs(const SweepResults& results, const SweepFolder& folder, const PoolOptions& options,
                        const std::function<void(std::size_t done, std::size_t total)>& report);

/// Width and height of the pictures, pixels; smaller where there are many runs.
int picture_side(std::size_t runs);

/// How many pictures stand side by side: the values of the last key where there are two or more, if that is
/// not too wide; else about as many as there are rows.
std::size_t picture_columns(const SweepPlan& plan);

/// All pictures in rows, each with its values below; runs without a tree have their place.
Image labelled_sheet(const SweepResults& results, const std::vector<std::string>& pictures);

}  // namespace ramify::cli
