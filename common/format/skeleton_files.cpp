#include "common/format/skeleton_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/format/cylinders.h"
#include "common/format/simpleforest.h"
#include "common/format/skeleton_table.h"
#include "common/format/text_table.h"
#include "common/format/treegraph.h"
#include "common/format/treeqsm.h"

namespace ramify {
namespace {

constexpr std::array<std::string_view, 2> kEndings = {".csv", ".txt"};

/// A skeleton and which way its format has up.
struct Reading {
  SkeletonFile file;
  UpAxis up = UpAxis::y;
};

Reading read_cylinders(const Cylinders& cylinders, const std::string& name) {
  CylinderTree tree = join_cylinders(cylinders, name);
  Reading reading{{std::move(tree.skeleton), {}}, UpAxis::z};
  if (tree.largest_gap_line > 0) {
    reading.file.notes.push_back(
        fmt::format("{}: cylinders do not all start where their parents end: {:.3g} m apart in line {}, "
                    "bridged",
                    name, tree.largest_gap, tree.largest_gap_line));
  }
  return reading;
}

Reading read_table(const std::string& text, const std::string& name) {
  TextTable table(text, name);
  if (is_treegraph(table)) return read_cylinders(read_treegraph(table), name);
  if (is_simpleforest(table)) return read_cylinders(read_simpleforest(table), name);
  if (is_treeqsm(table)) return read_cylinders(read_treeqsm(text, name), name);
  return {{read_skeleton_table(text, name), {}}, UpAxis::y};
}

}  // namespace

std::string skeleton_endings() {
  return fmt::format("{}", fmt::join(kEndings, ", "));
}

bool is_skeleton_file(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(kEndings.begin(), kEndings.end(), [&](std::string_view ending) {
    return name.size() > ending.size() && name.ends_with(ending);
  });
}

SkeletonFile read_skeleton(const std::filesystem::path& path, const SkeletonReading& options) {
  const std::string name = path.string();
  Reading reading = read_table(read_file(path), name);
  Skeleton& skeleton = reading.file.skeleton;
  if (options.up.value_or(reading.up) == UpAxis::z) {
    for (Vec3& position : skeleton.position) position = from_z_up(position);
  }
  const std::vector<std::string> problems = violations(skeleton, 1);
  if (!problems.empty()) throw InputError(fmt::format("{}: {}", name, problems.front()));
  return std::move(reading.file);
}

}  // namespace ramify
