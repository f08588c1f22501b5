// A picture of a tree, or of two in one, that is drawn anew whenever tree or view change.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "viewer/orbit.h"
#include "viewer/render_target.h"
#include "viewer/show_options.h"
#include "viewer/staged_tree.h"

namespace ramify {

/// How finely a picture is drawn.
enum class Quality {
  moving,   // soon: no antialiasing, on a slow device with half the pixels each way
  at_rest,  // finest, where that takes no longer than a blink
  finest,
};

class Pane {
 public:
  /// `is_gradual`: pictures at rest are drawn part by part over many calls, where the processor draws.
  Pane(Programs programs, bool is_gradual) : programs_(std::move(programs)), portion_(is_gradual) {}

  /// Draws into a texture of its own, of width x height pixels: kept if nothing changed. Returns the
  /// texture's OpenGL name, its rows bottom first; 0 while there is none. What takes long is done little by
  /// little: until then the last picture stays. Needs a current context. Throws GraphicsError.
  unsigned picture(const std::vector<Exhibit>& exhibits, const ShowOptions& show, const Orbit& orbit,
                   int width, int height, Quality quality);

  /// Whether more calls of picture() make it what was asked for.
  bool is_unfinished() const { return is_unfinished_; }

  /// How often it was drawn, and the seconds that the last time took.
  std::size_t drawn_count() const { return drawn_count_; }
  double last_seconds() const { return last_seconds_; }

  /// Width over height of the last picture.
  double aspect() const { return view_.height > 0 ? static_cast<double>(view_.width) / view_.height : 1.0; }

  /// The picture on show, read back.
  Image image() const;

  /// A sentence on what could not be shown as asked for; empty if all could.
  const std::string& notice() const { return notice_; }

 private:
  struct View {
    Orbit orbit;
    int width = 0;
    int height = 0;

    bool operator==(const View&) const = default;
  };

  /// With the size that it was made for.
  struct Target {
    RenderTarget target;
    int width;
    int height;

    Target(int w, int h, const Sampling& sampling) : target(w, h, sampling), width(w), height(h) {}
  };

  using Trees = std::vector<std::shared_ptr<StagedTree>>;

  void choose(const std::vector<Exhibit>& exhibits, const ShowOptions& show);
  bool bring(const std::vector<Exhibit>& exhibits);
  void draw_anew(bool is_stale);
  void draw_quick();
  double draw_at_once(Quality quality, int shrink);
  void begin_drawing(Quality quality);
  void draw_more(const std::vector<Exhibit>& exhibits);
  void draw_part();
  void draw_tree(std::size_t index, bool is_fine, const TreePart& part, const Target& target) const;
  Target& require(Quality quality, int shrink);
  void show(Target& target);

  Programs programs_;
  Portion portion_;
  Trees wanted_;                                    // on their way to take the place of
  Trees shown_;                                     // which can be drawn quickly
  std::array<std::unique_ptr<Target>, 3> targets_;  // by quality
  const Target* on_show_ = nullptr;

  Box box_;                             // of the trees on show
  View view_;                           // of the picture on show
  Quality quality_ = Quality::at_rest;  // that it is to have
  bool is_unfinished_ = false;
  int shrink_ = 1;  // the picture's pixels for one of the texture, each way, while something moves

  // The picture at rest that is being drawn.
  bool is_drawing_ = false;
  Quality drawing_ = Quality::at_rest;
  std::size_t tree_ = 0;       // of those shown, that is being drawn
  std::size_t triangles_ = 0;  // of it, that are drawn
  double seconds_ = 0.0;       // spent on it

  std::string notice_;
  std::size_t drawn_count_ = 0;
  double last_seconds_ = 0.0;
};

}  // namespace ramify
