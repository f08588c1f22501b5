#include "viewer/pane.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>

#include "common/mesh/attribute_colors.h"
#include "viewer/theme.h"

namespace ramify {
namespace {

// Seconds that a picture may take while something moves; slower ones are drawn with half the pixels each way.
constexpr double kSlow = 0.05;
constexpr double kQuick = 0.012;

constexpr int kShadowMapSize = 2048;

constexpr Sampling kMoving{.fineness = 1, .samples = 1};
constexpr Sampling kAtRest{.fineness = 1, .samples = 4};

constexpr Sampling kFinest{.fineness = 2, .samples = 4};

// Seconds that kAtRest may take for kFinest to come after it: the window is not to stand still.
constexpr double kQuickAtRest = 0.08;

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The sun stays where it is while the viewer walks around.
CameraAxes sun() {
  return sun_behind({});
}

Scene scene_of(const Product& product, const ShowOptions& show) {
  const bool has_skeleton = product.skeleton.node_count() > 0;
  return {.mesh = &product.mesh,
          .skeleton = has_skeleton ? &product.skeleton : nullptr,
          .sky = product.sky.visibility.empty() ? nullptr : &product.sky,
          .obstacles = show.layers.count(kObstacles) > 0 ? &product.obstacles : nullptr};
}

}  // namespace

void Pane::load(Loaded& loaded, const Exhibit& exhibit, const ShowOptions& show) {
  const Scene scene = scene_of(*exhibit.product, show);
  RenderOptions options;
  options.style = show.style;
  options.tint = exhibit.tint;
  options.with_occlusion = !exhibit.product->is_draft;
  if (scene.skeleton == nullptr && show.style == RenderStyle::skeleton) {
    options.style = RenderStyle::lit;
    notice_ = "a mesh without a skeleton has no lines to show";
  }
  if (!show.color_by.empty()) {
    std::vector<std::string> known;
    if (scene.skeleton != nullptr) known = color_attributes(*scene.skeleton);
    if (std::find(known.begin(), known.end(), show.color_by) != known.end()) {
      options.color_by = show.color_by;
    } else {
      notice_ = fmt::format("this tree has no attribute '{}'", show.color_by);
    }
  }
  loaded.painter.load(scene, options);
  if (options.style == RenderStyle::lit) {
    loaded.painter.cast_shadows(scene, sun(), options.with_occlusion ? kShadowMapSize : 64);
  }
  loaded.overlay.load(*exhibit.product, show.layers, show.are_slices);
  loaded.base = base_of(scene);
  loaded.serial = exhibit.product->serial;
  loaded.show = show;
  loaded.tint = exhibit.tint;
}

unsigned Pane::picture(const std::vector<Exhibit>& exhibits, const ShowOptions& show, const Orbit& orbit,
                       int width, int height, Quality quality) {
  const double start = now_seconds();
  is_stale_ = is_stale_ || loaded_.size() != exhibits.size() || orbit_ != orbit || quality_ != quality;
  loaded_.resize(exhibits.size());
  Box box;
  for (std::size_t index = 0; index < exhibits.size(); ++index) {
    const Exhibit& exhibit = exhibits[index];
    box.include(exhibit.product->box);
    std::unique_ptr<Loaded>& loaded = loaded_[index];
    if (!loaded) loaded = std::make_unique<Loaded>();
    if (loaded->serial == exhibit.product->serial && loaded->show == show && loaded->tint == exhibit.tint) {
      continue;
    }
    notice_.clear();
    load(*loaded, exhibit, show);
    is_stale_ = true;
  }
  box_ = box;
  const int shrink = quality == Quality::moving ? shrink_ : 1;
  width = std::max(1, width / shrink);
  height = std::max(1, height / shrink);
  is_stale_ = is_stale_ || width_ != width || height_ != height;
  width_ = width;
  height_ = height;
  quality_ = quality;
  orbit_ = orbit;
  if (is_stale_) {
    draw_anew();
    ++drawn_count_;
    last_seconds_ = now_seconds() - start;
  }
  is_stale_ = false;
  return target_->picture().id();
}

void Pane::draw_anew() {
  if (quality_ == Quality::moving) {
    const double seconds = draw(kMoving);
    if (seconds > kSlow) shrink_ = 2;
    if (seconds < kQuick) shrink_ = 1;
  } else if (quality_ == Quality::finest || draw(kAtRest) < kQuickAtRest) {
    draw(kFinest);
  }
}

Image Pane::image() const {
  Image image{width_, height_, {}};
  if (!target_) return image;
  const std::size_t row = 4 * static_cast<std::size_t>(width_);
  std::vector<std::uint8_t> rows(row * height_);
  target_->read(width_, height_, rows.data());
  for (int y = height_ - 1; y >= 0; --y) {
    image.rgba.insert(image.rgba.end(), rows.begin() + row * y, rows.begin() + row * (y + 1));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return image;
}

/// Upright, beside the tree, and turned to the viewer.
void Pane::stand_figure(Loaded& loaded, const Orbit& orbit) const {
  loaded.painter.load_annotations(annotations_beside(box_, loaded.base, orbit.azimuth_deg), loaded.base,
                                  camera_axes(orbit.azimuth_deg, 0.0));
}

/// Returns the seconds it took.
double Pane::draw(const Sampling& sampling) {
  if (!target_ || target_width_ != width_ || target_height_ != height_ || target_->sampling() != sampling) {
    target_.reset();
    target_ = std::make_unique<RenderTarget>(width_, height_, sampling);
    target_width_ = width_;
    target_height_ = height_;
  }
  const double start = now_seconds();
  const double aspect = static_cast<double>(width_) / height_;
  double reach = 0.0;
  for (const auto& loaded : loaded_) reach = std::max(reach, loaded->painter.reach());
  for (const auto& loaded : loaded_) {
    if (loaded->show.with_scale && loaded == loaded_.front()) stand_figure(*loaded, orbit_);
  }
  const Camera camera = camera_of(orbit_, aspect, box_, reach);
  Viewport viewport;
  viewport.width = sampling.fineness * width_;
  viewport.height = sampling.fineness * height_;
  viewport.fineness = sampling.fineness * display_scale();
  target_->begin();
  for (std::size_t index = 0; index < loaded_.size(); ++index) {
    if (index == 0) {
      loaded_[index]->painter.draw(camera, viewport);
    } else {
      loaded_[index]->painter.draw_over(camera, viewport);
    }
    loaded_[index]->overlay.draw(camera, viewport);
  }
  target_->finish(width_, height_);
  glBindTexture(GL_TEXTURE_2D, target_->picture().id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glFinish();
  return now_seconds() - start;
}

}  // namespace ramify
