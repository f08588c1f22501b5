// How the window looks: colours, spacing and the font.
#pragma once

#include <string>

namespace ramify {

/// Dark and neutral, so that the trees have the colours. Sizes grow with `scale`, the display's pixels for
/// one of a plain display. To be called once, after ImGui's context was made. Returns a sentence where no
/// font was found and ImGui's own, which is coarse, stands in; empty otherwise.
std::string apply_theme(double scale);

}  // namespace ramify
