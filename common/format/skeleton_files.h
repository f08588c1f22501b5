// The one place that knows which endings skeleton files have, and who reads and writes them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/format/up_axis.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// The endings read, for messages: ".csv, .txt".
std::string skeleton_endings();

/// True if `path` has one of those endings, in any case; the file need not be there.
bool is_skeleton_file(const std::filesystem::path& path);

struct SkeletonReading {
  std::optional<UpAxis> up;  // of the file; empty: as its format has it (tables of cylinders Z, others Y)
};

/// What a skeleton file says. The skeleton is sound (it has no violations) and +Y is up.
struct SkeletonFile {
  Skeleton skeleton;
  std::vector<std::string> notes;  // what a person should know, one line each
};

/// Reads a skeleton table or a table of cylinders of SimpleForest, Treegraph/aRchi or TreeQSM, told apart by
/// their headers. Throws InputError: one line with the file and, where there is one, the row.
SkeletonFile read_skeleton(const std::filesystem::path& path, const SkeletonReading& options = {});

}  // namespace ramify
