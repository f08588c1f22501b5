// What of the trees is shown, and how: the same for all panes.
#pragma once

#include <set>
#include <string>

#include "viewer/scene.h"

namespace ramify {

enum class Arrangement { side_by_side, overlaid };

struct ShowOptions {
  RenderStyle style = RenderStyle::lit;
  std::string color_by;                          // as in RenderOptions
  bool with_scale = false;                       // as in RenderOptions
  std::set<std::string> layers = {"obstacles"};  // by name, over the tree
  bool are_slices = true;                        // of fields of voxels: one slice, not all
  Arrangement arrangement = Arrangement::side_by_side;

  bool operator==(const ShowOptions&) const = default;
};

}  // namespace ramify
