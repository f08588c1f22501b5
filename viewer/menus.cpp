#include "viewer/menus.h"

#include <imgui.h>

#include <array>
#include <cstring>

#include "viewer/commands.h"

namespace ramify {
namespace {

// What the mouse does; the keys are in the table of commands.
constexpr std::array<std::array<const char*, 2>, 5> kMouse = {{
    {"Drag", "turn"},
    {"Shift+drag, right or middle button", "pan"},
    {"Wheel", "zoom"},
    {"Double click", "frame"},
    {"Ctrl+click on a slider", "type a value"},
}};

void show_menu_item(Workbench& bench, const Command& command) {
  const bool is_possible = !command.is_possible || command.is_possible(bench);
  const bool is_on = command.is_on && command.is_on(bench);
  if (ImGui::MenuItem(command.label.c_str(), key_text(command.key).c_str(), is_on, is_possible)) {
    command.run(bench);
  }
  bench.report.add(command.menu + "." + command.label);
}

void help_row(const std::string& left, const std::string& right) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(left.c_str());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(right.c_str());
}

}  // namespace

void show_menus(Workbench& bench) {
  if (!ImGui::BeginMainMenuBar()) return;
  std::string menu;
  bool is_open = false;
  for (const Command& command : commands()) {
    if (command.menu != menu) {
      if (is_open) ImGui::EndMenu();
      menu = command.menu;
      is_open = ImGui::BeginMenu(menu.c_str());
      if (!is_open) bench.report.add("menu." + menu);
    }
    if (is_open) show_menu_item(bench, command);
  }
  if (is_open) ImGui::EndMenu();
  ImGui::EndMainMenuBar();
}

void show_status(Workbench& bench) {
  const std::string& notice = bench.window.notice();
  if (bench.is_message_bad) {
    ImGui::TextColored({1.0f, 0.6f, 0.52f, 1.0f}, "%s", bench.message.c_str());
  } else {
    ImGui::TextDisabled("%s", bench.message.empty() ? notice.c_str() : bench.message.c_str());
  }
  bench.report.add("message");
  std::string device = bench.window.device();
  if (device.find("llvmpipe") != std::string::npos) device = "no GPU: drawn in software by " + device;
  device = device.substr(0, device.find(" ("));
  const float width = ImGui::CalcTextSize(device.c_str()).x;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  ImGui::TextDisabled("%s", device.c_str());
}

void show_help(Workbench& bench) {
  if (!bench.shows_help) return;
  const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
  const ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize |
                                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Keys and mouse", &bench.shows_help, flags)) {
    bench.report.add("help", ImGui::GetWindowPos().x, ImGui::GetWindowPos().y,
                     ImGui::GetWindowPos().x + ImGui::GetWindowWidth(),
                     ImGui::GetWindowPos().y + ImGui::GetWindowHeight());
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
      for (const auto& [what, does] : kMouse) help_row(what, does);
      for (const Command& command : commands()) {
        if (!command.key.key.empty()) help_row(key_text(command.key), command.label);
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

void show_prompt(Workbench& bench) {
  if (!bench.prompt) return;
  if (!ImGui::IsPopupOpen("prompt")) ImGui::OpenPopup("prompt");
  const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopup("prompt")) return;
  Prompt& prompt = *bench.prompt;
  ImGui::TextUnformatted(prompt.title.c_str());
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0f);
  ImGui::TextDisabled("%s", prompt.hint.c_str());
  ImGui::PopTextWrapPos();
  std::array<char, 1024> text{};
  std::strncpy(text.data(), prompt.text.c_str(), text.size() - 1);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 28.0f);
  const bool is_answered =
      ImGui::InputText("##text", text.data(), text.size(),
                       ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  bench.report.add("prompt");
  prompt.text = text.data();
  bool is_over = is_answered || ImGui::Button("OK");
  if (is_over && !prompt.text.empty()) {
    const Prompt answered = prompt;
    answered.answer(bench, answered.text);
  }
  ImGui::SameLine();
  is_over = ImGui::Button("Cancel") || is_over;
  if (is_over) {
    bench.prompt.reset();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace ramify
