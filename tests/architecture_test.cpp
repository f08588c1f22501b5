// The rules of the house, read off the sources.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace fs = std::filesystem;

namespace {

const fs::path kRoot = RAMIFY_SOURCE_DIR;

struct Include {
  std::string file;  // relative to the root
  std::string name;  // as it stands in the #include
};

std::vector<fs::path> sources_below(const std::string& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(kRoot / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".cpp" || ending == ".h") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Include> includes_below(const std::string& folder) {
  std::vector<Include> result;
  for (const fs::path& path : sources_below(folder)) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
      if (line.rfind("#include ", 0) != 0) continue;
      const std::size_t begin = line.find_first_of("<\"") + 1;
      result.push_back(
          {fs::relative(path, kRoot).string(), line.substr(begin, line.find_first_of(">\"", begin) - begin)});
    }
  }
  return result;
}

std::string first_folder(const std::string& path) {
  return path.substr(0, path.find('/'));
}

const std::set<std::string> kOurs = {"common", "growth", "pathplan", "viewer", "cli", "bench", "tests"};

}  // namespace

TEST_CASE("architecture: a folder includes only what it may") {
  const std::map<std::string, std::set<std::string>> allowed = {
      {"common", {"common"}},
      {"growth", {"growth", "common"}},
      {"pathplan", {"pathplan", "common"}},
      {"viewer", {"viewer", "common"}},
      {"cli", {"cli", "viewer", "growth", "pathplan", "common"}},
      {"bench", {"bench", "growth", "pathplan", "common"}},
  };
  for (const auto& [folder, may_include] : allowed) {
    const std::vector<Include> includes = includes_below(folder);
    REQUIRE(includes.size() > 10);
    for (const Include& include : includes) {
      const std::string target = first_folder(include.name);
      if (kOurs.count(target) == 0) continue;
      INFO(include.file << " includes " << include.name);
      CHECK(may_include.count(target) == 1);
    }
  }
}

TEST_CASE("architecture: a library is named only where it belongs") {
  // A library's headers begin with the key; they may stand in files that begin with one of the places.
  const std::map<std::string, std::vector<std::string>> places = {
      {"openvdb/", {"growth/shadow_grid.cpp", "common/volume/", "common/mesh/", "bench/plain_"}},
      {"tiny_obj", {"common/volume/", "common/mesh/"}},
      {"tbb/", {"common/base/parallel."}},
      {"glm/", {"common/base/geometry.h", "viewer/"}},
      {"toml++/", {"common/config/"}},
      {"CLI/", {"cli/"}},
      {"GLFW/", {"viewer/"}},
      {"EGL/", {"viewer/"}},
      {"epoxy/", {"viewer/"}},
      {"imgui", {"viewer/"}},
      {"stb/", {"common/base/image.cpp", "common/base/letters.cpp"}},
      {"libqhull", {"common/analysis/hull.cpp"}},
      {"tiny_gltf", {"common/mesh/"}},
      {"benchmark/", {"bench/"}},
      {"nanoflann", {"bench/plain_"}},
      {"boost/", {"bench/plain_"}},
  };
  for (const std::string folder : {"common", "growth", "pathplan", "viewer", "cli", "bench"}) {
    for (const Include& include : includes_below(folder)) {
      for (const auto& [library, files] : places) {
        if (include.name.rfind(library, 0) != 0) continue;
        INFO(include.file << " includes " << include.name);
        CHECK(std::any_of(files.begin(), files.end(),
                          [&](const std::string& place) { return include.file.rfind(place, 0) == 0; }));
      }
    }
  }
}

TEST_CASE("architecture: heavy libraries stay out of headers") {
  for (const std::string folder : {"common", "growth", "pathplan", "viewer", "cli", "bench"}) {
    for (const Include& include : includes_below(folder)) {
      if (fs::path(include.file).extension() != ".h") continue;
      for (const std::string heavy :
           {"openvdb/", "tbb/", "fmt/", "toml++/", "tiny_gltf", "epoxy/", "EGL/", "stb/"}) {
        INFO(include.file << " includes " << include.name);
        CHECK(include.name.rfind(heavy, 0) != 0);
      }
    }
  }
}

TEST_CASE("architecture: only main() ends the program and no code draws random numbers of its own") {
  for (const std::string folder : {"common", "growth", "pathplan", "viewer", "cli", "bench"}) {
    for (const fs::path& path : sources_below(folder)) {
      std::ostringstream text;
      text << std::ifstream(path).rdbuf();
      for (const std::string word :
           {"std::exit(", "abort(", "rand()", "std::random_device", "std::mt19937"}) {
        INFO(path.string() << ": " << word);
        CHECK(text.str().find(word) == std::string::npos);
      }
    }
  }
}

TEST_CASE("architecture: common has its seven folders and nothing loose") {
  const std::set<std::string> rooms = {"base", "config", "skeleton", "volume", "mesh", "format", "analysis"};
  for (const auto& entry : fs::directory_iterator(kRoot / "common")) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory()) CHECK(rooms.count(name) == 1);
    if (!entry.is_directory()) CHECK(name == "CMakeLists.txt");
  }
}

TEST_CASE("architecture: no test has a name that CTest would cut up") {
  for (const fs::path& path : sources_below("tests")) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
      if (line.rfind("TEST_CASE(\"", 0) != 0) continue;
      const std::string name = line.substr(11, line.find('"', 11) - 11);
      INFO(path.string() << ": " << name);
      CHECK(name.find_first_of("[];\\") == std::string::npos);
    }
  }
}
