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
#include "common/format/mtg.h"
#include "common/format/simpleforest.h"
#include "common/format/skeleton_ply.h"
#include "common/format/skeleton_table.h"
#include "common/format/swc.h"
#include "common/format/text_table.h"
#include "common/format/treegraph.h"
#include "common/format/treeqsm.h"
#include "common/skeleton/passes.h"

namespace ramify {
namespace {

struct Ending {
  std::string_view text;
  SkeletonForm form;
};

// Read by these endings; a .txt, as programs that measure trees write them, is not written.
constexpr std::array kEndings = {
    Ending{".csv", SkeletonForm::table},    Ending{".txt", SkeletonForm::table},
    Ending{".skel.ply", SkeletonForm::ply}, Ending{".swc", SkeletonForm::swc},
    Ending{".mtg", SkeletonForm::mtg},
};

const Ending* ending_of(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::find_if(kEndings.begin(), kEndings.end(), [&](const Ending& ending) {
    return name.size() > ending.text.size() && name.ends_with(ending.text);
  });
  return found == kEndings.end() ? nullptr : &*found;
}

/// A skeleton and which way its format has up.
struct Reading {
  SkeletonFile file;
  UpAxis up = UpAxis::y;
};

Reading read_cylinders(const Cylinders& cylinders, const std::string& name) {
  CylinderTree tree = join_cylinders(cylinders, name);
  Reading reading{{std::move(tree.skeleton), {}, {}}, UpAxis::z};
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
  return {{read_skeleton_table(text, name), {}, {}}, UpAxis::y};
}

Reading read_form(SkeletonForm form, const std::string& text, const std::string& name,
                  std::optional<UpAxis> up) {
  switch (form) {
    case SkeletonForm::table:
    case SkeletonForm::simpleforest:
      return read_table(text, name);
    case SkeletonForm::ply: {
      SkeletonPly ply = read_skeleton_ply(text, name);
      return {{std::move(ply.skeleton), {}, std::move(ply.provenance)}, UpAxis::y};
    }
    case SkeletonForm::swc:
      return {{read_swc(text, name), {}, {}}, UpAxis::y};
    case SkeletonForm::mtg:
      return {{read_mtg(text, name, up.value_or(UpAxis::z)), {}, {}}, UpAxis::z};
  }
  return {};
}

bool has_counted_orders(const Skeleton& skeleton) {
  Skeleton counted;
  counted.position = skeleton.position;
  counted.parent = skeleton.parent;
  counted.axis = skeleton.axis;
  assign_orders(counted);
  return counted.order == skeleton.order;
}

/// A skeleton table has no rows for root nodes, so these are read as wide as the widest that starts there.
bool has_widths_of_children(const Skeleton& skeleton) {
  std::vector<double> widest(skeleton.root_count(), 0.0);
  for (std::size_t node = widest.size(); node < skeleton.node_count(); ++node) {
    const std::uint32_t parent = skeleton.parent[node];
    if (parent < widest.size()) widest[parent] = std::max(widest[parent], skeleton.diameter[node]);
  }
  return std::equal(widest.begin(), widest.end(), skeleton.diameter.begin());
}

void add_channels(const Skeleton& skeleton, SkeletonForm form, std::vector<std::string>& names) {
  for (const auto& [name, values] : skeleton.channels) {
    if (form != SkeletonForm::simpleforest || name != kStartRadius) names.push_back(name);
  }
}

}  // namespace

std::string skeleton_endings() {
  std::vector<std::string_view> endings;
  for (const Ending& ending : kEndings) endings.push_back(ending.text);
  return fmt::format("{}", fmt::join(endings, ", "));
}

bool is_skeleton_file(const std::filesystem::path& path) {
  return ending_of(path) != nullptr;
}

SkeletonFile read_skeleton(const std::filesystem::path& path, const SkeletonReading& options) {
  const std::string name = path.string();
  const Ending* ending = ending_of(path);
  if (!ending) throw InputError(fmt::format("{}: no skeleton file ({})", name, skeleton_endings()));
  Reading reading = read_form(ending->form, read_file(path), name, options.up);
  Skeleton& skeleton = reading.file.skeleton;
  if (options.up.value_or(reading.up) == UpAxis::z) {
    for (Vec3& position : skeleton.position) position = from_z_up(position);
  }
  const std::vector<std::string> problems = violations(skeleton, 1);
  if (!problems.empty()) throw InputError(fmt::format("{}: {}", name, problems.front()));
  return std::move(reading.file);
}

std::optional<SkeletonForm> skeleton_form(const std::filesystem::path& path) {
  const Ending* ending = ending_of(path);
  if (!ending || ending->text == ".txt") return std::nullopt;
  return ending->form;
}

std::vector<std::string> left_out(const Skeleton& skeleton, SkeletonForm form) {
  std::vector<std::string> names;
  if (form == SkeletonForm::ply) return names;
  if (form == SkeletonForm::table) {
    if (!has_widths_of_children(skeleton)) names.push_back("the root's width");
  } else {
    if (std::any_of(skeleton.shed_step.begin(), skeleton.shed_step.end(),
                    [](std::uint32_t step) { return step != kAlive; })) {
      names.push_back("shed internodes");
    }
    if (!has_counted_orders(skeleton)) names.push_back("branchOrder (counted anew)");
    if (!skeleton.birth_step.empty()) names.push_back("birthStep");
    if (!skeleton.level.empty()) names.push_back("level");
    if (!skeleton.light.empty()) names.push_back("light");
    if (!skeleton.vigour.empty()) names.push_back("vigour");
    if (std::count(skeleton.kind.begin(), skeleton.kind.end(), Kind::root) > 0) names.push_back("kind");
  }
  if (skeleton.pipe_model) names.push_back("the pipe model");
  add_channels(skeleton, form, names);
  return names;
}

void write_skeleton(const Skeleton& skeleton, SkeletonForm form, const std::optional<Provenance>& provenance,
                    std::ostream& out) {
  switch (form) {
    case SkeletonForm::table:
      return write_skeleton_table(skeleton, out);
    case SkeletonForm::ply:
      return write_skeleton_ply(skeleton, provenance, out);
    case SkeletonForm::swc:
      return write_swc(living(skeleton), provenance, out);
    case SkeletonForm::mtg:
      return write_mtg(living(skeleton), out);
    case SkeletonForm::simpleforest:
      return write_simpleforest(living(skeleton), out);
  }
}

}  // namespace ramify
