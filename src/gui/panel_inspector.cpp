#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/actions.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

constexpr double pi = 3.14159265358979323846;

const char* status_text(ContactStatus status) {
  switch (status) {
    case ContactStatus::sticking:
      return "sticks";
    case ContactStatus::sliding:
      return "slides";
    case ContactStatus::open:
      break;
  }
  return "open";
}

/// Lists the contacts; a click on a row selects one.
void draw_contacts(Gui& gui, const view::Inspection& grain, double weight) {
  const ImGuiTableFlags flags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp;
  // Enough for most grains, so that the content below does not move between frames.
  constexpr float usual_rows = 7.0f;
  const float row_height = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
  const ImVec2 least{0.0f, usual_rows * row_height};
  if (!ImGui::BeginTable("contacts", 4, flags, least)) return;
  for (const char* title : {"with", "f_n/mg", "f_t/mg", ""}) {
    ImGui::TableNextColumn();
    rich_text(title);
  }
  std::optional<view::ContactKey> chosen;  // applied once all are drawn
  for (const view::GrainContact& contact : grain.contacts) {
    ImGui::TableNextColumn();
    const std::string row = fmt::format("{}##{} {} {}", contact.other_name, contact.key.a, contact.key.b,
                                        static_cast<int>(contact.key.shift));
    if (ImGui::Selectable(row.c_str(), false, ImGuiSelectableFlags_SpanAllColumns)) chosen = contact.key;
    note_place(gui, "contact with " + contact.other_name);
    ImGui::TableNextColumn();
    ImGui::Text("%.3g", contact.fn / weight);
    ImGui::TableNextColumn();
    ImGui::Text("%.3g", contact.ft / weight);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(status_text(contact.status));
  }
  ImGui::EndTable();
  if (chosen) gui.model.select(*chosen);
}

/// Draws Mohr's circle for mean stress p and deviator q, in units of p: principal values (1 +- gamma) / 2,
/// and the line of Coulomb's threshold sin(theta_c).
void draw_mohr_circle(Gui& gui, const view::Inspection& grain, double theta_c) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, em = gui.em;
  const ImVec2 size{width, 0.74f * width + 1.6f * em};
  ImGui::Dummy(size);
  note_place(gui, "mohr circle");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = packed(gui.colours.ink), law = packed(gui.colours.curves[1]);
  const float scale = 0.7f * width;  // px per p
  const ImVec2 origin{corner.x + 0.05f * width, corner.y + 1.6f * em + 0.37f * width};
  list.AddLine({corner.x, origin.y}, {corner.x + size.x, origin.y}, ink);
  list.AddLine({origin.x, corner.y + em}, {origin.x, corner.y + size.y}, ink);
  if (std::isfinite(grain.state.ratio))
    list.AddCircle({origin.x + 0.5f * scale, origin.y},
                   std::max(1.0f, static_cast<float>(0.5 * grain.state.ratio) * scale), ink, 64, 0.1f * em);
  const auto slope = static_cast<float>(std::tan(theta_c));
  for (const float side : {-1.0f, 1.0f}) {
    const float reach = std::min(0.9f * width, 0.37f * width / slope);
    list.AddLine(origin, {origin.x + reach, origin.y + side * slope * reach}, law);
  }
  add_rich_text(list, {origin.x + 0.3f * em, corner.y}, ink, "τ/p, σ/p; line: θ_c");
}

void draw_curve(Gui& gui, const view::Inspection& grain) {
  const double diameter = gui.model.mean_diameter();
  const double gamma_c = sine(gui.model.theta_c()) * gui.model.state.map.threshold_factor;
  view::Plot plot;
  plot.name = "neighbourhood";
  plot.title = "γ_ℓ";
  plot.x_title = "ℓ/D";
  plot.along_run = false;
  view::PlotSeries curve{"γ_ℓ", {}, grain.curve.gamma, false}, threshold{"Γ_c", {}, {}, true};
  for (const double l : grain.curve.l) curve.x.push_back(l / diameter);
  if (!curve.x.empty()) {
    threshold.x = {curve.x.front(), curve.x.back()};
    threshold.y = {gamma_c, gamma_c};
  }
  plot.series = {std::move(curve), std::move(threshold)};
  view::PlotMarks marks;
  marks.shown = gui.model.state.neighbourhood;
  draw_plot(gui, plot, {ImGui::GetContentRegionAvail().x, 12.0f * gui.em}, marks);
}

std::string ratio_text(double ratio, const char* remark) {
  return std::isfinite(ratio) ? fmt::format("{:.3f}{}", ratio, remark) : "carries nothing";
}

/// Draws the same rows for all free grains, so that nothing moves between frames.
void draw_state(const view::Inspection& grain, double diameter, double l_min) {
  fact("radius", fmt::format("{:.3f} D", grain.radius / diameter));
  fact("place", fmt::format("{:.2f}, {:.2f} D", grain.x / diameter, grain.y / diameter));
  fact("velocity", fmt::format("{:.2g}, {:.2g} m/s", grain.vx, grain.vy));
  fact("spin", fmt::format("{:.3g} rad/s", grain.omega));
  if (!grain.free) return;
  fact("M_x_x, M_y_y", fmt::format("{:.3g}, {:.3g} J/m", grain.internal_moment.xx, grain.internal_moment.yy));
  fact("M_x_y, M_y_x", fmt::format("{:.3g}, {:.3g} J/m", grain.internal_moment.xy, grain.internal_moment.yx));
  fact("p = s_1 + s_2", fmt::format("{:.3g} J/m", grain.state.mean));
  fact("q = s_1 − s_2", fmt::format("{:.3g} J/m", grain.state.deviator));
  const char* overloaded = grain.overloaded ? ", overloaded" : "";
  fact("γ = q/p", ratio_text(grain.state.ratio, l_min > 0.0 ? "" : overloaded));
  if (l_min > 0.0) fact(fmt::format("γ, ℓ = {:g} D", l_min), ratio_text(grain.gamma, overloaded));
  const bool stressed = std::isfinite(grain.state.ratio);
  fact("major axis", stressed ? fmt::format("{:.1f}° to the bed", grain.state.axis * 180.0 / pi) : "–");
  fact("cluster", grain.cluster >= 0 ? fmt::format("{} grains", grain.cluster_size) : "–");
  const auto& length = grain.coarse_graining_length;
  fact("ℓ_c", length ? fmt::format("{:.2f} D", *length / diameter) : "–");
}

/// Shows the values of the curves at the frame shown, if no grain is selected.
void draw_frame_values(Gui& gui) {
  ImGui::TextWrapped("Click a grain to see its stress, its contacts and its neighbourhood.");
  ImGui::Separator();
  const double tilt = degrees(gui.model.frame().tilt);
  const double place = *gui.model.plot_marks().shown;
  fact("θ", fixed_text(tilt, 3) + "°");
  for (const view::Plot& plot : gui.model.plots())
    for (const view::PlotSeries& series : plot.series) {
      if (!series.quantity || series.law) continue;
      const double value = value_near(series, place);
      if (std::isfinite(value))
        fact(plot.series.size() == 2 ? plot.title + ", " + series.name : series.name,
             fmt::format("{:.4g}{}", value, series.quantity->display.percent ? " %" : ""));
    }
}

}  // namespace

void draw_inspector(Gui& gui) {
  if (draw_contact_inspector(gui)) return;
  const view::Inspection* grain = gui.model.inspection();
  if (!grain) {
    draw_frame_values(gui);
    return;
  }
  ImGui::Text("%s %d", grain->free ? "grain" : "floor grain", grain->grain);
  ImGui::Separator();
  draw_state(*grain, gui.model.mean_diameter(), gui.model.state.map.l_min);
  if (bool follow = gui.model.state.selecting.follow;
      named_checkbox(gui, "follow grain", "follow it", follow, "keeps it in the middle of the picture: L"))
    toggle_following(gui);
  named_checkbox(gui, "outline", "outline its cluster", gui.model.state.highlight_cluster, "i");
  if (grain->free)
    named_checkbox(gui, "neighbourhoods", "draw its neighbourhoods", gui.model.state.show_neighbourhoods,
                   "y");
  draw_contacts(gui, *grain, grain->mass * gui.model.statics().gravity);
  if (!grain->free) return;
  draw_mohr_circle(gui, *grain, gui.model.theta_c());
  named_slider(gui, "neighbourhood", "ℓ drawn", gui.model.state.neighbourhood, 1.0, 40.0, "%.1f D",
               "the neighbourhood drawn: ; and '");
  fact("γ_ℓ there", ratio_text(grain->neighbourhood_gamma, ""));
  draw_curve(gui, *grain);
}

}  // namespace talus::gui
