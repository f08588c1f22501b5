#include "viewer/sidebar.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/config/differences.h"
#include "viewer/numbers_view.h"
#include "viewer/show_view.h"

namespace ramify {
namespace {

void choose_seat(Workbench& bench) {
  if (bench.seats.size() < 2) return;
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2.0f;
  for (std::size_t index = 0; index < bench.seats.size(); ++index) {
    if (index > 0) ImGui::SameLine();
    const bool is_active = index == bench.active;
    if (is_active) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const std::string label =
        seat_name(index) + "  " + bench.seats[index]->document.input() + "##seat" + seat_name(index);
    if (ImGui::Button(label.c_str(), {width, 0.0f})) bench.active = index;
    if (is_active) ImGui::PopStyleColor();
    bench.report.add("seat." + seat_name(index));
  }
}

/// The engine the tree is made by; another one goes on with its own parameters.
void choose_engine(Workbench& bench) {
  Document& document = bench.document();
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("engine");
  ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.41f);
  ImGui::SetNextItemWidth(-1.0f);
  const AnyEngine* chosen = document.job().engine;
  const bool is_open = ImGui::BeginCombo("##engine", chosen->name.c_str());
  bench.report.add("engine");
  if (!is_open) return;
  for (const AnyEngine& engine : bench.services.registry.engines()) {
    if (ImGui::Selectable(engine.name.c_str(), &engine == chosen) && &engine != chosen) {
      document.switch_engine(engine, bench.window.last_input());
      bench.seat().panel.defaults = default_job(engine);
      bench.seat().is_framed = false;
    }
    bench.report.add("engine." + engine.name);
  }
  ImGui::EndCombo();
}

void write_filter(Workbench& bench) {
  Panel& panel = bench.seat().panel;
  std::array<char, 64> text{};
  std::strncpy(text.data(), panel.filter.c_str(), text.size() - 1);
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##filter", "find a parameter", text.data(), text.size())) {
    panel.filter = text.data();
    bench.report.say("FILTER " + panel.filter);
  }
  bench.report.add("filter");
}

/// How many parameters differ from what was opened.
void count_changes(Workbench& bench) {
  const Document& document = bench.document();
  const Table table = job_table(*document.job().engine);
  const std::size_t count = differences(table, &document.opened_job(), &document.job()).size();
  if (count == 0) {
    ImGui::TextDisabled("as opened");
  } else {
    ImGui::TextDisabled("%zu changed", count);
  }
}

void show_parameters(Workbench& bench) {
  if (!bench.document().has_job()) {
    ImGui::TextWrapped("%s was read from a file: it has no parameters.", bench.document().input().c_str());
    return;
  }
  choose_engine(bench);
  write_filter(bench);
  count_changes(bench);
  ImGui::BeginChild("parameters");
  Document& document = bench.document();
  Panel& panel = bench.seat().panel;
  // A switch by undo leaves the panel behind.
  if (panel.defaults.engine != document.job().engine) panel.defaults = default_job(*document.job().engine);
  panel.last_step = std::max(1.0, static_cast<double>(document.job().steps()));
  const Job before = independent_copy(document.job());
  ImGui::PushID(document.job().engine);
  const WidgetOutcome outcome = parameter_rows(job_table(*document.job().engine), document.job(),
                                               document.opened_job(), panel, bench.report);
  ImGui::PopID();
  take_edit(bench, outcome, before);
  ImGui::EndChild();
}

void page(Workbench& bench, const char* name, void (*content)(Workbench&)) {
  const bool is_open = ImGui::BeginTabItem(name);
  bench.report.add(std::string("page.") + name);
  if (!is_open) return;
  ImGui::Spacing();
  content(bench);
  ImGui::EndTabItem();
}

}  // namespace

void show_sidebar(Workbench& bench) {
  choose_seat(bench);
  ImGui::PushID(static_cast<int>(bench.active));
  if (ImGui::BeginTabBar("pages")) {
    page(bench, "Parameters", show_parameters);
    page(bench, "Show", show_choices);
    page(bench, "Numbers", show_numbers);
    ImGui::EndTabBar();
  }
  ImGui::PopID();
}

}  // namespace ramify
