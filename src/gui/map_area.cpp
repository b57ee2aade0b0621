#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/trigonometry.h"
#include "gui/panels.h"
#include "pictures/bed_view.h"
#include "render/layout.h"

namespace talus::gui {
namespace {

constexpr float min_picture = 4.0f, caption_line = 1.2f;  ///< heights, em

/// Returns the height (px) of the title with the caption to its right or, without room, below it.
float caption_height(const render::FrameView& view, float width, float em) {
  const bool both = rich_width(view.caption) + rich_width(view.title) + em < width;
  const std::size_t lines =
      both ? 1 : wrapped_text(view.title, width).size() + wrapped_text(view.caption, width).size();
  return (caption_line * static_cast<float>(lines) - 0.2f) * em;
}

/// Draws title and caption in a place of that height.
void draw_caption(const render::FrameView& view, float width, float height) {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  float y = corner.y;
  const auto line = [&](const std::string& text, bool right) {
    const float x = right ? corner.x + width - rich_width(text) : corner.x;
    add_rich_text(list, {x, y}, ink, text);
  };
  if (caption_height(view, width, em) < caption_line * em) {
    line(view.title, false);
    line(view.caption, true);
  } else {
    for (const bool right : {false, true})
      for (const std::string& text : wrapped_text(right ? view.caption : view.title, width)) {
        line(text, right);
        y += caption_line * em;
      }
  }
  ImGui::Dummy({width, height});
}

/// Draws the direction of gravity next to the legend.
void draw_gravity(const ImVec2& middle, float em, double fall, ImU32 ink) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto x = static_cast<float>(sine(fall)), y = static_cast<float>(cosine(fall));
  const float reach = 1.1f * em;
  const ImVec2 tip{middle.x + reach * x, middle.y + reach * y};
  list.AddLine({middle.x - reach * x, middle.y - reach * y}, tip, ink, 0.1f * em);
  for (const float side : {-0.5f, 0.5f})
    list.AddLine({tip.x - 0.5f * reach * (x - side * y), tip.y - 0.5f * reach * (y + side * x)}, tip, ink,
                 0.1f * em);
  list.AddText({middle.x - 1.5f * em, middle.y - 0.5f * em}, ink, "g");
}

/// Describes the grain under the mouse. The second view shows the text of the first, and its own value.
void describe_grain(Gui& gui, const view::View& view, const render::Point& place, Index grain) {
  const double diameter = view.run.mean_diameter();
  ImGui::BeginTooltip();
  rich_text(fmt::format("{:.1f}, {:.1f} D: {}", place.x / diameter, place.y / diameter,
                        grain_text(gui.model.first(), grain)));
  const render::Bar* const bar = view.second ? view.bar() : nullptr;
  const auto k = static_cast<std::size_t>(grain);
  if (bar != nullptr && k < bar->values.size() && !std::isnan(bar->values[k]))
    rich_text(fmt::format("{}: {:.4g}", bar->title, bar->values[k]));
  ImGui::EndTooltip();
}

void use_mouse(Gui& gui, const view::View& view, const ShownMap& shown) {
  const ImGuiIO& io = ImGui::GetIO();
  const render::Point place = shown.bed_place(io.MousePos);
  // The second view is for looking only; selections and drags belong to the first.
  if (!view.second && drag_grain(gui, place.x, place.y, shown)) return;
  const bool outlining = !view.second && select_by_outline(gui, shown);
  if (ImGui::IsItemHovered()) {
    if (io.MouseWheel != 0.0f)
      zoom_about(gui, std::pow(1.25, static_cast<double>(io.MouseWheel)), place.x, place.y);
    const std::optional<Index> grain = view::find_grain(view.run.bed(), place.x, place.y);
    if (grain && !ImGui::IsMouseDown(0)) describe_grain(gui, view, place, *grain);
    const bool dragged = io.MouseDragMaxDistanceSqr[0] > 16.0f;
    if (ImGui::IsMouseReleased(0) && !dragged && !outlining) select_clicked(gui, place.x, place.y);
  }
  if (outlining) return;
  const bool panning =
      ImGui::IsItemActive() || (ImGui::IsItemHovered() && (io.MouseDown[1] || io.MouseDown[2]));
  if (panning && (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)) {
    const render::Point before =
        shown.bed_place({io.MousePos.x - io.MouseDelta.x, io.MousePos.y - io.MouseDelta.y});
    move_picture(gui, before.x - place.x, before.y - place.y);
  }
}

/// Returns whether there is room for the scale bar and the arrow of gravity to the right of the legend.
bool shows_gravity(float width, float em) { return width > 26.0f * em; }
bool shows_scale(float width, float em) { return width > 40.0f * em; }

constexpr float gravity_room = 3.5f, scale_room = 9.0f;  ///< em

float legend_width(float width, float em) {
  return width - (shows_gravity(width, em) ? gravity_room * em : 0.0f) -
         (shows_scale(width, em) ? scale_room * em : 0.0f);
}

/// Draws the scale bar, which ends at `right`, with its length; `pixels` is the size of a mean diameter.
void draw_scale(Gui& gui, const ImVec2& right, double pixels) {
  const float em = gui.em;
  constexpr float longest = 0.3f;  // fraction of the width passed to scale_diameters
  const double diameters =
      pictures::scale_diameters(static_cast<double>((scale_room - 1.5f) * em / longest) / pixels, 1.0);
  const auto length = static_cast<float>(diameters * pixels);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = packed(gui.colours.ink);
  const float left = right.x - length;
  list.AddLine({left, right.y}, right, ink, 0.1f * em);
  for (const float x : {left, right.x})
    list.AddLine({x, right.y - 0.3f * em}, {x, right.y + 0.3f * em}, ink, 0.1f * em);
  const std::string label = fmt::format("{:.4g} D", diameters);
  const float wide = rich_width(label);
  add_rich_text(list, {left + 0.5f * (length - wide), right.y + 0.3f * em}, ink, label);
  note_place(gui, "scale", {left, right.y - 0.3f * em}, {right.x, right.y + 1.3f * em});
}

/// Returns the height below a map; if it is `alone`, at least that of the arrow of gravity.
float below_map(const render::FrameView& annotated, float width, float em, bool alone) {
  return alone ? std::max(2.6f * em, legend_height(annotated, legend_width(width, em)))
               : legend_height(annotated, width);
}

constexpr float gap = 0.8f, min_width = 12.0f;  ///< between two views, and of each of their pictures, em

/// Layout of one view, or of two: side by side, or one above the other.
struct MapLayout {
  bool columns = true;
  ImVec2 pane;         ///< size of each view, including everything above and below its picture
  ImVec2 picture;      ///< room for the picture
  float above = 0.0f;  ///< height of title and caption
};

MapLayout lay_out_maps(std::span<const view::View> views, const ImVec2& room, bool columns, float em) {
  MapLayout layout{columns, room, {}};
  const bool alone = views.size() == 1;
  float& divided = columns ? layout.pane.x : layout.pane.y;
  if (!alone) divided = 0.5f * (divided - gap * em);
  float below = 0.0f;
  for (const view::View& view : views) {
    const render::FrameView& annotated = view.annotated_map();
    layout.above = std::max(layout.above, caption_height(annotated, layout.pane.x, em));
    below = std::max(below, below_map(annotated, layout.pane.x, em, alone));
  }
  layout.picture = {layout.pane.x,
                    layout.pane.y - layout.above - below - 2.0f * ImGui::GetStyle().ItemSpacing.y};
  return layout;
}

/// Returns the width in px that the bed fills; 0 if there is no room.
float bed_width(const MapLayout& layout, double aspect, float em) {
  if (layout.picture.x < min_width * em || layout.picture.y < min_picture * em) return 0.0f;
  return std::min(layout.picture.x, layout.picture.y * static_cast<float>(aspect));
}

/// Draws a picture of the bed, handles the mouse on it, and, if it is `alone`, draws the scale and the arrow
/// of gravity at its lower right.
void draw_map_pane(Gui& gui, const view::View& pane, const ImVec2& room, bool alone) {
  const int pixels = std::max(static_cast<int>(room.x), render::smallest_width);
  const render::FrameView view = pane.map(static_cast<double>(room.x) / static_cast<double>(room.y));
  const render::Layout layout = render::lay_out(view, pixels, render::embedded_font());
  const float shown_height = room.x * static_cast<float>(layout.height) / static_cast<float>(layout.width);
  ShownMap shown{ImGui::GetCursorScreenPos(), layout.bed.camera};
  const ImVec2 end{shown.corner.x + room.x, shown.corner.y + std::min(shown_height, room.y)};
  const char* name = pane.second ? "second map" : "map";
  ImGui::InvisibleButton(name, {room.x, std::max(1.0f, end.y - shown.corner.y)},
                         ImGuiButtonFlags_MouseButtonLeft);
  note_place(gui, name);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddImage(texture_id(gui.draw_map(view, pixels, pane.second ? 1 : 0)), shown.corner, end, {0.0f, 0.0f},
                {1.0f, (end.y - shown.corner.y) / shown_height});
  const ImVec2 under{shown.corner.x + room.x - 1.4f * gui.em, ImGui::GetCursorScreenPos().y + 1.2f * gui.em};
  if (shows_gravity(room.x, gui.em) && alone) {
    draw_gravity(under, gui.em, view.tilt - view.turn, packed(gui.colours.ink));
    note_place(gui, "gravity", {under.x - 1.5f * gui.em, under.y - 1.1f * gui.em},
               {under.x + 1.1f * gui.em, under.y + 1.1f * gui.em});
  }
  if (shows_scale(room.x, gui.em) && alone)
    draw_scale(gui, {under.x - 2.8f * gui.em, under.y - 0.5f * gui.em},
               pane.run.mean_diameter() * layout.bed.camera.scale);
  use_mouse(gui, pane, shown);
}

}  // namespace

std::string grain_text(const view::View& view, Index grain) {
  const view::ViewModel& model = view.run;
  std::string text = fmt::format("grain {}", grain);
  if (grain >= model.statics().free_count) return "floor " + text;
  const auto of_grain = static_cast<std::size_t>(grain);
  bool gamma_reported = false;
  for (const render::Legend& legend : view.annotated_map().legends)
    for (const render::Bar& bar : legend.bars) {
      if (of_grain >= bar.values.size()) continue;
      const double value = bar.values[of_grain];
      gamma_reported = gamma_reported || bar.symbol == "γ";
      if (std::isnan(value))
        text += bar.symbol == "γ" ? ", carries nothing" : fmt::format(", {}: none", bar.symbol);
      else
        text += fmt::format(", {} = {:.3g}{}{}", bar.symbol, value,
                            bar.unit.empty() || bar.unit.starts_with("°") ? "" : " ", bar.unit);
      if (bar.symbol == "γ" && !std::isnan(value)) text += ", " + pictures::reading_text(view.chosen);
    }
  if (gamma_reported || !pictures::any_layer(view.chosen.layers, [](pictures::MapKind kind) {
        return pictures::shows_gamma(kind);
      }))
    return text;
  const double gamma = model.frame().gamma[of_grain];
  return std::isnan(gamma)
             ? text + ", carries nothing"
             : fmt::format("{}, γ = {:.3g}, {}", text, gamma, pictures::reading_text(view.chosen));
}

float map_area_height(const render::FrameView& annotated, float width, float picture, float em) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float inner = width - 2.0f * style.WindowPadding.x;
  return picture + caption_height(annotated, inner, em) + below_map(annotated, inner, em, true) +
         2.0f * (style.WindowPadding.y + style.ItemSpacing.y);
}

/// Two views are side by side or one above the other, whichever shows more; without room there is one.
void draw_map_area(Gui& gui) {
  static constexpr const char* no_room =
      "There is no room for two views: make the window larger, or hide panels (h, l).";
  const ImVec2 room = ImGui::GetContentRegionAvail();
  std::vector<view::View> views = {gui.model.first()};
  if (gui.state.second_view.shown) views.push_back(gui.model.second());
  const double aspect = views[0].bed_aspect();
  MapLayout layout = lay_out_maps(views, room, true, gui.em);
  if (views.size() == 2) {
    const MapLayout rows = lay_out_maps(views, room, false, gui.em);
    if (bed_width(rows, aspect, gui.em) > bed_width(layout, aspect, gui.em)) layout = rows;
    if (gui.state.message == no_room) gui.state.message.clear();
    if (bed_width(layout, aspect, gui.em) == 0.0f) {
      gui.state.message = no_room;
      views.pop_back();
      layout = lay_out_maps(views, room, true, gui.em);
    }
  }
  const bool alone = views.size() == 1;
  layout.picture = {std::max(layout.picture.x, 1.0f), std::max(layout.picture.y, min_picture * gui.em)};
  for (const view::View& view : views) {
    if (view.second && layout.columns) ImGui::SameLine(0.0f, gap * gui.em);
    ImGui::BeginChild(view.second ? "second view" : "first view", layout.pane, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    draw_caption(view.annotated_map(), layout.pane.x, layout.above);
    draw_map_pane(gui, view, layout.picture, alone);
    draw_legends(gui, view.annotated_map(), alone ? legend_width(layout.pane.x, gui.em) : layout.pane.x,
                 !view.second);
    ImGui::EndChild();
  }
}

}  // namespace talus::gui
