// The GLSL sources of the programs that Painter and RenderTarget run. All light is linear and colours leave
// with their alpha multiplied in; only the last step, `finish`, encodes them.
#pragma once

#include <string>

namespace ramify::shaders {

/// A triangle over the whole viewport.
std::string screen_vertex();
std::string background_fragment();
std::string finish_fragment();

/// The mesh as the sun sees it: coverage and depth.
std::string caster_vertex();
std::string caster_fragment();

/// The mesh, the figure and the bar in plain colours.
std::string flat_vertex();
std::string flat_fragment();

/// The mesh lit by sun and sky.
std::string lit_vertex();
std::string lit_fragment();

std::string ground_vertex();
std::string ground_fragment();

/// Segments as strips that face the viewer, and squares that face +Z.
std::string line_vertex();
std::string square_vertex();
std::string line_fragment();

/// Dots that grow towards the viewer, shaded like balls.
std::string dot_vertex();
std::string dot_fragment();

/// Surfaces that are seen through; least where they face the viewer.
std::string veil_vertex();
std::string veil_fragment();

}  // namespace ramify::shaders
