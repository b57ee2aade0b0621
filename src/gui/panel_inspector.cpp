#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

/// Draws the contact force in its Coulomb cone: f_n upwards, f_t to the right, at the same scale.
void draw_cone(Gui& gui, const view::ContactInspection& contact) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, em = gui.em;
  const ImVec2 size{width, 0.6f * width};
  ImGui::Dummy(size);
  note_place(gui, "cone");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const ImU32 law_colour = packed(gui.colours.curves[1]), force_colour = packed(gui.colours.curves[2]);
  const ImVec2 apex{corner.x + 0.5f * width, corner.y + size.y - 0.6f * em};
  const float reach = size.y - 1.8f * em;  // length of the axis of f_n
  list.AddLine({corner.x + 0.05f * width, apex.y}, {corner.x + 0.95f * width, apex.y}, ink);
  list.AddLine(apex, {apex.x, apex.y - reach}, ink);
  const auto mu = static_cast<float>(contact.friction);
  const float rise = std::min(reach, mu > 0.0f ? 0.45f * width / mu : reach);
  for (const float side : {-1.0f, 1.0f})
    list.AddLine(apex, {apex.x + side * mu * rise, apex.y - rise}, law_colour, 1.5f);
  add_rich_text(list, {apex.x + 0.3f * em, corner.y}, ink, "f_n");
  add_rich_text(list, {corner.x + 0.95f * width - em, apex.y - 1.3f * em}, ink, "f_t");
  if (!(contact.fn > 0.0)) return;
  const float shown = 0.85f * rise;  // length of f_n
  const ImVec2 tip{apex.x + shown * static_cast<float>(contact.ft / contact.fn), apex.y - shown};
  list.AddLine(apex, tip, force_colour, 2.5f);
  list.AddCircleFilled(tip, 0.25f * em, force_colour);
}

const char* status_text(ContactStatus status) {
  if (status == ContactStatus::open) return "open";
  return status == ContactStatus::sliding ? "slides" : "sticks";
}

void draw_forces(Gui& gui, const view::ContactInspection& contact) {
  const double diameter = gui.model.mean_diameter();
  if (!contact.carries) {
    fact("force", "none in this frame");
    return;
  }
  fact("place", fmt::format("{:.2f}, {:.2f} D", contact.px / diameter, contact.py / diameter));
  fact("normal", fmt::format("{:.1f}° to the bed", degrees(std::atan2(contact.ny, contact.nx))));
  fact("f_n", fmt::format("{:.4g} N/m", contact.fn));
  fact("f_t", fmt::format("{:.4g} N/m", contact.ft));
  fact("f_t/f_n", fmt::format("{:.3f}, μ = {:g}", contact.ft / contact.fn, contact.friction));
  if (std::isfinite(contact.mobilisation))
    fact("mobilised", fmt::format("{:.1f} %", 100.0 * contact.mobilisation));
  fact("status", status_text(contact.status));
}

/// Draws the history; a click on a curve goes to the frame there.
void draw_history(Gui& gui) {
  const view::PlotMarks marks = gui.model.plot_marks();
  for (const view::Plot& plot : gui.model.contact_history()) {
    const auto clicked = draw_plot(gui, plot, {ImGui::GetContentRegionAvail().x, 11.0f * gui.em}, marks);
    if (!clicked) continue;
    gui.model.play(false);
    gui.model.go_to_place(*clicked);
  }
}

/// Shows one of the two bodies; a click selects a grain.
void offer_body(Gui& gui, const char* name, Index body, const std::string& text) {
  ImGui::BeginDisabled(body >= gui.model.frame().grain_count());
  if (named_button(gui, name, text.c_str(), "select this grain")) gui.model.select(std::optional(body));
  ImGui::EndDisabled();
}

/// Lists the contacts, last in the panel, because their number changes; a click on a row selects one.
void draw_contacts(Gui& gui, const view::Inspection& grain, double weight) {
  const ImGuiTableFlags flags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("contacts", 4, flags)) return;
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
  const double gamma_c = sine(gui.model.theta_c()) * gui.state.map.threshold_factor;
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
  marks.shown = gui.state.neighbourhood;
  draw_plot(gui, plot, {ImGui::GetContentRegionAvail().x, 12.0f * gui.em}, marks);
}

std::string ratio_text(double ratio, const char* remark) {
  return std::isfinite(ratio) ? fmt::format("{:.3f}{}", ratio, remark) : "carries nothing";
}

/// Draws the same rows for all free grains, so that nothing moves between frames.
void draw_state(const BedFrame& bed, const view::Inspection& grain, double l_min) {
  const Frame& frame = bed.frame;
  const auto i = static_cast<std::size_t>(grain.grain);
  const double diameter = bed.statics.mean_diameter;
  fact("radius", fmt::format("{:.3f} D", bed.statics.radius[i] / diameter));
  fact("place", fmt::format("{:.2f}, {:.2f} D", frame.x[i] / diameter, frame.y[i] / diameter));
  fact("velocity", fmt::format("{:.2g}, {:.2g} m/s", frame.vx[i], frame.vy[i]));
  fact("spin", fmt::format("{:.3g} rad/s", frame.omega[i]));
  if (!grain.free) return;
  const Tensor2& moment = frame.internal_moment[i];
  fact("M_x_x, M_y_y", fmt::format("{:.3g}, {:.3g} J/m", moment.xx, moment.yy));
  fact("M_x_y, M_y_x", fmt::format("{:.3g}, {:.3g} J/m", moment.xy, moment.yx));
  fact("p = s_1 + s_2", fmt::format("{:.3g} J/m", grain.state.mean));
  fact("q = s_1 − s_2", fmt::format("{:.3g} J/m", grain.state.deviator));
  const char* overloaded = grain.overloaded ? ", overloaded" : "";
  fact("γ = q/p", ratio_text(grain.state.ratio, l_min > 0.0 ? "" : overloaded));
  if (l_min > 0.0) fact(fmt::format("γ, ℓ = {:g} D", l_min), ratio_text(grain.gamma, overloaded));
  const bool stressed = std::isfinite(grain.state.ratio);
  fact("major axis", stressed ? fmt::format("{:.1f}° to the bed", degrees(grain.state.axis)) : "–");
  fact("cluster", grain.cluster >= 0 ? counted(static_cast<std::size_t>(grain.cluster_size), "grain") : "–");
  const auto& length = grain.coarse_graining_length;
  fact("ℓ_c", length ? fmt::format("{:.2f} D", *length / diameter) : "–");
}

/// Shows the values of the curves at the frame shown, if no grain is selected.
void draw_frame_values(Gui& gui) {
  ImGui::TextWrapped("Click a grain to see its stress, its contacts and its neighbourhood.");
  ImGui::Separator();
  const Frame& frame = gui.model.frame();
  const double place = *gui.model.plot_marks().shown;
  fact("θ", degrees_text(frame.tilt, 3) + "°");
  if (gui.model.theta_c_known())
    fact("θ_c − θ", fmt::format("{:.2f}°", degrees(gui.model.theta_c() - std::abs(frame.tilt))));
  fact("step", std::to_string(frame.step));
  fact("contacts", std::to_string(frame.contacts.count()));
  for (const view::Plot& plot : gui.model.plots())
    for (const view::PlotSeries& series : plot.series) {
      if (!series.quantity || series.law) continue;
      const double value = value_near(series, place);
      if (std::isfinite(value))
        fact(plot.series.size() == 2 ? plot.title + ", " + series.name : series.name,
             fmt::format("{:.4g}{}", value, series.quantity->display.percent ? " %" : ""));
    }
}

/// Draws the properties of the selected contact, with its history; returns false if none is selected.
bool draw_contact_inspector(Gui& gui) {
  const auto contact = gui.model.contact_inspection();
  if (!contact) return false;
  ImGui::TextUnformatted("contact of");
  offer_body(gui, "first body", contact->key.a, contact->a_name);
  ImGui::SameLine();
  offer_body(gui, "second body", contact->key.b, contact->b_name);
  ImGui::Separator();
  draw_forces(gui, *contact);
  draw_cone(gui, *contact);
  draw_history(gui);
  return true;
}

}  // namespace

void draw_inspector(Gui& gui) {
  if (draw_contact_inspector(gui)) return;
  const view::Inspection* grain = gui.model.first().inspection();
  if (!grain) {
    draw_frame_values(gui);
    return;
  }
  ImGui::Text("%s %d", grain->free ? "grain" : "floor grain", grain->grain);
  ImGui::Separator();
  draw_state(gui.model.bed(), *grain, gui.state.map.l_min);
  if (bool follow = gui.state.selecting.follow;
      named_checkbox(gui, "follow grain", "follow it", follow, "keeps it in the middle of the picture: L"))
    toggle_following(gui);
  named_checkbox(gui, "outline", "outline its cluster", gui.state.highlight_cluster, "i");
  if (grain->free)
    named_checkbox(gui, "neighbourhoods", "draw its neighbourhoods", gui.state.show_neighbourhoods, "y");
  if (grain->free) {
    draw_mohr_circle(gui, *grain, gui.model.theta_c());
    named_slider(gui, "neighbourhood", "ℓ drawn", gui.state.neighbourhood, 1.0, 40.0, "%.1f D",
                 "the neighbourhood drawn: ; and '");
    fact("γ_ℓ there", ratio_text(grain->neighbourhood_gamma, ""));
    draw_curve(gui, *grain);
  }
  const RunStatics& statics = gui.model.statics();
  draw_contacts(gui, *grain, statics.mass[static_cast<std::size_t>(grain->grain)] * statics.gravity);
}

}  // namespace talus::gui
