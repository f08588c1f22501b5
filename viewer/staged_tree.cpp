#include "viewer/staged_tree.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "common/mesh/attribute_colors.h"

namespace ramify {
namespace {

constexpr int kShadowMapSize = 2048;
constexpr int kNoShadowMapSize = 64;

// Seconds a part of a picture that is drawn gradually. However few triangles it has, it goes over all pixels.
constexpr double kMoment = 0.08;
constexpr std::size_t kSmallestPart = 50'000;  // triangles

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The sun stays where it is while the viewer walks around.
CameraAxes sun() {
  return sun_behind({});
}

Scene scene_of(const Product& product, const ShowOptions& show, bool is_coarse) {
  const bool has_skeleton = product.skeleton.node_count() > 0;
  return {.mesh = is_coarse ? &product.coarse : &product.mesh,
          .skeleton = has_skeleton ? &product.skeleton : nullptr,
          .sky = product.sky.visibility.empty() ? nullptr : &product.sky,
          .obstacles = show.layers.count(kObstacles) > 0 ? &product.obstacles : nullptr,
          .outline = product.outline};
}

}  // namespace

TreePart Portion::next(std::size_t done, std::size_t total) const {
  if (!is_limited_ || done >= total) return {done, TreePart::kNoEnd};
  return {done, std::min(done + size_, total)};
}

void Portion::took(const TreePart& part, double seconds) {
  // The rest of a picture says nothing about its triangles.
  if (part.is_last() || part.end - part.first < size_) return;
  const double wanted = static_cast<double>(size_) * std::clamp(kMoment / std::max(seconds, 1e-4), 0.25, 2.0);
  size_ = std::max(kSmallestPart, static_cast<std::size_t>(wanted));
}

StagedTree::StagedTree(const Programs& programs, const Exhibit& exhibit, const ShowOptions& show,
                       bool has_coarse)
    : show_(show),
      tint_(exhibit.tint),
      serial_(exhibit.product->serial),
      options_(options_of(exhibit)),
      base_(base_of(scene_of(*exhibit.product, show, false))),
      box_(exhibit.product->box),
      fine_(programs.painter),
      overlay_(programs.overlay) {
  const bool is_mesh = options_.style != RenderStyle::skeleton;
  if (has_coarse && is_mesh && !exhibit.product->coarse.triangles.empty()) {
    coarse_ = std::make_unique<Painter>(programs.painter);
  }
}

RenderOptions StagedTree::options_of(const Exhibit& exhibit) {
  const Skeleton& skeleton = exhibit.product->skeleton;
  const bool has_skeleton = skeleton.node_count() > 0;
  RenderOptions options;
  options.style = show_.style;
  options.tint = tint_;
  options.with_occlusion = !exhibit.product->is_draft;
  if (!has_skeleton && show_.style == RenderStyle::skeleton) {
    options.style = RenderStyle::lit;
    notice_ = "a mesh without a skeleton has no lines to show";
  }
  if (show_.color_by.empty()) return options;
  std::vector<std::string> known;
  if (has_skeleton) known = color_attributes(skeleton);
  if (std::find(known.begin(), known.end(), show_.color_by) != known.end()) {
    options.color_by = show_.color_by;
  } else {
    notice_ = fmt::format("this tree has no attribute '{}'", show_.color_by);
  }
  return options;
}

bool StagedTree::shows(const Exhibit& exhibit, const ShowOptions& show) const {
  return serial_ == exhibit.product->serial && show_ == show && tint_ == exhibit.tint;
}

void StagedTree::advance() {
  stage_ = static_cast<Stage>(static_cast<int>(stage_) + 1);
}

void StagedTree::step(const Exhibit& exhibit, Portion& portion) {
  const Product& product = *exhibit.product;
  switch (stage_) {
    case Stage::begin_quick:
      quick().begin_load(scene_of(product, show_, coarse_ != nullptr), options_);
      return advance();
    case Stage::load_quick:
      return load(quick());
    case Stage::shade_quick:
      return shade(quick(), scene_of(product, show_, coarse_ != nullptr), portion);
    case Stage::lay_over:
      overlay_.load(product, show_.layers, show_.are_slices);
      advance();
      if (!coarse_) stage_ = Stage::done;
      if (coarse_) fine_.begin_load(scene_of(product, show_, false), options_);
      return;
    case Stage::load_fine:
      return load(fine_);
    case Stage::shade_fine:
      return shade(fine_, scene_of(product, show_, false), portion);
    case Stage::done:
      return;
  }
}

void StagedTree::load(Painter& painter) {
  if (painter.load_more()) return;
  advance();
  shaded_ = 0;
  if (options_.style != RenderStyle::lit) advance();  // there is no sun
}

/// A part of the shadows.
void StagedTree::shade(Painter& painter, const Scene& scene, Portion& portion) {
  const TreePart part = portion.next(shaded_, painter.triangle_count());
  const double start = now_seconds();
  painter.cast_shadows(scene, sun(), options_.with_occlusion ? kShadowMapSize : kNoShadowMapSize, part);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (portion.is_limited()) glFinish();
  portion.took(part, now_seconds() - start);
  shaded_ = part.end;
  if (part.is_last()) advance();
}

}  // namespace ramify
