// How the window looks: colours, spacing and the font.
#pragma once

#include <string>

namespace ramify {

/// Dark and neutral, so that the trees have the colours. Sizes grow with `scale`, the window's units for one
/// of a plain display; letters are as fine as `density`, pixels for a unit of the window, allows. To be
/// called once, after ImGui's context was made. Returns a sentence where no font was found and ImGui's own,
/// which is coarse, stands in; empty otherwise.
std::string apply_theme(double scale, double density);

/// The `scale` of apply_theme(), to be multiplied with sizes that ImGui's style does not set.
float ui_scale();

/// Pixels for one of a plain display.
double display_scale();

}  // namespace ramify
