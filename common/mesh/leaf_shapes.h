// Leaves of built-in shapes, each a small mesh with a material of its own.
#pragma once

#include "common/mesh/mesh.h"

namespace ramify {

enum class LeafShape { none, ovate, lanceolate, lobed, needles };

enum class LeafForm {
  geometry,  // the outline in triangles
  card,      // few triangles with a picture, transparent around the leaf
};

/// One leaf of length 1: it grows from the origin along +Y, its upper side faces +Z. `mesh` has one range a
/// material; `area` is that of one side.
struct LeafModel {
  Mesh mesh;
  double area = 0.0;
};

/// `shape` is not none. The picture is grey, to be coloured by the vertices.
LeafModel make_leaf(LeafShape shape, LeafForm form);

/// Half the width of the blade at `t` from 0, where it leaves the twig, to 1, its tip; for needles, which
/// have no blade, of a single one.
double half_width(LeafShape shape, double t);

}  // namespace ramify
