#include "viewer/gallery.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "common/base/errors.h"
#include "common/config/presets.h"
#include "viewer/actions.h"
#include "viewer/theme.h"
#include "viewer/workbench.h"

namespace ramify {
namespace {

// Of a plain display.
constexpr int kPictureWidth = 92;
constexpr int kPictureHeight = 104;

/// Of two lines below a picture.
float name_height() {
  return ImGui::GetStyle().ItemSpacing.y + 2.0f * ImGui::GetTextLineHeight();
}

/// On two lines where it is wider than a picture; broken after a hyphen.
std::string two_lines(const std::string& name, float width) {
  if (ImGui::CalcTextSize(name.c_str()).x <= width) return name;
  for (std::size_t at = name.rfind('-'); at != std::string::npos && at > 0; at = name.rfind('-', at - 1)) {
    const std::string first = name.substr(0, at + 1);
    if (ImGui::CalcTextSize(first.c_str()).x <= width) return first + "\n" + name.substr(at + 1);
  }
  return name;
}

GlTexture texture_of(const Image& image) {
  GlTexture texture;
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.rgba.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

/// Trees that are looked at for themselves first, those that sweeps begin with last.
std::vector<const Preset*> presets_in_order() {
  std::vector<const Preset*> order;
  for (const Preset& preset : presets()) order.push_back(&preset);
  const auto rank = [](const Preset* preset) {
    return preset->group == "species" ? 0 : preset->group == "experiments" ? 2 : 1;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const Preset* a, const Preset* b) { return rank(a) < rank(b); });
  return order;
}

}  // namespace

Gallery::Gallery(Pane pane) : presets_(presets_in_order()), pane_(std::move(pane)), workshop_(Window::wake) {}

float Gallery::height() {
  constexpr float kPadding = 16.0f;
  return ui_scale() * (static_cast<float>(kPictureHeight) + kPadding) + name_height() +
         ImGui::GetStyle().ScrollbarSize;
}

void Gallery::draw() {
  if (!product_) product_ = workshop_.take();
  if (!product_) return;
  const double aspect = static_cast<double>(kPictureWidth) / kPictureHeight;
  const int fineness = std::max(2, static_cast<int>(std::ceil(ui_scale())));
  Orbit orbit;
  orbit.is_parallel = true;
  orbit.elevation_deg = 4.0;
  ShowOptions show;
  show.style = RenderStyle::schematic;
  Thumbnail& thumbnail = thumbnails_[making_];
  if (product_->error.empty()) {
    pane_.picture({{product_.get(), std::nullopt}}, show, framed(orbit, framing_points(*product_), aspect),
                  fineness * kPictureWidth, fineness * kPictureHeight, Quality::finest);
    if (pane_.is_unfinished()) return;
    thumbnail.texture = texture_of(pane_.image());
  }
  making_.clear();
  workshop_.retire(std::move(product_), false);
}

bool Gallery::is_drawing() const {
  return product_ && last_frame_ == ImGui::GetFrameCount();
}

void Gallery::make_next(Workbench& bench) {
  if (wanted_.empty() || !making_.empty()) return;
  making_ = wanted_;
  try {
    const Opened opened = bench.services.open(making_);
    workshop_.order({.number = 1, .job = std::make_shared<const Job>(*opened.job), .is_draft = true});
  } catch (const std::exception&) {
    thumbnails_[making_];  // stays empty
    making_.clear();
  }
}

void Gallery::show(Workbench& bench, bool is_busy) {
  last_frame_ = ImGui::GetFrameCount();
  draw();
  wanted_.clear();
  ImGui::BeginChild("gallery", {0.0f, 0.0f}, false, ImGuiWindowFlags_HorizontalScrollbar);
  for (const Preset* preset : presets_) {
    const std::string name(preset->name);
    if (preset != presets_.front()) ImGui::SameLine();
    ImGui::PushID(name.c_str());
    ImGui::BeginGroup();
    const ImVec2 size(ui_scale() * kPictureWidth, ui_scale() * kPictureHeight);
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const bool is_chosen = ImGui::InvisibleButton("picture", size);
    const bool is_visible = ImGui::IsItemVisible();
    bench.report.add("preset." + name);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 high(low.x + size.x, low.y + size.y);
    const auto found = thumbnails_.find(name);
    if (found != thumbnails_.end() && found->second.texture) {
      list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(found->second.texture->id())),
                    low, high, {0.0f, 0.0f}, {1.0f, 1.0f}, IM_COL32(225, 225, 225, 255));
    } else {
      list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
    }
    if (ImGui::IsItemHovered()) {
      list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_SliderGrab), 0.0f, 0, 2.0f);
      const std::string_view about = summary(*preset);
      ImGui::SetTooltip("%s\n%.*s\nShift: beside the other tree", name.c_str(),
                        static_cast<int>(about.size()), about.data());
    }
    if (is_visible && wanted_.empty() && found == thumbnails_.end() && name != making_) wanted_ = name;
    ImGui::PushClipRect(low, {high.x, high.y + name_height()}, true);
    ImGui::TextDisabled("%s", two_lines(name, size.x).c_str());
    ImGui::PopClipRect();
    ImGui::EndGroup();
    ImGui::PopID();
    if (is_chosen && ImGui::GetIO().KeyShift) {
      open_beside(bench, name);
    } else if (is_chosen) {
      open_input(bench, name);
    }
  }
  // The strip has one direction to go.
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) && ImGui::GetIO().MouseWheel != 0.0f) {
    ImGui::SetScrollX(ImGui::GetScrollX() - ImGui::GetIO().MouseWheel * 2.0f * ui_scale() * kPictureWidth);
  }
  ImGui::EndChild();
  if (!is_busy) make_next(bench);
}

}  // namespace ramify
