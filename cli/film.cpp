#include "cli/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "cli/experiment/process.h"
#include "cli/experiment/result_folder.h"
#include "cli/progress_bar.h"
#include "common/base/errors.h"
#include "common/base/image.h"
#include "common/base/parallel.h"
#include "common/mesh/tree_mesh.h"
#include "common/skeleton/passes.h"
#include "viewer/film_camera.h"
#include "viewer/renderer.h"
#include "viewer/sky_light.h"

namespace ramify::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMp4 = "film.mp4";

// Frames a second where nobody asks for more or fewer: the film lasts so long, unless it would flicker.
constexpr double kFilmSeconds = 6.0;
constexpr int kMostFramesPerSecond = 24;

/// A tree in a film.
struct Actor {
  std::optional<Grown> whole;  // of a film of steps: the tree with all that it shed
  std::uint32_t step_count = 0;
  std::uint32_t step = 0;       // on show
  Tree tree;                    // as it is on show
  std::optional<SkyLight> sky;  // of a tree that stays as it is
  std::vector<Vec3f> room;

  Scene scene() const {
    return {.mesh = &tree.mesh,
            .skeleton = tree.skeleton ? &*tree.skeleton : nullptr,
            .sky = sky ? &*sky : nullptr,
            .obstacles = whole ? &whole->obstacles : &tree.obstacles};
  }
  void show(std::uint32_t at);
};

/// The tree as it was after step `at`, or at its last.
void Actor::show(std::uint32_t at) {
  at = std::min(at, step_count);
  if (step == at) return;
  step = at;
  tree.skeleton = cut_at(whole->skeleton, step);
  tree.mesh = make_tree_mesh(*tree.skeleton, whole->looks, whole->seed).mesh;
}

/// An actor that grows step by step; its finished tree is on show.
Actor growing(const std::string& input, const InputFlags& reading, const RenderOptions& looks,
              const Session& session) {
  const bool may_have_steps = is_config(input) || is_skeleton_file(input);
  Actor actor;
  if (may_have_steps) {
    actor.whole = read_grown(input, reading, true, session);
    actor.step_count = last_step(actor.whole->skeleton);
  }
  if (actor.step_count == 0) {
    throw InputError(
        fmt::format("--frames: {} has no steps (--turntable N makes a film that turns about it)", input));
  }
  actor.show(actor.step_count);
  for (const std::string& warning : actor.tree.mesh.warnings) warn(warning);
  actor.room = film_room(actor.scene(), actor.whole->skeleton.position, looks.style);
  return actor;
}

/// An actor that stays as it is.
Actor finished(const std::string& input, const InputFlags& reading, const RenderOptions& looks,
               const Session& session) {
  Actor actor;
  actor.tree = read_tree(input, reading, session);
  const Scene scene = actor.scene();
  if (looks.style == RenderStyle::lit) actor.sky = sky_light(actor.tree.mesh, base_of(scene).y);
  actor.room = film_room(scene, scene.skeleton != nullptr ? scene.skeleton->position : std::vector<Vec3>(),
                         looks.style);
  return actor;
}

std::vector<Actor> actors_of(const std::vector<std::string>& inputs, const InputFlags& reading,
                             const RenderOptions& looks, const FilmOptions& film, const Session& session) {
  std::vector<Actor> actors;
  for (const std::string& input : inputs) {
    actors.push_back(film.turntable > 0 ? finished(input, reading, looks, session)
                                        : growing(input, reading, looks, session));
    if (film.turn_deg != 0.0) actors.back().room = swept_room(actors.back().room);
    if (session.stop.stop_requested()) throw Interrupted();
  }
  return actors;
}

std::size_t frame_count_of(const std::vector<Actor>& actors, const FilmOptions& film) {
  std::uint32_t count = static_cast<std::uint32_t>(film.turntable);
  for (const Actor& actor : actors) count = std::max(count, actor.step_count);
  return count;
}

int frames_per_second(const FilmOptions& film, std::size_t frame_count) {
  if (film.frames_per_second > 0) return film.frames_per_second;
  const auto even = std::lround(static_cast<double>(frame_count) / kFilmSeconds);
  return std::clamp(static_cast<int>(even), 1, kMostFramesPerSecond);
}

/// Joins the folder's frames. Says why there is no MP4; empty if there is one. Throws RunError.
std::string write_mp4(const fs::path& folder, int rate) {
  // H.264 wants even sides. A fixed number of threads: x264's bytes depend on it.
  const auto end = run_process({"ffmpeg",
                                "-nostdin",
                                "-loglevel",
                                "error",
                                "-framerate",
                                std::to_string(rate),
                                "-i",
                                (folder / "frame-%04d.png").string(),
                                "-vf",
                                "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
                                "-c:v",
                                "libx264",
                                "-pix_fmt",
                                "yuv420p",
                                "-crf",
                                "18",
                                "-threads",
                                "4",
                                "-movflags",
                                "+faststart",
                                (folder / kMp4).string()});
  if (!end) return "ffmpeg is not installed";
  if (end->code == 0) return {};
  std::error_code ignored;
  fs::remove(folder / kMp4, ignored);
  return fmt::format("ffmpeg failed: {}", end->errors.substr(0, end->errors.find('\n')));
}

}  // namespace

Film make_film(const std::vector<std::string>& inputs, const InputFlags& reading, const RenderOptions& looks,
               const FilmOptions& film, std::size_t columns, const Session& session) {
  ResultFolder folder(film.folder, "ramify render --frames");
  std::vector<Actor> actors = actors_of(inputs, reading, looks, film, session);
  const ThreadLimit limit(reading.running.threads);
  Renderer renderer;
  ProgressBar bar(reading.running.is_quiet);
  Film made;
  made.frame_count = frame_count_of(actors, film);
  made.device = renderer.device();
  RenderOptions options = looks;
  for (std::size_t frame = 0; frame < made.frame_count; ++frame) {
    bar.show({"drawing", static_cast<double>(frame), static_cast<double>(made.frame_count), "frame"});
    options.view.azimuth_deg = looks.view.azimuth_deg + film.turn_deg * static_cast<double>(frame) /
                                                            static_cast<double>(made.frame_count);
    std::vector<Image> images;
    for (Actor& actor : actors) {
      if (actor.whole) actor.show(static_cast<std::uint32_t>(frame + 1));
      options.room_for = actor.room;
      images.push_back(renderer.render(actor.scene(), options));
      if (session.stop.stop_requested()) throw Interrupted();
    }
    const Image picture = contact_sheet(images, columns);
    made.width = picture.width;
    made.height = picture.height;
    std::ostringstream png;
    write_png(picture, png);
    folder.write(fmt::format("frame-{:04}.png", frame + 1), std::move(png).str());
  }
  bar.clear();

  // H.264 has no transparency.
  const bool is_transparent = looks.background && looks.background->a < 1.0f;
  made.why_no_mp4 = is_transparent ? "it could not be transparent"
                                   : write_mp4(folder.staging(), frames_per_second(film, made.frame_count));
  if (made.why_no_mp4.empty()) made.mp4 = film.folder / kMp4;
  if (session.stop.stop_requested()) throw Interrupted();
  folder.commit(session.command_line);
  return made;
}

}  // namespace ramify::cli
