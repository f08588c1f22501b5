// A tree on its way to the graphics device, step by step, so that a window never waits long for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "viewer/overlay.h"
#include "viewer/painter.h"
#include "viewer/show_options.h"
#include "viewer/workshop.h"

namespace ramify {

/// A tree in a pane.
struct Exhibit {
  const Product* product = nullptr;
  std::optional<Color> tint;  // to tell two in one picture apart
};

/// What trees are drawn with; panes in one window share it.
struct Programs {
  std::shared_ptr<const PaintPrograms> painter = std::make_shared<const PaintPrograms>();
  std::shared_ptr<const OverlayPrograms> overlay = std::make_shared<const OverlayPrograms>();
};

/// How many triangles are drawn in one go: in software as many as take a moment, which drawing tells; else
/// all.
class Portion {
 public:
  explicit Portion(bool is_limited) : is_limited_(is_limited) {}

  /// What comes after the first `done` of `total` triangles. The last part has none of them, but takes a
  /// moment, too.
  TreePart next(std::size_t done, std::size_t total) const;

  /// Learns from what such a part took.
  void took(const TreePart& part, double seconds);

  bool is_limited() const { return is_limited_; }

 private:
  bool is_limited_;
  std::size_t size_ = 50'000;  // triangles
};

class StagedTree {
 public:
  /// Nothing is loaded yet. `has_coarse`: a tree of very many triangles gets its coarse mesh beside it.
  StagedTree(const Programs& programs, const Exhibit& exhibit, const ShowOptions& show, bool has_coarse);

  bool shows(const Exhibit& exhibit, const ShowOptions& show) const;

  /// Whether quick() can be drawn, and whether fine() can.
  bool is_quick() const { return stage_ >= Stage::load_fine; }
  bool is_fine() const { return stage_ == Stage::done; }

  /// Does a little of what is still to be done until the tree is fine, with the exhibit it was made for.
  void step(const Exhibit& exhibit, Portion& portion);

  /// What is drawn while something moves: of a tree of very many triangles its coarse mesh.
  Painter& quick() { return coarse_ ? *coarse_ : fine_; }
  Painter& fine() { return fine_; }
  const Overlay& overlay() const { return overlay_; }

  const Vec3& base() const { return base_; }
  const Box& box() const { return box_; }
  bool with_scale() const { return show_.with_scale; }

  /// A sentence on what could not be shown as asked for; empty if all could.
  const std::string& notice() const { return notice_; }

 private:
  enum class Stage { begin_quick, load_quick, shade_quick, lay_over, load_fine, shade_fine, done };

  RenderOptions options_of(const Exhibit& exhibit);
  void load(Painter& painter);
  void shade(Painter& painter, const Scene& scene, Portion& portion);
  void advance();

  ShowOptions show_;
  std::optional<Color> tint_;
  std::uint64_t serial_ = 0;  // of the product
  std::string notice_;
  RenderOptions options_;
  Vec3 base_{0.0};
  Box box_;
  Painter fine_;
  std::unique_ptr<Painter> coarse_;
  Overlay overlay_;
  Stage stage_ = Stage::begin_quick;
  std::size_t shaded_ = 0;  // triangles that cast their shadows
};

}  // namespace ramify
