// Small pictures of all presets, to choose a tree by its looks. They are made one after the other beside the
// window, those in sight first.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/pane.h"
#include "viewer/workshop.h"

namespace ramify {

struct Preset;
struct Workbench;

class Gallery {
 public:
  explicit Gallery(Pane pane);

  /// Draws the strip into the ImGui window that is open; a click opens the preset in the active seat, with
  /// Shift beside it. Nothing is made while `is_busy`: trees that are worked on come first.
  void show(Workbench& bench, bool is_busy);

  /// Whether the strip, if it was shown in this frame, has more to draw without anything happening.
  bool is_drawing() const;

  static float height();

 private:
  struct Thumbnail {
    std::optional<GlTexture> texture;  // nothing where the preset makes no tree
  };

  void make_next(Workbench& bench);
  void draw();

  std::vector<const Preset*> presets_;  // in the order of the strip
  Pane pane_;
  std::unique_ptr<Product> product_;  // that is being drawn
  int last_frame_ = -1;               // in which the strip was shown
  std::map<std::string, Thumbnail, std::less<>> thumbnails_;
  std::string wanted_;  // the first in sight that is missing
  std::string making_;
  Workshop workshop_;
};

}  // namespace ramify
