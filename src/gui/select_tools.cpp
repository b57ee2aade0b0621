#include "gui/select_tools.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace talus {
namespace {

constexpr double contact_reach = 1.0;         ///< D, with ctrl
constexpr double small_contact_reach = 0.15;  ///< D, without: elsewhere it is the grain that is meant

/// Whether a map shows single contacts.
bool shows_contacts(const MapLayers& layers) {
  return any_layer(layers, [](MapKind kind) { return kind == MapKind::forces || kind == MapKind::critical; });
}

bool is_far(const ImVec2& mouse, const Vec2& place) {
  return std::hypot(static_cast<double>(mouse.x) - place.x, static_cast<double>(mouse.y) - place.y) >
         least_drag;
}

/// A box by its corners, a lasso as it is; px.
std::vector<Vec2> closed(const SelectingState& selecting) {
  if (!selecting.outline_is_box) return selecting.outline;
  const Vec2 from = selecting.outline.front(), to = selecting.outline.back();
  return {from, {to.x, from.y}, to, {from.x, to.y}};
}

void draw_outline(const std::vector<Vec2>& corners, ImU32 colour) {
  std::vector<ImVec2> px;
  for (const Vec2& corner : corners)
    px.push_back({static_cast<float>(corner.x), static_cast<float>(corner.y)});
  ImGui::GetWindowDrawList()->AddPolyline(px.data(), static_cast<int>(px.size()), colour, ImDrawFlags_Closed,
                                          1.5f);
}

void toggle_grain(Gui& gui, double x, double y) {
  const auto grain = gui.model.grain_at(x, y);
  if (grain)
    gui.model.select(toggled(gui.model.selected_grains(), *grain));
  else
    gui.model.state.message = "No grain is there.";
}

void select_contact(Gui& gui, double x, double y) {
  const auto contact = gui.model.contact_at(x, y, contact_reach * gui.model.mean_diameter());
  if (contact)
    gui.model.select(*contact);
  else
    gui.model.state.message = "No contact that carries a force is there.";
}

/// What the outline was drawn for, once the mouse is let go.
void finish(Gui& gui, const BedPlace& bed_place) {
  SelectingState& selecting = gui.model.state.selecting;
  const Vec2 first = selecting.outline.front();
  if (selecting.outline.size() == 1) {
    const Point at = bed_place({static_cast<float>(first.x), static_cast<float>(first.y)});
    selecting.outline_is_box ? toggle_grain(gui, at.x, at.y) : select_contact(gui, at.x, at.y);
    return;
  }
  std::vector<Vec2> corners;
  for (const Vec2& corner : closed(selecting)) {
    const Point at = bed_place({static_cast<float>(corner.x), static_cast<float>(corner.y)});
    corners.push_back({at.x, at.y});
  }
  const std::vector<Index> found = gui.model.grains_within(corners);
  gui.model.select_found(found);
  gui.model.state.message =
      fmt::format("Grains within: {}; selected: {}.", found.size(), gui.model.selected_grains().size());
}

}  // namespace

bool select_by_outline(Gui& gui, const BedPlace& bed_place) {
  const ImGuiIO& io = ImGui::GetIO();
  SelectingState& selecting = gui.model.state.selecting;
  const Vec2 mouse{static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)};
  if (ImGui::IsItemActivated() && (io.KeyShift || io.KeyCtrl)) {
    selecting.outline = {mouse};
    selecting.outline_is_box = io.KeyShift && !io.KeyCtrl;
  }
  if (selecting.outline.empty()) return false;
  if (is_far(io.MousePos, selecting.outline.back())) {
    if (selecting.outline_is_box && selecting.outline.size() == 2) selecting.outline.pop_back();
    selecting.outline.push_back(mouse);
  }
  if (selecting.outline.size() > 1) draw_outline(closed(selecting), packed(gui.colours.accent));
  if (!io.MouseDown[0]) {
    finish(gui, bed_place);
    selecting.outline.clear();
  }
  return true;
}

void select_clicked(Gui& gui, double x, double y) {
  ViewModel& model = gui.model;
  const bool contacts = shows_contacts(model.state.map.layers);
  const auto contact =
      contacts ? model.contact_at(x, y, small_contact_reach * model.mean_diameter()) : std::nullopt;
  if (contact) return model.select(*contact);
  const std::optional<Index> grain = model.grain_at(x, y);
  if (!grain) model.state.message = "No grain is there.";
  model.select(grain);
}

}  // namespace talus
