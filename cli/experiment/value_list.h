// The values of `--vary KEY=LIST`.
#pragma once

#include <string>
#include <vector>

namespace ramify::cli {

/// A parameter that varies, and its values as TOML.
struct Axis {
  std::string key;  // dotted
  std::vector<std::string> values;
};

/// Reads KEY=LIST: values separated by commas, each TOML or a range `from:to:step`, `to` included. Commas in
/// quotes and brackets separate nothing. Throws InputError.
Axis axis_of(const std::string& text);

}  // namespace ramify::cli
