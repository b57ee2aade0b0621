#include <algorithm>
#include <cmath>

#include "gui/panels.h"

namespace talus::gui {
namespace {

/// Grid of plots, as wide as legibility requires and as high as there is room for whole rows, or for one.
struct PlotGrid {
  int columns = 1;
  ImVec2 cell;
};

constexpr float min_width = 17.5f, min_height = 8.0f;  // em: fits the longest title, and two numbers of y

bool has_values(const view::PlotSeries& series) {
  return !series.law && std::ranges::any_of(series.y, [](double y) { return std::isfinite(y); });
}

PlotGrid lay_out_plots(const ImVec2& room, int count, float em) {
  PlotGrid grid;
  count = std::max(count, 1);
  grid.columns = std::clamp(static_cast<int>(room.x / (min_width * em)), 1, count);
  const int rows = (count + grid.columns - 1) / grid.columns;
  grid.columns = (count + rows - 1) / rows;
  const int rows_in_sight = std::clamp(static_cast<int>(room.y / (min_height * em)), 1, rows);
  grid.cell = {std::floor(room.x / static_cast<float>(grid.columns)),
               std::max(std::floor(room.y / static_cast<float>(rows_in_sight)), min_height * em)};
  return grid;
}

/// Draws a plot; a click on a curve along the run goes to the nearest frame.
void draw_and_answer(Gui& gui, const view::Plot& plot, const ImVec2& size, const view::PlotMarks& marks,
                     std::string& gone) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const auto clicked = draw_plot(gui, plot, size, plot.along_run ? marks : view::PlotMarks{});
  if (plot.added) {
    const ImVec2 low{corner.x + size.x - 1.6f * gui.em, corner.y},
        high{corner.x + size.x, corner.y + 1.4f * gui.em};
    ImGui::GetWindowDrawList()->AddText({low.x + 0.3f * gui.em, low.y + 0.2f * gui.em},
                                        packed(gui.colours.soft), "x");
    note_place(gui, "remove " + plot.name, low, high);
    if (clicked && ImGui::IsMouseHoveringRect(low, high)) {
      gone = plot.name;
      return;
    }
  }
  if (!clicked || !plot.along_run) return;
  gui.model.play(false);
  gui.model.go_to_place(*clicked);
}

/// Draws one plot at full size, with its options.
void draw_enlarged(Gui& gui, const view::Plot& plot, const view::PlotMarks& marks, std::string& gone) {
  if (named_button(gui, "all plots", "All plots", "shows all plots; so does a double click on the plot"))
    gui.state.enlarged_plot.clear();
  ImGui::SameLine();
  view::PlotOptions& options = gui.state.plot_options[plot.name];
  bool logarithmic = options.log_y.value_or(plot.log_y);
  if (named_checkbox(gui, "logarithmic", "logarithmic", logarithmic)) options.log_y = logarithmic;
  draw_and_answer(gui, plot, ImGui::GetContentRegionAvail(), marks, gone);
}

void draw_axis(Gui& gui) {
  using enum view::PlotAxis;
  for (const auto& [axis, name, label, tip] :
       {std::tuple{tilt, "over tilt", "θ", "all curves over the tilt"},
        {angle_left, "over angle left", "θ_c − θ", "all curves over the angle left to failure"},
        {time, "over time", "t", "all curves over time"}}) {
    if (!gui.model.has_plot_axis(axis) && !gui.model.is_live()) continue;  // a live run may still fail
    const bool chosen = gui.model.plot_axis() == axis;
    if (axis != tilt) ImGui::SameLine();
    ImGui::BeginDisabled(!gui.model.has_plot_axis(axis));
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(ImGuiCol_ButtonActive));
    if (named_button(gui, name, label, tip)) gui.model.set_plot_axis(axis);
    if (chosen) ImGui::PopStyleColor();
    ImGui::EndDisabled();
  }
}

/// Adds a plot of any quantity whose name or title contains the text typed.
void draw_more(Gui& gui) {
  ImGui::SetNextItemWidth(9.0f * gui.em);
  const bool open = ImGui::BeginCombo("##add plot", "add a plot", ImGuiComboFlags_HeightLarge);
  note_place(gui, "add plot");
  if (!open) return;
  std::string& filter = gui.state.quantity_filter;
  named_text(gui, "quantity filter", "", filter, "part of a name, such as stress");
  for (const analysis::Quantity* quantity : gui.model.more_quantities()) {
    if ((quantity->name + " " + quantity->display.title).find(filter) == std::string::npos) continue;
    if (ImGui::Selectable(quantity->name.c_str())) gui.model.add_plot(*quantity);
    note_place(gui, "add plot: " + quantity->name);
    if (ImGui::IsItemHovered()) {
      ImGui::BeginTooltip();
      ImGui::PushTextWrapPos(25.0f * gui.em);
      ImGui::TextUnformatted(
          (quantity->definition + " [" + analysis::scaled_unit(quantity->unit) + "]").c_str());
      ImGui::PopTextWrapPos();
      ImGui::EndTooltip();
    }
  }
  if (key_pressed(key_escape, false)) ImGui::CloseCurrentPopup();
  ImGui::EndCombo();
}

void draw_export(Gui& gui) {
  if (named_button(gui, "export plots", "export ...", "write the plots as PDF and PNG, with their data"))
    ImGui::OpenPopup("export plots");
  if (!ImGui::BeginPopup("export plots")) return;
  ImGui::SetNextItemWidth(22.0f * gui.em);
  named_text(gui, "plots folder", "", gui.state.plots_folder, "folder to write the plots to");
  bool taken = ImGui::IsItemFocused() && key_pressed(key_enter, false);
  ImGui::SameLine();
  const char* label = gui.state.enlarged_plot.empty() ? "Write all plots" : "Write this plot";
  taken = named_button(gui, "write plots", label) || taken;
  if (taken || key_pressed(key_escape, false)) ImGui::CloseCurrentPopup();
  if (taken) gui.requests.plots_folder = gui.state.plots_folder;
  ImGui::EndPopup();
}

void draw_choices(Gui& gui) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("over");
  ImGui::SameLine();
  draw_axis(gui);
  ImGui::SameLine();
  draw_more(gui);
  same_line_if_fits(ImGui::CalcTextSize("export ...").x + gui.em);
  draw_export(gui);
}

}  // namespace

void draw_plots(Gui& gui) {
  draw_choices(gui);
  const auto plots = gui.model.plots();
  const auto is_shown = [all_known = gui.model.all_values_known()](const view::Plot& plot) {
    return plot.added || !all_known || std::ranges::any_of(plot.series, has_values);
  };
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const PlotGrid grid = lay_out_plots(room, static_cast<int>(std::ranges::count_if(plots, is_shown)), gui.em);
  const view::PlotMarks marks = gui.model.plot_marks();
  std::string gone;  // removed after all are drawn
  const auto enlarged = std::ranges::find(plots, gui.state.enlarged_plot, &view::Plot::name);
  if (enlarged != plots.end()) {
    draw_enlarged(gui, *enlarged, marks, gone);
    if (!gone.empty()) gui.model.remove_plot(gone);
    return;
  }
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0f, 0.0f});
  std::size_t drawn = 0;
  for (const bool added : {true, false})  // added plots first, so that they are visible without scrolling
    for (const view::Plot& plot : plots) {
      if (plot.added != added || !is_shown(plot)) continue;
      if (drawn++ % static_cast<std::size_t>(grid.columns) != 0) ImGui::SameLine();
      draw_and_answer(gui, plot, grid.cell, marks, gone);
    }
  ImGui::PopStyleVar();
  if (!gone.empty()) gui.model.remove_plot(gone);
}

}  // namespace talus::gui
