#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/trigonometry.h"
#include "gui/branching.h"
#include "gui/panels.h"
#include "gui/run_actions.h"
#include "gui/select_tools.h"
#include "render/layout.h"

namespace talus {
namespace {

constexpr float legend_lines = 2.8f;  ///< height of the legend, em

/// The map as it lies in the window.
struct ShownMap {
  ImVec2 corner;
  Camera camera;

  Point bed_place(const ImVec2& mouse) const {
    const double right = (static_cast<double>(mouse.x - corner.x) - camera.origin_x) / camera.scale;
    const double down = (static_cast<double>(mouse.y - corner.y) - camera.origin_y) / camera.scale;
    return {camera.cosine * right + camera.sine * down, camera.sine * right - camera.cosine * down};
  }
  ImVec2 pixel(double x, double y) const {
    const double right = camera.cosine * x + camera.sine * y, down = camera.sine * x - camera.cosine * y;
    return {corner.x + static_cast<float>(camera.origin_x + camera.scale * right),
            corner.y + static_cast<float>(camera.origin_y + camera.scale * down)};
  }
};

void draw_caption(const FrameView& view, float width) {
  const ImFont& font = *ImGui::GetFont();
  const float size = ImGui::GetFontSize();
  const float caption = rich_width(font, size, view.caption), title = rich_width(font, size, view.title);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const bool both = title + caption + size < width;
  const float second = both ? corner.y : corner.y + 1.2f * size;
  add_rich_text(list, corner, ink, view.title);
  add_rich_text(list, {std::max(corner.x, corner.x + width - caption), second}, ink, view.caption);
  ImGui::Dummy({width, second + size - corner.y});
}

/// Gravity, beside the legend.
void draw_gravity(const ImVec2& middle, float em, double fall) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = IM_COL32(0, 0, 0, 255);
  const auto x = static_cast<float>(sine(fall)), y = static_cast<float>(cosine(fall));
  const float reach = 1.1f * em;
  const ImVec2 tip{middle.x + reach * x, middle.y + reach * y};
  list.AddLine({middle.x - reach * x, middle.y - reach * y}, tip, ink, 0.1f * em);
  for (const float side : {-0.5f, 0.5f})
    list.AddLine({tip.x - 0.5f * reach * (x - side * y), tip.y - 0.5f * reach * (y + side * x)}, tip, ink,
                 0.1f * em);
  list.AddText({middle.x - 1.5f * em, middle.y - 0.5f * em}, ink, "g");
}

void use_mouse(Gui& gui, const ShownMap& shown) {
  const ImGuiIO& io = ImGui::GetIO();
  ViewState& state = gui.model.state;
  const Point place = shown.bed_place(io.MousePos);
  const BedPlace bed_place = [&](const ImVec2& px) { return shown.bed_place(px); };
  if (drag_grain(gui, place.x, place.y, {[&](double x, double y) { return shown.pixel(x, y); }, bed_place}))
    return;
  const bool outlining = select_by_outline(gui, bed_place);
  if (ImGui::IsItemHovered()) {
    if (io.MouseWheel != 0.0f)
      zoom_about(gui, std::pow(1.25, static_cast<double>(io.MouseWheel)), place.x, place.y);
    const double diameter = gui.model.mean_diameter();
    const std::optional<Index> grain = gui.model.grain_at(place.x, place.y);
    if (grain && !ImGui::IsMouseDown(0))
      ImGui::SetTooltip("%.1f, %.1f D: %s", place.x / diameter, place.y / diameter,
                        grain_text(gui.model, *grain).c_str());
    const bool dragged = io.MouseDragMaxDistanceSqr[0] > 16.0f;
    if (ImGui::IsMouseReleased(0) && !dragged && !outlining) select_clicked(gui, place.x, place.y);
  }
  if (outlining) return;
  const bool panning =
      ImGui::IsItemActive() || (ImGui::IsItemHovered() && (io.MouseDown[1] || io.MouseDown[2]));
  if (panning && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
    const Point before = shown.bed_place({io.MousePos.x - io.MouseDelta.x, io.MousePos.y - io.MouseDelta.y});
    state.selecting.follow = false;
    state.camera.centre_x -= place.x - before.x;
    state.camera.centre_y -= place.y - before.y;
  }
}

}  // namespace

std::string grain_text(const ViewModel& model, Index grain) {
  std::string text = fmt::format("grain {}", grain);
  if (grain >= model.statics().free_count) return "floor " + text;
  if (!any_layer(model.state.map.layers, [](MapKind kind) { return shows_gamma(kind); })) return text;
  const double gamma = model.frame().gamma[grain];
  return std::isnan(gamma) ? text + ", carries nothing"
                           : fmt::format("{}, γ = {:.3f}, {}", text, gamma, reading_text(model.state.map));
}

float map_area_height(float picture, float em) {
  const ImGuiStyle& style = ImGui::GetStyle();
  return picture + (1.0f + legend_lines) * em + 2.0f * (style.WindowPadding.y + style.ItemSpacing.y);
}

void draw_map_area(Gui& gui) {
  const float width = ImGui::GetContentRegionAvail().x;
  const FrameView& annotated = gui.model.annotated_map();
  draw_caption(annotated, width);
  const ImVec2 room{std::max(width, 1.0f),
                    std::max(ImGui::GetContentRegionAvail().y - legend_lines * gui.em, 4.0f * gui.em)};
  const int pixels = std::max(static_cast<int>(room.x), smallest_width);
  const FrameView view = gui.model.map(static_cast<double>(room.x) / static_cast<double>(room.y));
  const Layout layout = lay_out(view, pixels, embedded_font());
  const float shown_height = room.x * static_cast<float>(layout.height) / static_cast<float>(layout.width);
  ShownMap shown{ImGui::GetCursorScreenPos(), layout.bed.camera};
  const ImVec2 end{shown.corner.x + room.x, shown.corner.y + std::min(shown_height, room.y)};
  ImGui::InvisibleButton("map", {room.x, std::max(1.0f, end.y - shown.corner.y)},
                         ImGuiButtonFlags_MouseButtonLeft);
  note_place(gui, "map");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddImage(gui.draw_map(view, pixels, static_cast<int>(room.y)), shown.corner, end, {0.0f, 0.0f},
                {1.0f, (end.y - shown.corner.y) / shown_height});
  const ImVec2 under{shown.corner.x + room.x - 1.4f * gui.em, ImGui::GetCursorScreenPos().y + 1.2f * gui.em};
  if (room.x > 26.0f * gui.em) draw_gravity(under, gui.em, view.tilt - view.turn);
  use_mouse(gui, shown);
  draw_legends(gui.model.annotated_map());
}

}  // namespace talus
