#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <fmt/core.h>
#include <span>
#include <utility>
#include <vector>

#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/panels.h"
#include "pictures/scale.h"

namespace talus::gui {
namespace {

ImU32 event_colour(const Palette& colours, view::TimelineEvent::Kind kind) {
  const std::array of_kinds = {&colours.ink, &colours.failure, &colours.command, &colours.rearrangement};
  return packed(*of_kinds.at(static_cast<std::size_t>(kind)));
}

/// Transformation from frames to pixels.
struct Track {
  ImVec2 low, high;   ///< corners
  double last = 1.0;  ///< place of the right end, in frames

  float px(double place) const {
    return low.x + static_cast<float>(std::clamp(place / last, 0.0, 1.0)) * (high.x - low.x);
  }
  double place(float x) const {
    return last * std::clamp(static_cast<double>((x - low.x) / (high.x - low.x)), 0.0, 1.0);
  }
};

/// Room for labels in a row, from left to right in any order.
class LabelRow {
 public:
  /// Reserves room for a label that begins at `low`, px; returns whether there is any.
  bool take(float low, float width) {
    const float high = low + width + 0.4f * ImGui::GetFontSize();
    if (std::ranges::any_of(taken_,
                            [=](const auto& other) { return low < other.second && other.first < high; }))
      return false;
    taken_.emplace_back(low, high);
    return true;
  }

 private:
  std::vector<std::pair<float, float>> taken_;
};

/// Draws the angles below the track: those at which a programme turns or begins to be held, and round ones as
/// far as there is room. Frames of the flow after a tilt that only grows have none.
void draw_angles(Gui& gui, const Track& track, std::span<const double> tilts, bool turns) {
  LabelRow row;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = packed(gui.colours.ink);
  const auto draw_tick = [&](double place, const std::string& label, bool always) {
    const ImVec2 top{track.px(place), track.high.y};
    const float width = ImGui::CalcTextSize(label.c_str()).x, low = top.x - 0.5f * width;
    const bool room = row.take(low, width);
    if (room) list.AddText({low, top.y + 0.25f * gui.em}, ink, label.c_str());
    if (room) note_place(gui, "angle " + label, top, {top.x, top.y + 1.25f * gui.em});
    if (room || always) list.AddLine(top, {top.x, top.y + 0.3f * gui.em}, ink);
  };
  if (!turns) tilts = {tilts.begin(), std::ranges::is_sorted_until(tilts)};
  const auto way = [&](std::size_t from) { return tilts[from + 1] <=> tilts[from]; };
  for (std::size_t k = 0; turns && k < tilts.size(); ++k)
    if (k == 0 || k + 1 == tilts.size() || way(k - 1) != way(k))
      draw_tick(static_cast<double>(k),
                pictures::number_label(std::round(100.0 * degrees(tilts[k])) / 100.0) + "°", true);
  const auto [lowest, highest] = std::ranges::minmax(tilts);
  if (lowest == highest) return;
  const int most = std::max(2, static_cast<int>((track.high.x - track.low.x) / (5.0f * gui.em)));
  for (const pictures::RoundTick& tick : pictures::round_ticks(degrees(lowest), degrees(highest), most))
    for (std::size_t k = 0; k + 1 < tilts.size(); ++k) {
      const double share = (radians(tick.value) - tilts[k]) / (tilts[k + 1] - tilts[k]);
      if (share >= 0.0 && share <= 1.0) draw_tick(static_cast<double>(k) + share, tick.label + "°", false);
    }
}

/// Draws the labels above the track, theta_c with priority, each above its stroke or, if there is no room, to
/// its left or right. A label whose name would hide other strokes ends before its comma.
void draw_labels(const Palette& colours, ImDrawList& list, const Track& track,
                 std::span<const view::TimelineEvent> events, float em) {
  LabelRow row;
  const auto draw_label = [&](const view::TimelineEvent& event) {
    for (const bool named : {true, false})
      for (const float before : {0.5f, -0.05f, 1.05f}) {  // share of the label to the left of the stroke
        const std::string label = named ? event.label : event.label.substr(0, event.label.find(','));
        const float width = rich_width(label);
        const float low =
            std::max(track.low.x, std::min(track.px(event.place) - before * width, track.high.x - width));
        const auto is_hidden = [&](const view::TimelineEvent& other) {
          const float x = track.px(other.place);
          return &other != &event && !other.label.empty() && low < x && x < low + width;
        };
        if ((named && std::ranges::any_of(events, is_hidden)) || !row.take(low, width)) continue;
        const ImU32 colour = event_colour(colours, event.kind);
        return add_rich_text(list, {low, track.low.y - 1.25f * em}, colour, label);
      }
  };
  for (const bool failure : {true, false})
    for (const view::TimelineEvent& event : events)
      if (!event.label.empty() && (event.kind == view::TimelineEvent::Kind::failure) == failure)
        draw_label(event);
}

/// Draws a stroke for each event. That of a rearrangement is as high as it is large; a command has an arrow.
void draw_events(Gui& gui, ImDrawList& list, const Track& track) {
  const float em = gui.em, top = track.low.y;
  for (const view::TimelineEvent& event : gui.model.events()) {
    const float x = track.px(event.place);
    const ImU32 colour = event_colour(gui.colours, event.kind);
    const bool rearranges = event.kind == view::TimelineEvent::Kind::rearrangement;
    const float high =
        rearranges ? std::lerp(track.high.y, top, static_cast<float>(event.size)) : top - 0.15f * em;
    list.AddLine({x, high}, {x, track.high.y}, colour, 0.14f * em);
    note_place(gui, "event " + event.name, {x - 0.2f * em, top}, {x + 0.2f * em, track.high.y});
    if (event.kind == view::TimelineEvent::Kind::command)
      list.AddTriangleFilled({x, top + 0.3f * em}, {x - 0.3f * em, top - 0.2f * em},
                             {x + 0.3f * em, top - 0.2f * em}, colour);
  }
  draw_labels(gui.colours, list, track, gui.model.events(), em);
}

/// Returns the event under the mouse.
const view::TimelineEvent* event_near(const Gui& gui, const Track& track, float x) {
  const view::TimelineEvent* nearest = nullptr;
  float least = 0.4f * gui.em;
  for (const view::TimelineEvent& event : gui.model.events()) {
    const float distance = std::abs(track.px(event.place) - x);
    if (distance > least) continue;
    least = distance;
    nearest = &event;
  }
  return nearest;
}

/// Describes all events that are too close together to be pointed at separately.
void show_values(const Gui& gui, const Track& track, const std::vector<double>& tilts) {
  const float x = ImGui::GetIO().MousePos.x;
  const auto frame = static_cast<std::size_t>(std::lround(track.place(x)));
  ImGui::BeginTooltip();
  if (!event_near(gui, track, x)) {
    const std::size_t k = std::min(frame, tilts.size() - 1);
    rich_text(fmt::format("{}, {}°", frame_counter(k, tilts.size()), degrees_text(tilts[k], 2)));
  }
  for (const view::TimelineEvent& event : gui.model.events())
    if (std::abs(track.px(event.place) - x) <= 0.4f * gui.em)
      rich_text(fmt::format("{}°: {}", degrees_text(event.tilt, 2), event.what));
  ImGui::EndTooltip();
}

void use_line(Gui& gui, const Track& track, const std::vector<double>& tilts) {
  const float x = ImGui::GetIO().MousePos.x;
  if (ImGui::IsItemHovered()) show_values(gui, track, tilts);
  if (!ImGui::IsItemActive()) return;
  const view::TimelineEvent* event = ImGui::IsItemActivated() ? event_near(gui, track, x) : nullptr;
  const bool moved = ImGui::IsItemActivated() || ImGui::GetIO().MouseDelta.x != 0.0f;
  if (!moved) return;
  gui.model.play(false);
  gui.model.go_to(event ? event->frame : static_cast<std::size_t>(std::lround(track.place(x))));
}

/// Draws the button of a live run at the right end of the line; returns its width.
float draw_follow_button(Gui& gui, const ImVec2& corner, float right) {
  if (!gui.model.is_live()) return 0.0f;
  const float em = gui.em, width = 5.4f * em;
  ImGui::SetCursorScreenPos({right - width + 0.4f * em, corner.y + 0.6f * em});
  ImGui::BeginDisabled(!gui.model.shows_recorded_frame());
  if (named_button(gui, "follow", gui.model.shows_recorded_frame() ? "follow" : "live",
                   "show the current state of the run: end"))
    gui.model.follow();
  ImGui::EndDisabled();
  return width;
}

}  // namespace

void draw_time_line(Gui& gui) {
  const float em = gui.em;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float available = ImGui::GetContentRegionAvail().x;
  const float width = available - draw_follow_button(gui, corner, corner.x + available);
  ImGui::SetCursorScreenPos(corner);
  ImGui::InvisibleButton("time line", {std::max(width, 1.0f), 3.2f * em});
  note_place(gui, "time line");
  const std::vector<double> tilts = gui.model.frame_tilts();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (tilts.empty()) {
    list.AddText({corner.x + em, corner.y + em}, packed(gui.colours.soft),
                 "The time line begins with the tilt.");
    return;
  }
  const Track track{{corner.x + 1.2f * em, corner.y + 1.2f * em},
                    {corner.x + width - 1.2f * em, corner.y + 2.0f * em},
                    std::max(1.0, static_cast<double>(tilts.size()) - 1.0)};
  const float now = track.px(static_cast<double>(gui.model.frame_index()));
  list.AddRectFilled(track.low, track.high, packed(gui.colours.track));
  list.AddRectFilled(track.low, {now, track.high.y}, packed(gui.colours.tint));
  list.AddRect(track.low, track.high, packed(gui.colours.line));
  draw_angles(gui, track, tilts, gui.model.goes_by_time());
  draw_events(gui, list, track);
  list.AddLine({now, track.low.y - 0.3f * em}, {now, track.high.y + 0.3f * em}, packed(gui.colours.accent),
               0.2f * em);
  use_line(gui, track, tilts);
}

}  // namespace talus::gui
