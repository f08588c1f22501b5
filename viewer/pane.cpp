#include "viewer/pane.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

#include "viewer/theme.h"

namespace ramify {
namespace {

// Seconds that a picture may take while something moves; slower ones are drawn with half the pixels each way.
constexpr double kSlow = 0.05;
constexpr double kQuick = 0.012;

// Seconds that one call may take for bringing a tree, if that can wait.
constexpr double kMoment = 0.03;

// Where the processor draws, more triangles than this are no quick picture: the last one stays meanwhile.
constexpr std::size_t kMostQuickTriangles = 600'000;

// Seconds that a picture at rest may take for the finest to come after it: at once, the window is not to
// stand still, little by little, the processor is not to work for long.
constexpr double kQuickAtRest = 0.08;
constexpr double kQuickGradual = 1.0;

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Sampling sampling_of(Quality quality) {
  switch (quality) {
    case Quality::moving:
      return {.fineness = 1, .samples = 1};
    case Quality::at_rest:
      return {.fineness = 1, .samples = 4};
    case Quality::finest:
      break;
  }
  return {.fineness = 2, .samples = 4};
}

}  // namespace

unsigned Pane::picture(const std::vector<Exhibit>& exhibits, const ShowOptions& show, const Orbit& orbit,
                       int width, int height, Quality quality) {
  choose(exhibits, show);
  const bool are_new = bring(exhibits);
  is_unfinished_ = true;
  if (shown_.empty()) return 0;
  const View view{orbit, width, height};
  const bool is_stale = are_new || view != view_ || on_show_ == nullptr;
  const bool is_other_quality = quality != quality_;
  view_ = view;
  quality_ = quality;
  if (is_stale || is_other_quality) {
    draw_anew(is_stale);
  } else if (is_drawing_ && shown_ == wanted_) {
    draw_more(exhibits);
  }
  is_unfinished_ = is_drawing_ || shown_ != wanted_;
  return on_show_ == nullptr ? 0 : on_show_->target.picture().id();
}

/// Those that are there already stay.
void Pane::choose(const std::vector<Exhibit>& exhibits, const ShowOptions& show) {
  const auto is_same = [&](const Exhibit& exhibit, const std::shared_ptr<StagedTree>& tree) {
    return tree->shows(exhibit, show);
  };
  if (std::equal(exhibits.begin(), exhibits.end(), wanted_.begin(), wanted_.end(), is_same)) return;
  Trees trees;
  for (const Exhibit& exhibit : exhibits) {
    const auto known = std::find_if(wanted_.begin(), wanted_.end(),
                                    [&](const auto& tree) { return is_same(exhibit, tree); });
    trees.push_back(known != wanted_.end()
                        ? *known
                        : std::make_shared<StagedTree>(programs_, exhibit, show, portion_.is_limited()));
  }
  wanted_ = std::move(trees);
  notice_.clear();
  for (const auto& tree : wanted_) {
    if (notice_.empty()) notice_ = tree->notice();
  }
}

/// Whether the trees that are wanted are shown now and were not before. A draft, which follows a slider,
/// comes at once, others when they can.
bool Pane::bring(const std::vector<Exhibit>& exhibits) {
  if (shown_ == wanted_) return false;
  const bool can_wait = std::none_of(exhibits.begin(), exhibits.end(),
                                     [](const Exhibit& exhibit) { return exhibit.product->is_draft; });
  Portion all(false);
  const double end = now_seconds() + kMoment;
  for (std::size_t index = 0; index < wanted_.size(); ++index) {
    while (!wanted_[index]->is_quick()) {
      if (can_wait && now_seconds() > end) return false;
      wanted_[index]->step(exhibits[index], can_wait ? portion_ : all);
    }
  }
  shown_ = wanted_;
  box_ = Box();
  for (const auto& tree : shown_) box_.include(tree->box());
  return true;
}

/// `is_stale`: the picture on show is of other trees, or of another view of them.
void Pane::draw_anew(bool is_stale) {
  is_drawing_ = false;
  if (quality_ == Quality::moving) return draw_quick();
  if (portion_.is_limited()) {
    std::size_t quick = 0;
    for (const auto& tree : shown_) quick += tree->quick().triangle_count();
    if (is_stale && quick <= kMostQuickTriangles) draw_quick();
    return begin_drawing(quality_);
  }
  if (quality_ == Quality::finest || draw_at_once(Quality::at_rest, 1) < kQuickAtRest) {
    draw_at_once(Quality::finest, 1);
  }
}

void Pane::draw_quick() {
  const double seconds = draw_at_once(Quality::moving, shrink_);
  if (quality_ != Quality::moving) return;
  if (seconds > kSlow) shrink_ = 2;
  if (seconds < kQuick) shrink_ = 1;
}

/// Returns the seconds it took.
double Pane::draw_at_once(Quality quality, int shrink) {
  Target& target = require(quality, shrink);
  const double start = now_seconds();
  target.target.begin();
  for (std::size_t index = 0; index < shown_.size(); ++index) draw_tree(index, false, {}, target);
  show(target);
  last_seconds_ = now_seconds() - start;
  return last_seconds_;
}

void Pane::begin_drawing(Quality quality) {
  is_drawing_ = true;
  drawing_ = quality;
  tree_ = 0;
  triangles_ = 0;
  seconds_ = 0.0;
}

/// Goes on for a moment with bringing the fine meshes, or with the picture.
void Pane::draw_more(const std::vector<Exhibit>& exhibits) {
  const double start = now_seconds();
  std::size_t coarse = 0;  // the first tree that is
  do {
    while (coarse < shown_.size() && shown_[coarse]->is_fine()) ++coarse;
    if (coarse < shown_.size()) {
      shown_[coarse]->step(exhibits[coarse], portion_);
    } else {
      draw_part();
    }
  } while (is_drawing_ && now_seconds() < start + kMoment);
  seconds_ += now_seconds() - start;
  if (is_drawing_) return;
  last_seconds_ = seconds_;
  if (drawing_ == Quality::at_rest && seconds_ < kQuickGradual) begin_drawing(Quality::finest);
}

/// A part of the picture, which is shown when it is whole.
void Pane::draw_part() {
  Target& target = require(drawing_, 1);
  if (tree_ == shown_.size()) {
    is_drawing_ = false;
    return show(target);
  }
  target.target.begin();
  const double start = now_seconds();
  const TreePart part = portion_.next(triangles_, shown_[tree_]->fine().triangle_count());
  draw_tree(tree_, true, part, target);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glFinish();
  portion_.took(part, now_seconds() - start);
  triangles_ = part.end;
  if (!part.is_last()) return;
  ++tree_;
  triangles_ = 0;
}

Image Pane::image() const {
  if (on_show_ == nullptr) return {};
  Image image{on_show_->width, on_show_->height, {}};
  const std::size_t row = 4 * static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> rows(row * image.height);
  on_show_->target.read_finished(image.width, image.height, rows.data());
  for (int y = image.height - 1; y >= 0; --y) {
    image.rgba.insert(image.rgba.end(), rows.begin() + row * y, rows.begin() + row * (y + 1));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return image;
}

/// A target as large as the picture.
Pane::Target& Pane::require(Quality quality, int shrink) {
  std::unique_ptr<Target>& target = targets_[static_cast<std::size_t>(quality)];
  const int width = std::max(1, view_.width / shrink);
  const int height = std::max(1, view_.height / shrink);
  if (target && target->width == width && target->height == height) return *target;
  if (on_show_ == target.get()) on_show_ = nullptr;
  target.reset();
  target = std::make_unique<Target>(width, height, sampling_of(quality));
  return *target;
}

/// Into the target, which is bound; `is_fine`: not by the coarse mesh that a tree of very many triangles has.
void Pane::draw_tree(std::size_t index, bool is_fine, const TreePart& part, const Target& target) const {
  const auto painter_of = [&](const std::shared_ptr<StagedTree>& tree) -> Painter& {
    return is_fine ? tree->fine() : tree->quick();
  };
  double reach = 0.0;
  for (const auto& tree : shown_) reach = std::max(reach, painter_of(tree).reach());
  const double aspect = static_cast<double>(target.width) / target.height;
  const Camera camera = camera_of(view_.orbit, aspect, box_, reach);
  const int fineness = target.target.sampling().fineness;
  Viewport viewport;
  viewport.width = fineness * target.width;
  viewport.height = fineness * target.height;
  viewport.fineness = fineness * display_scale();

  const StagedTree& tree = *shown_[index];
  Painter& painter = painter_of(shown_[index]);
  if (index == 0 && tree.with_scale() && part.is_first()) {
    // Upright, beside the trees, and turned to the viewer.
    const double azimuth = view_.orbit.azimuth_deg;
    painter.load_annotations(annotations_beside(box_, tree.base(), azimuth), tree.base(),
                             camera_axes(azimuth, 0.0));
  }
  if (index == 0) {
    painter.draw(camera, viewport, part);
  } else {
    painter.draw_over(camera, viewport, part);
  }
  if (part.is_last()) tree.overlay().draw(camera, viewport);
}

/// Waits until it is drawn, for the next one to know how long that takes.
void Pane::show(Target& target) {
  target.target.finish(target.width, target.height);
  glBindTexture(GL_TEXTURE_2D, target.target.picture().id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glFinish();
  on_show_ = &target;
  ++drawn_count_;
}

}  // namespace ramify
