#include <algorithm>
#include <cmath>
#include <fmt/core.h>

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

void draw_forces(Gui& gui, const view::ContactInspection& contact) {
  const double diameter = gui.model.mean_diameter();
  if (!contact.carries) {
    fact("force", "none in this frame");
    return;
  }
  fact("place", fmt::format("{:.2f}, {:.2f} D", contact.px / diameter, contact.py / diameter));
  fact("normal",
       fmt::format("{:.1f}° to the bed", std::atan2(contact.ny, contact.nx) * 180.0 / 3.14159265358979));
  fact("f_n", fmt::format("{:.4g} N/m", contact.fn));
  fact("f_t", fmt::format("{:.4g} N/m", contact.ft));
  fact("f_t/f_n", fmt::format("{:.3f}, μ = {:g}", contact.ft / contact.fn, contact.friction));
  if (std::isfinite(contact.mobilisation))
    fact("mobilised", fmt::format("{:.1f} %", 100.0 * contact.mobilisation));
  fact("status", contact.status == ContactStatus::sliding ? "slides" : "sticks");
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

}  // namespace

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

}  // namespace talus::gui
