// Bark textures made by the program: heights from periodic noise, and from them shades and normals.
// S. Worley, A cellular texture basis function, SIGGRAPH 1996; K. Perlin, Improving noise, SIGGRAPH 2002.
#pragma once

#include "common/base/image.h"
#include "common/mesh/bark.h"

namespace ramify {

/// Both continue beyond each edge at the opposite one.
struct BarkTexture {
  Image shade;              // grey: what multiplies the bark's colour
  Image normal_map;         // x along +u (to the right), y along +v (up the image), z outwards
  double mean_shade = 1.0;  // linear
};

/// `kind` is not plain. The same pixels each time. About 30 ms at 512 pixels a side.
BarkTexture make_bark_texture(BarkKind kind, int resolution);

}  // namespace ramify
