// A picture of a tree, or of two in one, that is drawn anew whenever tree or view change.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/orbit.h"
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

class Pane {
 public:
  /// Draws into a texture of its own, of width x height pixels: kept if nothing changed. `is_fast`: without
  /// antialiasing, for as long as something moves. Returns the texture's OpenGL name, its rows bottom first.
  /// Needs a current context. Throws GraphicsError.
  unsigned picture(const std::vector<Exhibit>& exhibits, const ShowOptions& show, const Orbit& orbit,
                   int width, int height, bool is_fast);

  /// Width over height of the last picture.
  double aspect() const { return height_ > 0 ? static_cast<double>(width_) / height_ : 1.0; }

  /// The last picture, read back.
  Image image() const;

  /// Around all that was drawn.
  const Box& box() const { return box_; }

  /// A sentence on what could not be shown as asked for; empty if all could.
  const std::string& notice() const { return notice_; }

 private:
  /// What a painter has loaded.
  struct Loaded {
    Painter painter;
    std::uint64_t serial = 0;  // of the product
    ShowOptions show;
    std::optional<Color> tint;
  };

  void load(Loaded& loaded, const Exhibit& exhibit, const ShowOptions& show);
  void draw(const Orbit& orbit);

  std::vector<std::unique_ptr<Loaded>> loaded_;
  std::unique_ptr<RenderTarget> target_;
  int width_ = 0;
  int height_ = 0;
  bool is_fast_ = false;
  int shrink_ = 1;  // the picture's pixels for one of the texture, each way, while something moves
  Orbit orbit_;
  bool is_stale_ = true;
  Box box_;
  std::string notice_;
};

}  // namespace ramify
