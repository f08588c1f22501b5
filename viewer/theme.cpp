#include "viewer/theme.h"

#include <imgui.h>

#include <filesystem>

#include "common/base/letters.h"

namespace ramify {
namespace {

constexpr float kFontSize = 15.0f;

float scale_in_use = 1.0f;
double density_in_use = 1.0;

ImVec4 grey(float level, float alpha = 1.0f) {
  return {level, level, level * 1.03f, alpha};
}

ImVec4 accent(float strength, float alpha = 1.0f) {
  return {0.36f * strength, 0.66f * strength, 0.52f * strength, alpha};
}

void set_colors(ImVec4* colors) {
  colors[ImGuiCol_Text] = grey(0.88f);
  colors[ImGuiCol_TextDisabled] = grey(0.55f);
  colors[ImGuiCol_WindowBg] = grey(0.135f);
  colors[ImGuiCol_ChildBg] = grey(0.0f, 0.0f);
  colors[ImGuiCol_PopupBg] = grey(0.105f, 0.98f);
  colors[ImGuiCol_Border] = grey(0.24f);
  colors[ImGuiCol_FrameBg] = grey(0.205f);
  colors[ImGuiCol_FrameBgHovered] = grey(0.26f);
  colors[ImGuiCol_FrameBgActive] = grey(0.30f);
  colors[ImGuiCol_TitleBg] = grey(0.105f);
  colors[ImGuiCol_TitleBgActive] = grey(0.105f);
  colors[ImGuiCol_TitleBgCollapsed] = grey(0.105f);
  colors[ImGuiCol_MenuBarBg] = grey(0.105f);
  colors[ImGuiCol_ScrollbarBg] = grey(0.0f, 0.0f);
  colors[ImGuiCol_ScrollbarGrab] = grey(0.28f);
  colors[ImGuiCol_ScrollbarGrabHovered] = grey(0.36f);
  colors[ImGuiCol_ScrollbarGrabActive] = grey(0.42f);
  colors[ImGuiCol_CheckMark] = accent(1.2f);
  colors[ImGuiCol_SliderGrab] = accent(0.95f);
  colors[ImGuiCol_SliderGrabActive] = accent(1.25f);
  colors[ImGuiCol_Button] = grey(0.235f);
  colors[ImGuiCol_ButtonHovered] = grey(0.31f);
  colors[ImGuiCol_ButtonActive] = accent(0.7f);
  colors[ImGuiCol_Header] = grey(0.20f);
  colors[ImGuiCol_HeaderHovered] = grey(0.26f);
  colors[ImGuiCol_HeaderActive] = grey(0.30f);
  colors[ImGuiCol_Separator] = grey(0.24f);
  colors[ImGuiCol_SeparatorHovered] = grey(0.36f);
  colors[ImGuiCol_SeparatorActive] = accent(0.9f);
  colors[ImGuiCol_ResizeGrip] = grey(0.28f);
  colors[ImGuiCol_Tab] = grey(0.135f);
  colors[ImGuiCol_TabHovered] = grey(0.30f);
  colors[ImGuiCol_TabActive] = grey(0.235f);
  colors[ImGuiCol_TabUnfocused] = grey(0.135f);
  colors[ImGuiCol_TabUnfocusedActive] = grey(0.235f);
  colors[ImGuiCol_PlotLines] = accent(1.2f);
  colors[ImGuiCol_PlotHistogram] = accent(0.95f);
  colors[ImGuiCol_PlotHistogramHovered] = accent(1.2f);
  colors[ImGuiCol_TextSelectedBg] = accent(0.6f, 0.6f);
  colors[ImGuiCol_NavHighlight] = accent(1.0f);
  colors[ImGuiCol_ModalWindowDimBg] = grey(0.0f, 0.5f);
  colors[ImGuiCol_TableRowBgAlt] = grey(1.0f, 0.025f);
  colors[ImGuiCol_TableHeaderBg] = grey(0.18f);
}

}  // namespace

std::string apply_theme(double scale, double density) {
  scale_in_use = static_cast<float>(scale);
  density_in_use = density;
  ImGuiStyle& style = ImGui::GetStyle();
  ImGui::StyleColorsDark();
  set_colors(style.Colors);
  style.WindowRounding = 0.0f;
  style.ChildRounding = 0.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.PopupRounding = 4.0f;
  style.TabRounding = 3.0f;
  style.ScrollbarRounding = 4.0f;
  style.ScrollbarSize = 11.0f;
  style.GrabMinSize = 10.0f;
  style.WindowBorderSize = 0.0f;
  style.ChildBorderSize = 0.0f;
  style.WindowPadding = {10.0f, 8.0f};
  style.FramePadding = {7.0f, 3.0f};
  style.ItemSpacing = {7.0f, 5.0f};
  style.ItemInnerSpacing = {5.0f, 4.0f};
  style.CellPadding = {4.0f, 2.0f};
  style.IndentSpacing = 12.0f;
  style.ScaleAllSizes(static_cast<float>(scale));

  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  ImGui::GetIO().FontGlobalScale = static_cast<float>(1.0 / density);
  const float size = kFontSize * static_cast<float>(scale * density);
  const std::filesystem::path font = installed_font();
  if (!font.empty() && fonts.AddFontFromFileTTF(font.c_str(), size)) return {};
  ImFontConfig coarse;
  coarse.SizePixels = 13.0f * static_cast<float>(scale * density);
  fonts.AddFontDefault(&coarse);
  return "no font found (package fonts-dejavu-core): the letters are coarse";
}

float ui_scale() {
  return scale_in_use;
}

double display_scale() {
  return scale_in_use * density_in_use;
}

}  // namespace ramify
