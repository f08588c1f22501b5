// What the window remembers from one time to the next.
#pragma once

#include <filesystem>
#include <string>

#include "common/config/field.h"

namespace ramify {

struct Settings {
  int width = 1280;  // of the window, as in Window::Options
  int height = 800;
  bool are_cameras_linked = true;
  bool is_same_scale = false;
  bool with_scale = false;
  bool shows_gallery = true;

  static const Table& fields();
};

/// In the user's folder of settings (XDG_CONFIG_HOME, else ~/.config); empty if there is no such folder.
std::filesystem::path settings_file();

/// The defaults where there is no file. Of a file that cannot be read `problem` tells, in one line.
Settings read_settings(const std::filesystem::path& file, std::string& problem);

/// Makes the folder where it is missing. Throws IoError.
void write_settings(const Settings& settings, const std::filesystem::path& file);

}  // namespace ramify
