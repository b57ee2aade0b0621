#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "core/command.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

constexpr float min_drag = 4.0f;              ///< px; shorter movements are clicks
constexpr double contact_reach = 1.0;         ///< D, with ctrl
constexpr double small_contact_reach = 0.15;  ///< D, without ctrl: farther away the grain is meant

/// Returns whether a map shows single contacts.
bool shows_contacts(const pictures::MapLayers& layers) {
  return pictures::any_layer(layers, [](pictures::MapKind kind) {
    return kind == pictures::MapKind::forces || kind == pictures::MapKind::critical;
  });
}

bool is_far(const ImVec2& mouse, const Vec2& place) {
  return std::hypot(static_cast<double>(mouse.x) - place.x, static_cast<double>(mouse.y) - place.y) >
         min_drag;
}

/// Returns the corners of a box, or a lasso unchanged; px.
std::vector<Vec2> closed(const view::SelectingState& selecting) {
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
  const auto grain = view::find_grain(gui.model.bed(), x, y);
  if (!grain) return show_message(gui, "No grain is there.");
  gui.model.select(view::toggled(gui.model.selected_grains(), *grain));
}

void select_contact(Gui& gui, double x, double y) {
  const auto contact = view::find_contact(gui.model.bed(), x, y, contact_reach * gui.model.mean_diameter());
  if (!contact) return show_message(gui, "No contact carries a force here.");
  gui.model.select(*contact);
}

/// Applies the finished outline when the mouse button is released.
void finish(Gui& gui, const ShownMap& map) {
  view::SelectingState& selecting = gui.state.selecting;
  const Vec2 first = selecting.outline.front();
  if (selecting.outline.size() == 1) {
    const render::Point at = map.bed_place({static_cast<float>(first.x), static_cast<float>(first.y)});
    selecting.outline_is_box ? toggle_grain(gui, at.x, at.y) : select_contact(gui, at.x, at.y);
    return;
  }
  std::vector<Vec2> corners;
  for (const Vec2& corner : closed(selecting)) {
    const render::Point at = map.bed_place({static_cast<float>(corner.x), static_cast<float>(corner.y)});
    corners.push_back({at.x, at.y});
  }
  gui.model.select(view::grains_within(gui.model.bed(), corners));
  gui.state.message = fmt::format("Grains selected: {}.", gui.model.selected_grains().size());
}

/// Returns the place where a spring that should be held at the mouse can be held: limited to the distance
/// from the grain that commands allow.
std::array<double, 2> within_reach(const view::ViewModel& model, Index grain, double x, double y) {
  const Frame& frame = model.frame();
  const double dx = x - frame.x[grain], dy = y - frame.y[grain];
  const double share = 0.9 * farthest_drag * model.mean_diameter() / std::max(1e-300, std::hypot(dx, dy));
  return {frame.x[grain] + std::min(1.0, share) * dx, frame.y[grain] + std::min(1.0, share) * dy};
}

/// Holds the spring and reports its action; an error ends the drag.
void hold_at(Gui& gui, Index grain, double x, double y) {
  const auto [held_x, held_y] = within_reach(gui.model, grain, x, y);
  try {
    gui.model.live()->apply({0, CommandKind::drag, grain, held_x, held_y});
    const double distance =
        std::hypot(held_x - gui.model.frame().x[grain], held_y - gui.model.frame().y[grain]);
    gui.state.message = fmt::format(
        "Grain {} is pulled with {:.0f} m g.{}", grain, drag_stiffness * distance / gui.model.mean_diameter(),
        gui.model.live()->status().running ? "" : " The run is paused: space continues.");
    gui.state.drag = view::GrainDrag{grain, x, y, gui.model.live()->status().step};
  } catch (const Error& error) {
    gui.state.message = error.what();
    gui.state.drag.reset();
  }
}

/// Returns the free grain on which a lasso would begin once the mouse moves; a click is meant for a contact.
std::optional<Index> first_grain(const view::ViewModel& model, const ShownMap& map) {
  const view::SelectingState& selecting = model.state.selecting;
  if (selecting.outline.size() != 1 || selecting.outline_is_box || ImGui::GetIO().KeyShift) return {};
  if (!ImGui::IsMouseDragging(0, min_drag)) return {};
  const Vec2 first = selecting.outline.front();
  const render::Point at = map.bed_place({static_cast<float>(first.x), static_cast<float>(first.y)});
  const std::optional<Index> grain = view::find_grain(model.bed(), at.x, at.y);
  return grain && *grain < model.statics().free_count ? grain : std::nullopt;
}

/// Returns whether a grain would be dragged if the run had not ended. No lasso begins there then.
bool refuse_after_end(Gui& gui, const ShownMap& map) {
  view::SelectingState& selecting = gui.state.selecting;
  const bool waits = ImGui::IsItemActive() && !ImGui::IsItemActivated() && ImGui::GetIO().KeyCtrl &&
                     !ImGui::GetIO().KeyShift && selecting.outline.empty();
  if (waits) return true;  // the mouse still moves after the rejection
  if (gui.model.shows_recorded_frame() || !gui.model.live()->status().done || !first_grain(gui.model, map))
    return false;
  selecting.outline.clear();
  gui.state.message =
      "The run has ended: no grain can be pulled. U undoes a command; ctrl with shift draws a lasso.";
  return true;
}

/// Inspects a grain; the selection stays if the grain belongs to it.
void inspect_grain(view::ViewModel& model, Index grain) {
  if (std::ranges::binary_search(model.selected_grains(), grain))
    model.state.selected = grain;
  else
    model.select(std::optional(grain));
}

void release_grain(Gui& gui) {
  gui.state.drag.reset();
  if (!gui.model.live() || !gui.model.live()->status().dragged) return;
  send(gui, {0, CommandKind::release, -1, 0.0, 0.0});
}

void draw_spring(Gui& gui, const ShownMap& map) {
  const view::GrainDrag& drag = *gui.state.drag;
  const Frame& frame = gui.model.frame();
  const ImVec2 from = map.pixel(frame.x[drag.grain], frame.y[drag.grain]), to = map.pixel(drag.x, drag.y);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = packed(gui.colours.curves[2]);
  list.AddLine(from, to, colour, 0.15f * gui.em);
  list.AddCircleFilled(to, 0.25f * gui.em, colour);
}

}  // namespace

render::Point ShownMap::bed_place(const ImVec2& px) const {
  const double right = (static_cast<double>(px.x - corner.x) - camera.origin_x) / camera.scale;
  const double down = (static_cast<double>(px.y - corner.y) - camera.origin_y) / camera.scale;
  return {camera.cosine * right + camera.sine * down, camera.sine * right - camera.cosine * down};
}

ImVec2 ShownMap::pixel(double x, double y) const {
  const double right = camera.cosine * x + camera.sine * y, down = camera.sine * x - camera.cosine * y;
  return {corner.x + static_cast<float>(camera.origin_x + camera.scale * right),
          corner.y + static_cast<float>(camera.origin_y + camera.scale * down)};
}

bool select_by_outline(Gui& gui, const ShownMap& map) {
  const ImGuiIO& io = ImGui::GetIO();
  view::SelectingState& selecting = gui.state.selecting;
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
    finish(gui, map);
    selecting.outline.clear();
  }
  return true;
}

void select_clicked(Gui& gui, double x, double y) {
  const auto contact =
      view::find_contact(gui.model.bed(), x, y, small_contact_reach * gui.model.mean_diameter());
  if (contact && shows_contacts(gui.state.map.layers)) return gui.model.select(*contact);
  const std::optional<Index> grain = view::find_grain(gui.model.bed(), x, y);
  if (!grain) gui.state.message = "No grain is there.";
  gui.model.select(grain);
}

bool drag_grain(Gui& gui, double x, double y, const ShownMap& map) {
  auto& drag = gui.state.drag;
  if (!gui.model.is_live()) {
    drag.reset();
    return false;
  }
  if (!drag) {
    if (refuse_after_end(gui, map)) return true;
    const std::optional<Index> grain =
        gui.model.shows_recorded_frame() ? std::nullopt : first_grain(gui.model, map);
    if (!grain) return false;
    gui.state.selecting.outline.clear();
    gui.state.selecting.follow = false;  // otherwise picture and mouse would chase each other
    inspect_grain(gui.model, *grain);
    hold_at(gui, *grain, x, y);
    return true;
  }
  if (!ImGui::IsMouseDown(0)) {
    release_grain(gui);
    return true;
  }
  // One place per step: further places between two steps would have no effect.
  if (gui.model.live()->status().step != drag->step && (x != drag->x || y != drag->y))
    hold_at(gui, drag->grain, x, y);
  if (drag) draw_spring(gui, map);
  return true;
}

}  // namespace talus::gui
