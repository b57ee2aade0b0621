#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "core/statistics.h"
#include "gui/actions.h"
#include "gui/panels.h"
#include "view/selection_table.h"

namespace talus::gui {
namespace {

/// Offers the names that a condition may contain, with their meaning; a chosen name is appended.
void offer_names(Gui& gui) {
  view::SelectingState& selecting = gui.model.state.selecting;
  ImGui::SetNextItemWidth(5.5f * gui.em);
  const bool open = ImGui::BeginCombo("##names", "names", ImGuiComboFlags_HeightLarge);
  note_place(gui, "names");
  if (!open) return;
  for (const analysis::GrainNumber& number : analysis::grain_numbers()) {
    const std::string& name = number.name;
    if (ImGui::Selectable(view::head_of(number).c_str())) {
      const bool apart = !selecting.condition.empty() && !selecting.condition.ends_with(' ');
      selecting.condition += (apart ? " " : "") + name;
    }
    note_place(gui, "name " + name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(number.quantity->definition).c_str());
  }
  if (key_pressed(key_escape, false)) ImGui::CloseCurrentPopup();
  ImGui::EndCombo();
}

void choose_mode(Gui& gui) {
  view::SelectionMode& mode = gui.model.state.selecting.mode;
  int chosen = static_cast<int>(mode);
  if (named_choice(gui, "mode", "selecting", {"replaces", "adds", "removes", "intersects"}, chosen))
    mode = static_cast<view::SelectionMode>(chosen);
}

void write_condition(Gui& gui) {
  view::SelectingState& selecting = gui.model.state.selecting;
  ImGui::SetNextItemWidth(-1.0f);
  const bool entered = ImGui::InputTextWithHint("##condition", "gamma > 0.7 && y > 30", &selecting.condition,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  note_place(gui, "condition");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("selects the free grains that satisfy it: enter");
  const bool pressed = named_button(gui, "select", "Select", "enter");
  ImGui::SameLine();
  offer_names(gui);
  choose_mode(gui);
  if (entered || pressed) gui.model.select_by_condition();
  if (named_checkbox(gui, "in each frame", "reselect in each frame", selecting.in_each_frame) &&
      selecting.in_each_frame)
    gui.model.select_by_condition();
  named_checkbox(gui, "trails", "trails", selecting.trails, "paths of the selected grains: T");
  ImGui::SameLine();
  bool follow = selecting.follow;
  if (named_checkbox(gui, "follow grain", "follow the grain", follow,
                     "keeps the inspected grain in the middle: L"))
    toggle_following(gui);
  if (selecting.error.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, packed(gui.colours.warning));
  ImGui::TextWrapped("%s", selecting.error.c_str());
  ImGui::PopStyleColor();
}

void choose_quantity(Gui& gui) {
  std::string& name = gui.model.state.selecting.quantity;
  std::vector<std::string> heads;
  int chosen = 0;
  for (const analysis::GrainNumber& number : analysis::grain_numbers()) {
    if (number.name == name) chosen = static_cast<int>(heads.size());
    heads.push_back(view::head_of(number));
  }
  ImGui::SetNextItemWidth(-1.0f);
  if (named_choice(gui, "quantity", "", heads, chosen))
    name = analysis::grain_numbers()[static_cast<std::size_t>(chosen)].name;
}

void draw_histogram(Gui& gui, const std::vector<Index>& grains) {
  choose_quantity(gui);
  const analysis::GrainNumber& number = analysis::grain_number(gui.model.state.selecting.quantity);
  const std::vector<double>& values = gui.model.grain_values(number);
  const std::vector<double> known = view::known_values(grains, values);
  if (!known.empty()) {
    const Statistics statistics = statistics_of(known);
    fact("mean", std::isnan(statistics.deviation)
                     ? fmt::format("{:.4g}", statistics.mean)
                     : fmt::format("{:.4g} ± {:.3g}", statistics.mean, statistics.deviation));
    const auto [least, largest] = std::ranges::minmax(known);
    fact("from, to", fmt::format("{:.4g}, {:.4g}", least, largest));
  }
  if (known.size() < grains.size()) fact("without a value", fmt::format("{}", grains.size() - known.size()));
  std::vector<Index> all(static_cast<std::size_t>(gui.model.statics().free_count));
  std::iota(all.begin(), all.end(), 0);
  const view::Plot plot = view::histogram_of(number, grains, all, values);
  if (!plot.series.empty()) draw_plot(gui, plot, {ImGui::GetContentRegionAvail().x, 10.0f * gui.em}, {});
}

std::string cell_text(const analysis::GrainNumber& number, double value) {
  if (std::isnan(value)) return "–";
  return number.quantity->number == analysis::FieldNumber::integer ? fmt::format("{:.0f}", value)
                                                                   : fmt::format("{:.4g}", value);
}

/// Returns the columns of the table: the quantity of the histogram, and the most common ones.
std::vector<const analysis::GrainNumber*> shown_columns(const std::string& chosen) {
  std::vector<const analysis::GrainNumber*> columns = {&analysis::grain_number("id")};
  for (const std::string_view name : {std::string_view(chosen), std::string_view("x"), std::string_view("y"),
                                      std::string_view("gamma"), std::string_view("coordination")})
    if (std::ranges::find(columns, name, &analysis::GrainNumber::name) == columns.end())
      columns.push_back(&analysis::grain_number(name));
  return columns;
}

/// Draws the rows; a click shows a grain in the inspector and keeps the selection.
void draw_rows(Gui& gui, const std::vector<Index>& grains,
               const std::vector<const analysis::GrainNumber*>& columns) {
  view::ViewState& state = gui.model.state;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(grains.size()));
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      const Index grain = grains[static_cast<std::size_t>(row)];
      ImGui::TableNextRow();
      for (const analysis::GrainNumber* number : columns) {
        ImGui::TableNextColumn();
        const std::string text =
            cell_text(*number, gui.model.grain_values(*number)[static_cast<std::size_t>(grain)]);
        if (number != columns.front()) {
          ImGui::TextUnformatted(text.c_str());
          continue;
        }
        if (ImGui::Selectable(text.c_str(), state.selected == grain, ImGuiSelectableFlags_SpanAllColumns))
          state.selected = grain;
        note_place(gui, fmt::format("row {}", row));
      }
    }
}

void draw_table(Gui& gui, const std::vector<Index>& grains) {
  const auto columns = shown_columns(gui.model.state.selecting.quantity);
  const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings;
  const float height = 14.0f * gui.em;
  if (!ImGui::BeginTable("selected grains", static_cast<int>(columns.size()), flags, {0.0f, height})) return;
  ImGui::TableSetupScrollFreeze(1, 1);
  for (const analysis::GrainNumber* number :
       columns)  // separate id, so that the sort order belongs to the quantity
    ImGui::TableSetupColumn(view::head_of(*number).c_str());
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int k = 0; k < static_cast<int>(columns.size()); ++k) {
    ImGui::TableSetColumnIndex(k);
    ImGui::TableHeader(ImGui::TableGetColumnName(k));
    note_place(gui, "sort by " + columns[static_cast<std::size_t>(k)]->name);
  }
  std::vector<Index> rows = grains;
  const ImGuiTableSortSpecs* sorting = ImGui::TableGetSortSpecs();
  if (sorting != nullptr && sorting->SpecsCount > 0) {
    const analysis::GrainNumber& by = *columns[static_cast<std::size_t>(sorting->Specs[0].ColumnIndex)];
    rows = view::sorted_by(rows, gui.model.grain_values(by),
                           sorting->Specs[0].SortDirection == ImGuiSortDirection_Descending);
  }
  draw_rows(gui, rows, columns);
  ImGui::EndTable();
}

void draw_selected(Gui& gui, const std::vector<Index>& grains) {
  view::SelectingState& selecting = gui.model.state.selecting;
  const auto free = static_cast<std::size_t>(gui.model.statics().free_count);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(fmt::format("{} of {} grains", grains.size(), free).c_str());
  ImGui::SameLine();
  if (named_button(gui, "select none", "None", "escape")) return gui.model.select(std::optional<Index>());
  draw_histogram(gui, grains);
  ImGui::SetNextItemWidth(-5.0f * gui.em);
  named_text(gui, "table path", "", selecting.table_path, "CSV file to write");
  ImGui::SameLine();
  if (named_button(gui, "write table", "Write", "all quantities of the selected grains, as CSV"))
    gui.model.write_selected(selecting.table_path);
  draw_table(gui, grains);
}

}  // namespace

void draw_select_panel(Gui& gui) {
  write_condition(gui);
  ImGui::Separator();
  const std::vector<Index> grains = gui.model.selected_grains();
  if (!grains.empty()) return draw_selected(gui, grains);
  ImGui::TextWrapped(
      "No grains are selected. Write a condition, click a grain, or drag on the map: with shift a box, with "
      "ctrl a lasso.");
}

}  // namespace talus::gui
