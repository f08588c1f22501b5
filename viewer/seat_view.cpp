#include "viewer/seat_view.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cstdint>

#include "viewer/actions.h"
#include "viewer/show_view.h"
#include "viewer/theme.h"

namespace ramify {
namespace {

constexpr float kGap = 2.0f;  // between panes

// Two trees in one picture (Tol's "high-contrast" blue and red, told apart by colour-blind eyes too).
constexpr Color kFirstTint = color_of(0x1f5fa8);
constexpr Color kSecondTint = color_of(0xc8553d);

ImVec2 plus(const ImVec2& a, const ImVec2& b) {
  return {a.x + b.x, a.y + b.y};
}

/// Text that can be read on any picture.
void label(const ImVec2& at, const std::string& text, ImU32 color) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float unit = ui_scale();
  list.AddRectFilled({at.x - 5.0f * unit, at.y - 2.0f * unit},
                     {at.x + size.x + 5.0f * unit, at.y + size.y + 2.0f * unit}, IM_COL32(24, 24, 25, 190),
                     3.0f * unit);
  list.AddText(at, color, text.c_str());
}

std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
  return digits;
}

std::string caption(const Workbench& bench, std::size_t index) {
  const Document& document = bench.seats[index]->document;
  std::string text = document.input();
  if (bench.seats.size() > 1) text = seat_name(index) + "  " + text;
  const Product* product = document.product();
  if (product == nullptr) return text;
  if (document.has_job()) text += fmt::format("  \u00b7  {}", document.job().engine->name);
  if (product->skeleton.node_count() > 0) {
    text += fmt::format("  \u00b7  {} internodes", grouped(product->skeleton.internode_count()));
  } else {
    text += fmt::format("  \u00b7  {} triangles", grouped(product->mesh.triangles.size()));
  }
  if (!product->box.is_empty()) text += fmt::format("  \u00b7  {:.3g} m", product->box.size().y);
  return text;
}

/// What stands in the corner of a picture: its tree, or both in one, each with its colour.
float show_captions(const Workbench& bench, std::size_t index, ImVec2 at) {
  constexpr ImU32 kText = IM_COL32(228, 228, 230, 255);
  const float unit = ui_scale();
  const float line = ImGui::GetTextLineHeight() + 8.0f * unit;
  if (bench.show.arrangement == Arrangement::side_by_side) {
    label(at, caption(bench, index), kText);
    return at.y + line;
  }
  const float swatch = ImGui::GetTextLineHeight();
  for (std::size_t seat = 0; seat < bench.seats.size(); ++seat) {
    const Color& tint = seat == 0 ? kFirstTint : kSecondTint;
    ImGui::GetWindowDrawList()->AddRectFilled(
        {at.x - 5.0f * unit, at.y - 2.0f * unit}, {at.x + swatch, at.y + swatch + 2.0f * unit},
        ImGui::ColorConvertFloat4ToU32({tint.r, tint.g, tint.b, 1.0f}), 3.0f * unit);
    label({at.x + swatch + 10.0f * unit, at.y}, caption(bench, seat), kText);
    at.y += line;
  }
  return at.y;
}

/// Orbit, pan, zoom and frame by the mouse on the item that was made last.
void lead_camera(Workbench& bench, std::size_t index, const ImVec2& size) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) {
    bench.active = index;
    move_cameras(bench, [&](const Orbit& orbit) { return zoomed(orbit, io.MouseWheel); });
  }
  if (ImGui::IsItemActivated()) bench.active = index;
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) return frame_trees(bench);
  const glm::dvec2 drag(io.MouseDelta.x, io.MouseDelta.y);
  if (!ImGui::IsItemActive() || drag == glm::dvec2(0.0)) return;
  const bool is_pan = ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2) || io.KeyShift;
  move_cameras(bench, [&](const Orbit& orbit) {
    return is_pan ? panned(orbit, drag, {size.x, size.y}) : turned(orbit, drag, size.y);
  });
}

std::vector<Exhibit> exhibits_of(const Workbench& bench, std::size_t index) {
  std::vector<Exhibit> exhibits;
  if (bench.show.arrangement == Arrangement::side_by_side) {
    const Product* product = bench.seats[index]->document.product();
    if (product != nullptr) exhibits.push_back({product, std::nullopt});
    return exhibits;
  }
  for (std::size_t seat = 0; seat < bench.seats.size(); ++seat) {
    const Product* product = bench.seats[seat]->document.product();
    if (product != nullptr) exhibits.push_back({product, seat == 0 ? kFirstTint : kSecondTint});
  }
  return exhibits;
}

/// The first tree of a seat is looked at as a whole.
void frame_first(Workbench& bench, Seat& seat, double aspect) {
  const Product* product = seat.document.product();
  if (seat.is_framed || product == nullptr || product->box.is_empty()) return;
  seat.is_framed = true;
  seat.orbit = framed(seat.orbit, points_in_sight(bench, seat), aspect);
  if (bench.is_same_scale) equalize_scales(bench);
}

void show_picture(Workbench& bench, std::size_t index, const ImVec2& size) {
  Seat& seat = *bench.seats[index];
  const std::vector<Exhibit> exhibits = exhibits_of(bench, index);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("picture", size,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  bench.report.add("pane." + seat_name(index));
  lead_camera(bench, index, size);
  // Now, not before the camera was led: a move's first picture is quick, too. Once one is, so are the others.
  bench.is_drawn_fast = bench.is_drawn_fast || bench.is_moving();
  if (exhibits.empty()) return;
  frame_first(bench, seat, size.x / size.y);
  Orbit orbit = seat.orbit;
  orbit.is_parallel = bench.show.style != RenderStyle::lit;
  const double pixels = bench.window.pixels_per_unit();
  // Pictures that a test compares do not depend on how busy the machine is.
  const Quality at_rest = bench.report.is_on() ? Quality::finest : Quality::at_rest;
  const unsigned texture = seat.pane.picture(
      exhibits, bench.show, orbit, std::max(1, static_cast<int>(size.x * pixels)),
      std::max(1, static_cast<int>(size.y * pixels)), bench.is_drawn_fast ? Quality::moving : at_rest);
  if (texture == 0) return;
  ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)),
                                       low, plus(low, size), {0.0f, 1.0f}, {1.0f, 0.0f});
}

void show_state(Workbench& bench, std::size_t index, const ImVec2& low, const ImVec2& size) {
  Seat& seat = *bench.seats[index];
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const WorkState work = seat.document.work();
  if (work.is_busy && work.part > 0.0) {
    list.AddRectFilled(low, {low.x + size.x * static_cast<float>(work.part), low.y + 3.0f * ui_scale()},
                       ImGui::GetColorU32(ImGuiCol_PlotHistogram));
  }
  const ImVec2 corner(low.x + 12.0f * ui_scale(), low.y + 10.0f * ui_scale());
  const float line = ImGui::GetTextLineHeight() + 8.0f * ui_scale();
  float y = show_captions(bench, index, corner);
  const auto tell = [&](const std::string& text, ImU32 color) {
    if (text.empty()) return;
    label({corner.x, y}, text, color);
    y += line;
  };
  tell(seat.document.error(), IM_COL32(255, 150, 130, 255));
  tell(seat.pane.notice(), IM_COL32(240, 205, 130, 255));
  if (const Product* product = seat.document.product(); product != nullptr && product->run) {
    for (const std::string& warning : product->run->report.warnings)
      tell(warning, IM_COL32(240, 205, 130, 255));
  }
}

/// The slider of steps with its play button.
void show_steps(Workbench& bench, std::size_t index) {
  Seat& seat = *bench.seats[index];
  Document& document = seat.document;
  const int last = static_cast<int>(document.last_step());
  if (last < 2) return;
  if (ImGui::Button(seat.next_step_at ? "||" : ">", {ImGui::GetFrameHeight(), 0.0f})) {
    bench.active = index;
    if (seat.next_step_at) {
      seat.next_step_at.reset();
    } else {
      if (document.step() >= document.last_step()) document.show_step(1, Window::now());
      seat.next_step_at = Window::now();
    }
  }
  bench.report.add("play." + seat_name(index));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Play (Space)");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0f);
  int step = static_cast<int>(document.step());
  const std::string format = fmt::format("{} %d of {}", document.has_levels() ? "level" : "step", last);
  if (ImGui::SliderInt("##steps", &step, 1, last, format.c_str())) {
    seat.next_step_at.reset();
    document.show_step(static_cast<std::uint32_t>(std::clamp(step, 1, last)), bench.window.last_input());
    bench.last_motion = Window::now();
  }
  bench.report.add("steps." + seat_name(index));
}

void show_seat(Workbench& bench, std::size_t index, const ImVec2& size) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float unit = ui_scale();
  const float steps = ImGui::GetFrameHeight() + 8.0f * unit;
  const ImVec2 picture(size.x, std::max(1.0f, size.y - steps));
  show_picture(bench, index, picture);
  show_state(bench, index, low, picture);
  show_legend(bench, index, low.x + picture.x, low.y + picture.y);
  if (bench.seats.size() > 1 && index == bench.active) {
    ImGui::GetWindowDrawList()->AddRect(low, plus(low, picture), ImGui::GetColorU32(ImGuiCol_SliderGrab),
                                        0.0f, 0, 1.5f * unit);
  }
  ImGui::SetCursorScreenPos({low.x + 6.0f * unit, low.y + picture.y + 4.0f * unit});
  if (ImGui::BeginChild("steps", {size.x - 12.0f * unit, ImGui::GetFrameHeight()})) show_steps(bench, index);
  ImGui::EndChild();
}

}  // namespace

void show_seats(Workbench& bench) {
  bench.is_drawn_fast = false;
  const std::size_t count = pane_count(bench);
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = std::floor((all.x - kGap * static_cast<float>(count - 1)) / static_cast<float>(count));
  for (std::size_t index = 0; index < count; ++index) {
    ImGui::SetCursorScreenPos({low.x + static_cast<float>(index) * (width + kGap), low.y});
    ImGui::PushID(static_cast<int>(index));
    ImGui::BeginGroup();
    show_seat(bench, index, {std::max(1.0f, width), all.y});
    ImGui::EndGroup();
    ImGui::PopID();
  }
}

}  // namespace ramify
