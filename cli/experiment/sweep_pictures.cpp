#include "cli/experiment/sweep_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "common/base/errors.h"
#include "common/base/files.h"
#include "common/base/letters.h"
#include "common/format/skeleton_files.h"
#include "common/mesh/tree_mesh.h"
#include "viewer/renderer.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

// More would take longer to make than all the rest, and a picture this small shows none of it.
constexpr int kBarkResolution = 64;  // pixels

constexpr int kLargestSide = 240;       // pixels
constexpr int kSmallestSide = 48;       // pixels
constexpr double kMostPixels = 40e6;    // of a contact sheet
constexpr float kLetterHeight = 15.0f;  // pixels
constexpr int kLineHeight = 17;         // pixels
constexpr ColorBytes kInk{40, 40, 38, 255};

Box room_of(const SweepResults& results) {
  Box room;
  for (const SweepRow& row : results.rows) {
    if (row.record && !row.record->extent.is_empty()) room.include(row.record->extent);
  }
  return room;
}

/// Draws trees from the folders of their runs.
class Studio {
 public:
  Studio(Box room, int side) : room_(room), side_(side) {}

  std::string draw(const fs::path& run, const Session& session) {
    if (!renderer_) renderer_.emplace();
    const Job job = load_job(session.registry, (run / kRunConfig).string());
    const Skeleton tree = read_skeleton(run / kRunTree).skeleton;
    Looks looks = job.looks();
    looks.bark.resolution = std::min(looks.bark.resolution, kBarkResolution);
    const Mesh mesh = make_tree_mesh(tree, looks, job.seed()).mesh;
    Box room = room_;  // leaves reach beyond the wood
    room.low -= Vec3(job.leaves.length);
    room.high += Vec3(job.leaves.length);
    const std::array<Vec3, 8> around = corners(room);
    const std::vector<Vec3f> points(around.begin(), around.end());
    RenderOptions options;
    options.width = options.height = side_;
    options.room_for = points;
    options.with_occlusion = false;  // else drawing takes longer than growing, for shades too fine to be seen
    std::ostringstream png;
    write_png(renderer_->render({.mesh = &mesh, .skeleton = &tree}, options), png);
    return std::move(png).str();
  }

 private:
  std::optional<Renderer> renderer_;  // made for the first picture: it takes a while
  Box room_;
  int side_;
};

/// Pictures of another scale or size are gone after this.
void keep_pictures_of(const SweepFolder& folder, const Box& room, int side) {
  const std::string scale = fmt::format("{} pixels, {} {} {} to {} {} {} m\n", side, room.low.x, room.low.y,
                                        room.low.z, room.high.x, room.high.y, room.high.z);
  const fs::path pictures = folder.path() / "pictures";
  std::error_code error;
  if (fs::exists(pictures / "scale.txt", error) && read_file(pictures / "scale.txt") == scale) return;
  fs::remove_all(pictures, error);
  folder.write("pictures/scale.txt", scale);
}

/// The text cut so that it is no wider than `width` pixels.
std::string fitted(std::string text, const Letters& letters, float width) {
  if (letters.width(text) <= width) return text;
  while (!text.empty() && letters.width(text + "...") > width) text.pop_back();
  return text + "...";
}

/// The last part of a dotted key, if no other key ends like it.
std::string short_key(const std::vector<std::string>& keys, std::size_t at) {
  const auto last = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
  const auto same = std::count_if(keys.begin(), keys.end(),
                                  [&](const std::string& key) { return last(key) == last(keys[at]); });
  return same > 1 ? keys[at] : last(keys[at]);
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

std::vector<std::string> draw_runs(const SweepResults& results, const SweepFolder& folder,
                                   const Session& session,
                                   const std::function<void(std::size_t, std::size_t)>& report) {
  const Box room = room_of(results);
  const int side = picture_side(results.rows.size());
  keep_pictures_of(folder, room, side);
  Studio studio(room, side);
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < results.rows.size(); ++i) {
    report(i, results.rows.size());
    if (session.stop.stop_requested())
      throw Interrupted{"all runs are made; the same command goes on from there"};
    pictures.emplace_back();
    if (!results.rows[i].record) continue;
    const std::string& name = results.plan.runs[i].name;
    const fs::path file = fs::path("pictures") / (name + ".png");
    std::error_code error;
    if (fs::exists(folder.path() / file, error)) {
      pictures.back() = read_file(folder.path() / file);
    } else {
      pictures.back() = studio.draw(folder.runs() / name, session);
      folder.write(file, pictures.back());
    }
  }
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
