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

  /// Whether the picture is coarse yet: more calls of picture() make it as fine as it was asked for.
  bool is_unfinished() const { return is_unfinished_; }

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
    std::unique_ptr<Painter> coarse;  // of a tree of very many triangles
    RenderOptions options;            // that the fine one is to be loaded with
    bool is_fine = true;              // whether it was
    std::size_t shadowed = 0;         // of its triangles, those that cast their shadows
    Overlay overlay;
    Vec3 base{0.0};
    std::uint64_t serial = 0;  // of the product
    ShowOptions show;
    std::optional<Color> tint;
  };

  /// With the size that it was made for.
  struct Target {
    RenderTarget target;
    int width;
    int height;

    Target(int w, int h, const Sampling& sampling) : target(w, h, sampling), width(w), height(h) {}
  };

  void load(Loaded& loaded, const Exhibit& exhibit, const ShowOptions& show);
  void load_coarse(Loaded& loaded, const Product& product, const ShowOptions& show);
  void draw_anew();
  double draw(const Sampling& sampling);
  void draw_exhibits(const Sampling& sampling, const TreePart& part, bool is_coarse);
  void require(std::unique_ptr<Target>& target, const Sampling& sampling) const;
  void finish(Target& target) const;
  void draw_more(const Exhibit& exhibit);
  void stand_figure(Painter& painter, const Loaded& loaded) const;

  std::vector<std::unique_ptr<Loaded>> loaded_;
  std::unique_ptr<Target> target_;
  std::unique_ptr<Target> gradual_target_;  // in which a picture is drawn part by part
  std::size_t drawn_triangles_ = 0;         // in it
  std::size_t part_size_ = 100'000;         // triangles that take a moment
  bool is_unfinished_ = false;
  bool shows_gradual_ = false;
  std::size_t exhibits_at_once_ = 0;
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
