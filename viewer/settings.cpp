#include "viewer/settings.h"

#include <cstdlib>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/config/toml_reader.h"
#include "common/config/toml_writer.h"

namespace ramify {

const Table& Settings::fields() {
  using S = Settings;
  static const Table table = make_table<S>({
      {"width", &S::width, {.min = 1, .max = 32'768, .help = "of the window"}},
      {"height", &S::height, {.min = 1, .max = 32'768, .help = "of the window"}},
      {"are_cameras_linked", &S::are_cameras_linked, {.help = "whether both trees are seen alike"}},
      {"is_same_scale", &S::is_same_scale, {.help = "whether a metre is as long for both trees"}},
      {"with_scale", &S::with_scale, {.help = "whether bar and figure are shown"}},
      {"shows_gallery", &S::shows_gallery, {.help = "whether the presets' gallery is open at the start"}},
  });
  return table;
}

std::filesystem::path settings_file() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0') {
    return std::filesystem::path(folder) / "ramify" / "window.toml";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".config" / "ramify" / "window.toml";
  }
  return {};
}

Settings read_settings(const std::filesystem::path& file, std::string& problem) {
  Settings settings;
  std::error_code error;
  if (file.empty() || !std::filesystem::exists(file, error)) return settings;
  try {
    Origins origins;
    TomlDocument(read_file(file), file.string()).read_into(Settings::fields(), &settings, {}, origins);
  } catch (const std::exception& cause) {
    problem = cause.what();
    return {};
  }
  return settings;
}

void write_settings(const Settings& settings, const std::filesystem::path& file) {
  if (file.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  OutputFiles files;
  files.add(file) << to_toml(Settings::fields(), &settings);
  files.commit();
}

}  // namespace ramify
