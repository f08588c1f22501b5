// Attributes of a tree as colours.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/base/color.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// What attribute_colors() takes for this skeleton: "order", "strahler" and "width" for every one;
/// "birthStep", "level", "light" and "vigour" where the engine set them; then the names of its channels.
std::vector<std::string> color_attributes(const Skeleton& skeleton);

/// One colour a node. Order and level get a categorical colour a value; the others run along a sequential map
/// from the least to the greatest value among the internodes: width, light and vigour by their logarithms,
/// since they multiply towards the trunk. Throws InputError if the skeleton lacks the attribute; the
/// message begins with `asked_by`, the flag or key that named it.
std::vector<Color> attribute_colors(const Skeleton& skeleton, std::string_view name,
                                    std::string_view asked_by = "--color-by");

}  // namespace ramify
