#include "cli/experiment/sweep_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "cli/commands.h"
#include "cli/experiment/process.h"
#include "common/base/files.h"
#include "common/base/letters.h"
#include "viewer/scene.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

// What drawing is taken to need before it has been seen, bytes: OpenGL in software, and the mesh.
constexpr std::uint64_t kDrawingMemory = 220ull << 20;
constexpr double kMemoryAnInternode = 1000.0;

constexpr int kLargestSide = 240;       // pixels
constexpr int kSmallestSide = 48;       // pixels
constexpr double kMostPixels = 40e6;    // of a contact sheet
constexpr float kLetterHeight = 15.0f;  // pixels
constexpr int kLineHeight = 17;         // pixels
constexpr ColorBytes kInk{40, 40, 38, 255};

/// What all pictures show: the wood of all trees, and the obstacles near them.
Box room_of(const SweepResults& results) {
  Box trees;
  for (const SweepRow& row : results.rows) {
    if (row.record && !row.record->extent.is_empty()) trees.include(row.record->extent);
  }
  Box room = trees;
  for (const SweepRow& row : results.rows) {
    const Box obstacles = row.record ? obstacle_room(row.record->obstacles, trees) : Box();
    if (!obstacles.is_empty()) room.include(obstacles);
  }
  return room;
}

double internodes_of(const RunRecord& record) {
  return metric_of(record, "internodes").value_or(0.0);
}

/// Bytes that a process is taken to need.
std::uint64_t first_guess(const SweepResults& results) {
  double most = 0.0;
  for (const SweepRow& row : results.rows) {
    if (row.record) most = std::max(most, internodes_of(*row.record));
  }
  return kDrawingMemory + static_cast<std::uint64_t>(kMemoryAnInternode * most);
}

/// The names of the finished runs whose pictures are not there, the largest trees first: nobody waits for the
/// last one. Each stands on a line of its own.
std::string names_to_draw(const SweepResults& results, const SweepFolder& folder) {
  std::vector<std::pair<double, std::string>> trees;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const std::string& name = results.plan.runs[i].name;
    std::error_code error;
    if (!results.rows[i].record || fs::exists(folder.path() / picture_name(name), error)) continue;
    trees.emplace_back(internodes_of(*results.rows[i].record), name);
  }
  std::sort(trees.begin(), trees.end(), std::greater<>());
  trees.erase(std::unique(trees.begin(), trees.end()), trees.end());
  std::string names;
  for (const auto& [size, name] : trees) names += name + '\n';
  return names;
}

/// The child's command line; the names come by its stdin.
std::vector<std::string> picture_command(const SweepFolder& folder, const Box& room, int side) {
  const auto point = [](const Vec3& p) { return fmt::format("{},{},{}", p.x, p.y, p.z); };
  return {kThisProgram,
          "sweep-draw",
          "-o",
          folder.path().string(),
          fmt::format("--side={}", side),
          "--low=" + point(room.low),
          "--high=" + point(room.high),
          "--threads",
          "1"};
}

/// Has child processes draw the runs whose names they take from a list that they share.
class DrawingRoom {
 public:
  DrawingRoom(const std::string& names, std::vector<std::string> command, const PoolOptions& options,
              std::uint64_t first_guess)
      : names_(names), command_(std::move(command)), pool_(options, first_guess) {
    most_ = std::min(process_count(options.processes), total());
    for (std::size_t i = 0; i < most_; ++i) add();
  }

  std::size_t total() const { return names_.size() / (kRunNameLength + 1); }

  /// Returns why there are pictures missing; nothing if there are none.
  std::optional<std::string> work(const std::function<void(std::size_t, std::size_t)>& report) {
    pool_.work([&](double) { report(taken() - std::min(most_, taken()), total()); });
    return failure_;
  }

 private:
  std::size_t taken() const { return names_.position() / (kRunNameLength + 1); }

  void add() {
    // The program that runs is there.
    pool_.add({[this] { return *Process::start(command_, names_); },
               [this](const ProcessEnd& end) { finish(end); }});
  }

  /// The tree that a process failed at has no picture; another process goes on with the others.
  void finish(const ProcessEnd& end) {
    if (end.code == 0) return;
    failure_ = failure_of(end);
    if (taken() == taken_at_failure_) return;
    taken_at_failure_ = taken();
    add();
  }

  MemoryFile names_;
  std::vector<std::string> command_;
  ProcessPool pool_;
  std::size_t most_ = 0;
  std::size_t taken_at_failure_ = 0;
  std::optional<std::string> failure_;
};

/// Pictures of another scale or size are gone after this.
void keep_pictures_of(const SweepFolder& folder, const Box& room, int side) {
  const std::string scale = fmt::format("{} pixels, {} {} {} to {} {} {} m\n", side, room.low.x, room.low.y,
                                        room.low.z, room.high.x, room.high.y, room.high.z);
  const fs::path pictures = folder.path() / kPictures;
  std::error_code error;
  if (fs::exists(pictures / "scale.txt", error) && read_file(pictures / "scale.txt") == scale) return;
  fs::remove_all(pictures, error);
  folder.write(fs::path(kPictures) / "scale.txt", scale);
}

/// The text cut so that it is no wider than `width` pixels.
std::string fitted(std::string text, const Letters& letters, float width) {
  if (letters.width(text) <= width) return text;
  while (!text.empty() && letters.width(text + "...") > width) text.pop_back();
  return text + "...";
}

Image blank(int width, int height) {
  Image image{width, height, {}};
  image.rgba.assign(4 * static_cast<std::size_t>(width) * height, 255);
  return image;
}

/// Copies a picture into another, which is at least as large, to its upper left.
void paste(const Image& picture, Image& onto) {
  for (int y = 0; y < picture.height; ++y) {
    std::copy_n(picture.pixel(0, y), 4 * static_cast<std::size_t>(picture.width),
                onto.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(y) * onto.width);
  }
}

}  // namespace

int picture_side(std::size_t runs) {
  const double side = std::sqrt(kMostPixels / static_cast<double>(std::max<std::size_t>(runs, 1)));
  return std::clamp(static_cast<int>(side), kSmallestSide, kLargestSide);
}

std::size_t picture_columns(const SweepPlan& plan) {
  const std::size_t count = plan.runs.size();
  const auto square = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  if (plan.keys.size() < 2) return square;
  // The last key varies soonest: its values begin anew where the first one comes again.
  std::size_t last = 1;
  while (last < count && plan.runs[last].values.back() != plan.runs[0].values.back()) ++last;
  return last <= 3 * square ? last : square;
}

SweepPictures draw_runs(const SweepResults& results, const SweepFolder& folder, const PoolOptions& options,
                        const std::function<void(std::size_t, std::size_t)>& report) {
  const Box room = room_of(results);
  const int side = picture_side(results.rows.size());
  keep_pictures_of(folder, room, side);
  DrawingRoom drawing(names_to_draw(results, folder), picture_command(folder, room, side), options,
                      first_guess(results));
  SweepPictures pictures;
  pictures.failure = drawing.work(report);
  if (options.stop.stop_requested())
    throw Interrupted{"all runs are made; the same command goes on from there"};
  bool is_missing = false;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    const fs::path file = folder.path() / picture_name(results.plan.runs[i].name);
    std::error_code error;
    const bool is_there = results.rows[i].record && fs::exists(file, error);
    pictures.files.push_back(is_there ? read_file(file) : "");
    is_missing = is_missing || (results.rows[i].record && !is_there);
  }
  if (!is_missing) pictures.failure.reset();  // it failed between two of them
  return pictures;
}

Image labelled_sheet(const SweepResults& results, const std::vector<std::string>& pictures) {
  const Letters letters(kLetterHeight);
  const std::vector<std::string>& keys = results.plan.keys;
  const int side = picture_side(results.rows.size());
  const int strip = letters.can_draw() ? kLineHeight * static_cast<int>(keys.size()) + 4 : 0;
  std::vector<Image> tiles;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    Image tile = blank(side, side + strip);
    if (!pictures[i].empty()) paste(decoded_image(pictures[i], results.plan.runs[i].name), tile);
    const std::string status = status_of(results.rows[i]);
    if (pictures[i].empty()) letters.draw(tile, 6, side / 2, status, kInk);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const std::string text = short_key(keys, k) + " = " + results.plan.runs[i].values[k];
      letters.draw(tile, 4, side + 2 + kLineHeight * static_cast<int>(k),
                   fitted(text, letters, static_cast<float>(side - 6)), kInk);
    }
    tiles.push_back(std::move(tile));
  }
  return contact_sheet(tiles, picture_columns(results.plan));
}

}  // namespace ramify::cli
