#include "viewer/settings.h"

#include <fstream>

#include "tests/catch.h"
#include "tests/folder.h"

using namespace ramify;
using ramify::test::Folder;

TEST_CASE("settings: what is written is read back, folders are made") {
  const Folder folder;
  Settings settings;
  settings.width = 1024;
  settings.is_same_scale = true;
  const std::filesystem::path file = folder.path() / "new" / "ramify" / "window.toml";
  write_settings(settings, file);
  std::string problem;
  const Settings read = read_settings(file, problem);
  CHECK(problem.empty());
  CHECK(read.width == 1024);
  CHECK(read.is_same_scale);
}

TEST_CASE("settings: a file that makes no sense is named and the defaults stand") {
  const Folder folder;
  std::ofstream(folder.file("window.toml")) << "width = 0\n";
  std::string problem;
  const Settings read = read_settings(folder.file("window.toml"), problem);
  CHECK(read.width == Settings().width);
  CHECK(problem.find("window.toml:1: width: 0 is out of range") != std::string::npos);
  CHECK(read_settings(folder.path() / "none.toml", problem).height == Settings().height);
}
