// A picture of a tree, or of two in one, that is drawn anew whenever tree or view change.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/orbit.h"
#include "viewer/overlay.h"
#include "viewer/painter.h"
#include "viewer/render_target.h"
#include "viewer/show_options.h"
#include "viewer/workshop.h"

namespace ramify {

/// A tree in a pane.
struct Exhibit {
  const Product* product = nullptr;
  std::optional<Color> tint;  // to tell two in one picture apart
};

/// How finely a picture is drawn.
enum class Quality {
  moving,   // soon: no antialiasing, on a slow device with half the pixels each way
  at_rest,  // finest, where that takes no longer than a blink
  finest,
};

class Pane {
 public:
  /// Draws into a texture of its own, of width x height pixels: kept if nothing changed. Returns the
  /// texture's OpenGL name, its rows bottom first. Needs a current context. Throws GraphicsError.
  unsigned picture(const std::vector<Exhibit>& exhibits, const ShowOptions& show, const Orbit& orbit,
                   int width, int height, Quality quality);

  /// How often it was drawn, and the seconds that the last time took, loading the tree included.
  std::size_t drawn_count() const { return drawn_count_; }
  double last_seconds() const { return last_seconds_; }

  /// Width over height of the last picture.
  double aspect() const { return height_ > 0 ? static_cast<double>(width_) / height_ : 1.0; }

  /// The last picture, read back.
  Image image() const;

  /// A sentence on what could not be shown as asked for; empty if all could.
  const std::string& notice() const { return notice_; }

 private:
  /// What a painter has loaded.
  struct Loaded {
    Painter painter;
    Overlay overlay;
    Vec3 base{0.0};
    std::uint64_t serial = 0;  // of the product
    ShowOptions show;
    std::optional<Color> tint;
  };

  void load(Loaded& loaded, const Exhibit& exhibit, const ShowOptions& show);
  void draw_anew();
  double draw(const Sampling& sampling);
  void stand_figure(Loaded& loaded, const Orbit& orbit) const;

  std::vector<std::unique_ptr<Loaded>> loaded_;
  std::unique_ptr<RenderTarget> target_;
  int target_width_ = 0;
  int target_height_ = 0;
  int width_ = 0;
  int height_ = 0;
  Quality quality_ = Quality::at_rest;
  int shrink_ = 1;  // the picture's pixels for one of the texture, each way, while something moves
  Orbit orbit_;
  bool is_stale_ = true;
  Box box_;
  std::string notice_;
  std::size_t drawn_count_ = 0;
  double last_seconds_ = 0.0;
};

}  // namespace ramify
