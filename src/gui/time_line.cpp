#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/panels.h"
#include "pictures/texts.h"

namespace talus::gui {
namespace {

ImU32 event_colour(const Palette& colours, view::TimelineEvent::Kind kind) {
  switch (kind) {
    case view::TimelineEvent::Kind::failure:
      return packed(colours.failure);
    case view::TimelineEvent::Kind::command:
      return packed(colours.command);
    case view::TimelineEvent::Kind::rearrangement:
      return packed(colours.rearrangement);
    case view::TimelineEvent::Kind::transition:
      break;
  }
  return packed(colours.transition);
}

/// Transformation from frames to pixels.
struct Track {
  ImVec2 low, high;   ///< corners
  double last = 1.0;  ///< place of the right end, in frames
  double left = 0.0;  ///< number of frames of the parent run before the first frame of a branch

  float px(double place) const {
    return low.x + static_cast<float>(std::clamp((place + left) / last, 0.0, 1.0)) * (high.x - low.x);
  }
  double place(float x) const {
    const double share = std::clamp(static_cast<double>((x - low.x) / (high.x - low.x)), 0.0, 1.0);
    return std::max(0.0, share * last - left);
  }
};

/// Draws angles below the track, for frames of the tilt with ascending angles.
void draw_angles(ImDrawList& list, const Track& track, const std::vector<double>& tilts, float em,
                 ImU32 ink) {
  const auto end = std::ranges::is_sorted_until(tilts);
  const std::span<const double> ascending(tilts.begin(), end);
  if (ascending.size() < 2 || !(ascending.front() < ascending.back())) return;
  const int most = std::max(2, static_cast<int>((track.high.x - track.low.x) / (5.0f * em)));
  for (const pictures::RoundTick& tick :
       pictures::round_ticks(degrees(ascending.front()), degrees(ascending.back()), most)) {
    const float x = track.px(view::place_among(ascending, radians(tick.value)));
    list.AddLine({x, track.high.y}, {x, track.high.y + 0.3f * em}, ink);
    const std::string label = tick.label + "°";
    list.AddText({x - 0.5f * ImGui::CalcTextSize(label.c_str()).x, track.high.y + 0.25f * em}, ink,
                 label.c_str());
  }
}

/// Draws the angles at which a tilt programme turns or begins to be held.
void draw_turns(ImDrawList& list, const Track& track, const std::vector<double>& tilts, float em, ImU32 ink) {
  float first_free = 0.0f;
  for (std::size_t k = 0; k < tilts.size(); ++k) {
    const bool end = k == 0 || k + 1 == tilts.size();
    const auto way = [&](std::size_t from) {
      return tilts[from + 1] > tilts[from] ? 1 : tilts[from + 1] < tilts[from] ? -1 : 0;
    };
    if (!end && way(k - 1) == way(k)) continue;
    const float x = track.px(static_cast<double>(k));
    list.AddLine({x, track.high.y}, {x, track.high.y + 0.3f * em}, ink);
    const std::string label = fmt::format("{:.3g}°", degrees(tilts[k]));
    const float low = x - 0.5f * ImGui::CalcTextSize(label.c_str()).x;
    if (low < first_free) continue;
    first_free = low + ImGui::CalcTextSize(label.c_str()).x + 0.4f * em;
    list.AddText({low, track.high.y + 0.25f * em}, ink, label.c_str());
  }
}

/// Draws labels above the track, theta_c with priority, each only if it has room.
void draw_labels(const Palette& colours, ImDrawList& list, const Track& track,
                 std::span<const view::TimelineEvent> events, float em) {
  std::vector<std::pair<float, float>> taken;
  for (const bool failure : {true, false})
    for (const view::TimelineEvent& event : events) {
      if (event.label.empty() || (event.kind == view::TimelineEvent::Kind::failure) != failure) continue;
      const float width = rich_width(*ImGui::GetFont(), ImGui::GetFontSize(), event.label);
      const float low = std::min(track.px(event.place) - 0.5f * width, track.high.x - width);
      const float high = low + width + 0.4f * em;
      if (std::ranges::any_of(
              taken, [=](const auto& interval) { return low < interval.second && interval.first < high; }))
        continue;
      taken.emplace_back(low, high);
      add_rich_text(list, {low, track.low.y - 1.25f * em}, event_colour(colours, event.kind), event.label);
    }
}

/// Draws a stroke for each event. A rearrangement has a stroke at the bottom whose height shows its size,
/// and a command has an arrow.
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

/// Draws the angles of a branch and, next to them, of its parent run, if they ascend together.
void draw_angles_of_branch(ImDrawList& list, Track track, const view::BranchLine& run,
                           const std::vector<double>& tilts, float em, ImU32 ink) {
  std::vector<double> all(run.tilts.begin(), run.tilts.begin() + static_cast<std::ptrdiff_t>(run.frame));
  all.insert(all.end(), tilts.begin(), tilts.end());
  for (std::size_t k = all.size(); k < run.tilts.size() && run.tilts[k] > all.back(); ++k)
    all.push_back(run.tilts[k]);
  track.left = 0.0;
  draw_angles(list, track, all, em, ink);
}

/// Draws the line of the parent run, which a branch leaves at its frame.
void draw_left_run(ImDrawList& list, const Track& track, const view::BranchLine& run, const Gui& gui) {
  const float em = gui.em;
  const ImU32 colour = packed(gui.colours.curves[2]);
  const auto frames = static_cast<double>(run.tilts.size()) - 1.0;
  const float y = track.low.y - 0.35f * em, leaves = track.px(0.0);
  list.AddLine({track.low.x, y}, {track.px(frames - track.left), y}, packed(gui.colours.track), 0.2f * em);
  list.AddLine({std::max(track.low.x, leaves - 0.8f * em), y}, {leaves, track.high.y}, colour, 0.2f * em);
  list.AddCircleFilled({std::max(track.low.x, leaves - 0.8f * em), y}, 0.25f * em, colour);
}

/// Returns the frame of the parent run under the mouse, if the mouse is on its line.
std::optional<std::size_t> parent_frame_near(const Track& track, const view::BranchLine& run) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double frame =
      (static_cast<double>(mouse.x) - track.low.x) / (track.high.x - track.low.x) * track.last;
  const bool on_line = mouse.y < track.low.y || mouse.x < track.px(0.0) - 0.5f * ImGui::GetFontSize();
  if (!on_line || frame < -0.5 || frame > static_cast<double>(run.tilts.size()) - 0.5) return std::nullopt;
  return static_cast<std::size_t>(std::lround(std::max(0.0, frame)));
}

/// Handles a click on that line, which returns to the parent run.
bool use_left_run(Gui& gui, const Track& track, const view::BranchLine& run) {
  const std::optional<std::size_t> frame = parent_frame_near(track, run);
  if (!frame || !ImGui::IsItemHovered()) return false;
  ImGui::SetTooltip("%s, %s°: a click returns to it", run.run.c_str(),
                    degrees_text(run.tilts[*frame], 2).c_str());
  if (ImGui::IsItemActivated()) {
    gui.requests.open_path = run.run;
    gui.requests.open_frame = frame;
  }
  return true;
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
  const std::optional<view::BranchLine> left = gui.model.branch_line();
  Track track{{corner.x + 1.2f * em, corner.y + 1.2f * em},
              {corner.x + width - 1.2f * em, corner.y + 2.0f * em},
              std::max(1.0, static_cast<double>(tilts.size()) - 1.0)};
  if (left) {
    track.left = static_cast<double>(left->frame);
    track.last = std::max({1.0, static_cast<double>(left->tilts.size()) - 1.0,
                           track.left + static_cast<double>(tilts.size()) - 1.0});
  }
  const float begin = track.px(0.0), end = track.px(static_cast<double>(tilts.size()) - 1.0);
  list.AddRectFilled({begin, track.low.y}, {end, track.high.y}, packed(gui.colours.track));
  const float now = track.px(static_cast<double>(gui.model.frame_index()));
  list.AddRectFilled({begin, track.low.y}, {now, track.high.y}, packed(gui.colours.tint));
  list.AddRect({begin, track.low.y}, {end, track.high.y}, packed(gui.colours.line));
  if (left) draw_left_run(list, track, *left, gui);
  if (gui.model.goes_by_time())
    draw_turns(list, track, tilts, em, packed(gui.colours.ink));
  else if (left)
    draw_angles_of_branch(list, track, *left, tilts, em, packed(gui.colours.ink));
  else
    draw_angles(list, track, tilts, em, packed(gui.colours.ink));
  draw_events(gui, list, track);
  list.AddLine({now, track.low.y - 0.3f * em}, {now, track.high.y + 0.3f * em}, packed(gui.colours.accent),
               0.2f * em);
  if (left && use_left_run(gui, track, *left)) return;
  use_line(gui, track, tilts);
}

}  // namespace talus::gui
