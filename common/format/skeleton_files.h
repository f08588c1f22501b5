// The one place that knows which endings skeleton files have, and who reads and writes them.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "common/config/provenance.h"
#include "common/format/up_axis.h"
#include "common/skeleton/skeleton.h"

namespace ramify {

/// The endings read, for messages: ".csv, .txt, ...".
std::string skeleton_endings();

/// True if `path` has one of those endings, in any case; the file need not be there.
bool is_skeleton_file(const std::filesystem::path& path);

struct SkeletonReading {
  std::optional<UpAxis> up;  // of the file; empty: as its format has it (.mtg and tables of cylinders Z)
};

/// What a skeleton file says. The skeleton is sound (it has no violations) and +Y is up.
struct SkeletonFile {
  Skeleton skeleton;
  std::vector<std::string> notes;        // what a person should know, one line each
  std::optional<Provenance> provenance;  // of a .skel.ply that ramify made
};

/// Reads a skeleton in any form; in a .csv or .txt a skeleton table or a table of cylinders of SimpleForest,
/// Treegraph/aRchi or TreeQSM, told apart by their headers. Throws InputError: one line with the file and,
/// where there is one, the row.
SkeletonFile read_skeleton(const std::filesystem::path& path, const SkeletonReading& options = {});

enum class SkeletonForm { table, ply, swc, mtg, simpleforest };

/// The form that a file of this ending is written in; empty if it is none of a skeleton's. SimpleForest's
/// tables share .csv with ours, which is meant.
std::optional<SkeletonForm> skeleton_form(const std::filesystem::path& path);

/// What a file of this form would leave out of the skeleton, in the words of the skeleton table's columns;
/// empty if it carries all.
std::vector<std::string> left_out(const Skeleton& skeleton, SkeletonForm form);

/// Shed internodes stand only in forms that can say that they are shed.
void write_skeleton(const Skeleton& skeleton, SkeletonForm form, const std::optional<Provenance>& provenance,
                    std::ostream& out);

}  // namespace ramify
