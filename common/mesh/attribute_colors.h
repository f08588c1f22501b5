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

/// What the colours of an attribute run over, among the internodes.
struct AttributeScale {
  bool is_categorical = false;  // a colour a value; else along the sequential map from low to high
  bool is_logarithmic = false;  // by the logarithms of the positive values
  double low = 0.0;             // both 0 where no internode has a value
  double high = 0.0;
};

/// Throws InputError if the skeleton lacks the attribute.
AttributeScale attribute_scale(const Skeleton& skeleton, std::string_view name);

/// One colour a node. Order and level get a categorical colour a value; the others run along a sequential map
/// from the least to the greatest value among the internodes: width, light and vigour by their logarithms,
/// since they multiply towards the trunk. Throws InputError if the skeleton lacks the attribute; the
/// message begins with `asked_by`, the flag or key that named it.
std::vector<Color> attribute_colors(const Skeleton& skeleton, std::string_view name,
                                    std::string_view asked_by = "--color-by");

}  // namespace ramify
