// Everything the window can be told by menu or key: one table for both and for the sheet of keys.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "viewer/workbench.h"

namespace ramify {

struct Command {
  std::string menu;  // in which it stands
  std::string label;
  KeyPress key = {};  // no key: empty
  std::function<void(Workbench&)> run;
  std::function<bool(const Workbench&)> is_possible = {};  // empty: always
  std::function<bool(const Workbench&)> is_on = {};        // for those that are switched
};

/// In the order of the menus.
const std::vector<Command>& commands();

/// "Ctrl+Z", "F12"; empty for none.
std::string key_text(const KeyPress& key);

/// Runs what the keys stand for.
void obey_keys(Workbench& bench);

}  // namespace ramify
