#include "viewer/pane.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>
#include <string_view>

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

// Seconds a part of a picture that is drawn gradually.
constexpr double kMoment = 0.12;
constexpr std::size_t kSmallestPart = 20'000;  // triangles

// Seconds that kAtRest may take for kFinest to come after it: the window is not to stand still.
constexpr double kQuickAtRest = 0.08;

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Whether the processor draws: then very many triangles take seconds.
bool is_drawn_in_software() {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name != nullptr &&
         std::string_view(reinterpret_cast<const char*>(name)).find("pipe") != std::string_view::npos;
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
  loaded.coarse.reset();
  loaded.options = options;
  loaded.is_fine = true;
  loaded.shadowed = std::numeric_limits<std::size_t>::max();
  const bool is_gradual = options.style != RenderStyle::skeleton && exhibits_at_once_ == 1 &&
                          !exhibit.product->coarse.triangles.empty() && is_drawn_in_software();
  if (is_gradual) {
    load_coarse(loaded, *exhibit.product, show);
  } else {
    loaded.painter.load(scene, options);
    if (options.style == RenderStyle::lit) {
      loaded.painter.cast_shadows(scene, sun(), options.with_occlusion ? kShadowMapSize : 64);
    }
  }
  loaded.overlay.load(*exhibit.product, show.layers, show.are_slices);
  loaded.base = base_of(scene);
  loaded.serial = exhibit.product->serial;
  loaded.show = show;
  loaded.tint = exhibit.tint;
}

/// What is drawn at once; the fine mesh comes later.
void Pane::load_coarse(Loaded& loaded, const Product& product, const ShowOptions& show) {
  Scene scene = scene_of(product, show);
  scene.mesh = &product.coarse;
  loaded.coarse = std::make_unique<Painter>();
  loaded.coarse->load(scene, loaded.options);
  loaded.is_fine = false;
  if (loaded.options.style != RenderStyle::lit) return;
  loaded.coarse->cast_shadows(scene, sun(), kShadowMapSize);
  loaded.shadowed = 0;
}

unsigned Pane::picture(const std::vector<Exhibit>& exhibits, const ShowOptions& show, const Orbit& orbit,
                       int width, int height, Quality quality) {
  const double start = now_seconds();
  is_stale_ = is_stale_ || loaded_.size() != exhibits.size() || orbit_ != orbit || quality_ != quality;
  // Of two trees in one picture each hides parts of the other: they are drawn in one go.
  if (exhibits_at_once_ != exhibits.size()) loaded_.clear();
  exhibits_at_once_ = exhibits.size();
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
  if (!is_stale_ && is_unfinished_ && quality != Quality::moving) draw_more(exhibits.front());
  is_stale_ = false;
  return (shows_gradual_ ? gradual_target_ : target_)->target.picture().id();
}

void Pane::draw_anew() {
  shows_gradual_ = false;
  is_unfinished_ = loaded_.size() == 1 && loaded_.front()->coarse;
  drawn_triangles_ = 0;
  if (quality_ == Quality::moving || is_unfinished_) {
    const double seconds = draw(kMoving);
    if (quality_ != Quality::moving) return;
    if (seconds > kSlow) shrink_ = 2;
    if (seconds < kQuick) shrink_ = 1;
  } else if (quality_ == Quality::finest || draw(kAtRest) < kQuickAtRest) {
    draw(kFinest);
  }
}

Image Pane::image() const {
  Image image{width_, height_, {}};
  const std::unique_ptr<Target>& shown = shows_gradual_ ? gradual_target_ : target_;
  if (!shown) return image;
  const std::size_t row = 4 * static_cast<std::size_t>(width_);
  std::vector<std::uint8_t> rows(row * height_);
  shown->target.read(width_, height_, rows.data());
  for (int y = height_ - 1; y >= 0; --y) {
    image.rgba.insert(image.rgba.end(), rows.begin() + row * y, rows.begin() + row * (y + 1));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return image;
}

/// Upright, beside the tree, and turned to the viewer.
void Pane::stand_figure(Painter& painter, const Loaded& loaded) const {
  painter.load_annotations(annotations_beside(box_, loaded.base, orbit_.azimuth_deg), loaded.base,
                           camera_axes(orbit_.azimuth_deg, 0.0));
}

/// A target as large as the picture.
void Pane::require(std::unique_ptr<Target>& target, const Sampling& sampling) const {
  if (target && target->width == width_ && target->height == height_ &&
      target->target.sampling() == sampling) {
    return;
  }
  target.reset();
  target = std::make_unique<Target>(width_, height_, sampling);
}

/// Returns the seconds it took.
double Pane::draw(const Sampling& sampling) {
  require(target_, sampling);
  const double start = now_seconds();
  target_->target.begin();
  draw_exhibits(sampling, {}, true);
  finish(*target_);
  return now_seconds() - start;
}

/// Into the framebuffer that is bound; `is_coarse`: trees of very many triangles by their coarse meshes.
void Pane::draw_exhibits(const Sampling& sampling, const TreePart& part, bool is_coarse) {
  const double aspect = static_cast<double>(width_) / height_;
  double reach = 0.0;
  for (const auto& loaded : loaded_) {
    reach = std::max(reach, (loaded->coarse ? *loaded->coarse : loaded->painter).reach());
  }
  const Camera camera = camera_of(orbit_, aspect, box_, reach);
  Viewport viewport;
  viewport.width = sampling.fineness * width_;
  viewport.height = sampling.fineness * height_;
  viewport.fineness = sampling.fineness * display_scale();
  for (std::size_t index = 0; index < loaded_.size(); ++index) {
    Loaded& loaded = *loaded_[index];
    Painter& painter = is_coarse && loaded.coarse ? *loaded.coarse : loaded.painter;
    if (index == 0 && loaded.show.with_scale && part.is_first()) stand_figure(painter, loaded);
    if (index == 0) {
      painter.draw(camera, viewport, part);
    } else {
      painter.draw_over(camera, viewport);
    }
    if (part.end >= painter.triangle_count()) loaded.overlay.draw(camera, viewport);
  }
}

/// Waits until it is drawn, for the next one to know how long that takes.
void Pane::finish(Target& target) const {
  target.target.finish(width_, height_);
  glBindTexture(GL_TEXTURE_2D, target.target.picture().id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glFinish();
}

/// Takes over the fine mesh, or draws a part of its shadows, or of the picture, which is shown when it is
/// whole.
void Pane::draw_more(const Exhibit& exhibit) {
  Loaded& loaded = *loaded_.front();
  if (!loaded.is_fine) {
    loaded.painter.load(scene_of(*exhibit.product, loaded.show), loaded.options);
    loaded.is_fine = true;
    return;
  }
  const Sampling& sampling = quality_ == Quality::finest ? kFinest : kAtRest;
  const std::size_t total = loaded.painter.triangle_count();
  const bool is_casting = loaded.shadowed < total;
  std::size_t& done = is_casting ? loaded.shadowed : drawn_triangles_;
  TreePart part{.first = done};
  if (done + part_size_ < total) part.end = done + part_size_;
  const double start = now_seconds();
  if (is_casting) {
    loaded.painter.cast_shadows(scene_of(*exhibit.product, loaded.show), sun(), kShadowMapSize, part);
  } else {
    require(gradual_target_, sampling);
    gradual_target_->target.begin();
    draw_exhibits(sampling, part, false);
    is_unfinished_ = part.end < total;
    shows_gradual_ = !is_unfinished_;
    if (!is_unfinished_) finish(*gradual_target_);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glFinish();
  done = std::min(part.end, total);
  const double seconds = std::max(now_seconds() - start, 1e-4);
  const double wanted = static_cast<double>(part_size_) * std::clamp(kMoment / seconds, 0.25, 4.0);
  part_size_ = std::max(kSmallestPart, static_cast<std::size_t>(wanted));
  if (!is_unfinished_) ++drawn_count_;
}

}  // namespace ramify
