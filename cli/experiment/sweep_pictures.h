// Pictures of a sweep's trees, all at one scale.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/experiment/sweep_folder.h"
#include "cli/experiment/sweep_results.h"
#include "common/base/image.h"

namespace ramify::cli {

/// Draws each finished run's tree, or reads the picture that was drawn before at the same scale; PNG files,
/// one a row of the results, empty where there is no tree. They are kept in pictures/NAME.png. `report(done,
/// total)` is called before each. Throws GraphicsError, and Interrupted after Ctrl-C.
std::vector<std::string> draw_runs(const SweepResults& results, const SweepFolder& folder,
                                   const Session& session,
                                   const std::function<void(std::size_t, std::size_t)>& report);

/// Width and height of the pictures, pixels; smaller where there are many runs.
int picture_side(std::size_t runs);

/// How many pictures stand side by side: the values of the last key where there are two or more, if that is
/// not too wide; else about as many as there are rows.
std::size_t picture_columns(const SweepPlan& plan);

/// All pictures in rows, each with its values below; runs without a tree have their place.
Image labelled_sheet(const SweepResults& results, const std::vector<std::string>& pictures);

}  // namespace ramify::cli
