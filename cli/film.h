// Films: numbered pictures in a folder, and an MP4 of them by ffmpeg (https://ffmpeg.org) where it is
// installed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/inputs.h"
#include "viewer/scene.h"

namespace ramify::cli {

struct FilmOptions {
  std::filesystem::path folder;
  int turntable = 0;          // frames around the finished trees; 0: a frame a step, or level
  double turn_deg = 0.0;      // of the camera over the whole film
  int frames_per_second = 0;  // of the MP4; 0: so that it lasts about six seconds
};

/// A film that was made.
struct Film {
  std::size_t frame_count = 0;
  int width = 0;  // pixels
  int height = 0;
  std::string device;         // that drew it
  std::filesystem::path mp4;  // empty where there is none
  std::string why_no_mp4;     // a phrase
};

/// Draws the film of these inputs, side by side in rows of `columns`, into the folder: frame-0001.png and so
/// on, film.mp4. An input that has fewer steps than another stands still at its last. Frame K of a film of
/// steps is what `--at-step K` draws, the camera apart, which is the same in all frames. Throws InputError
/// for an input without steps, RunError, Interrupted.
Film make_film(const std::vector<std::string>& inputs, const InputFlags& reading, const RenderOptions& looks,
               const FilmOptions& film, std::size_t columns, const Session& session);

}  // namespace ramify::cli
