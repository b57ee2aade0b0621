#include "gui/view_actions.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/trigonometry.h"
#include "pictures/map_kind.h"
#include "render/colour_map.h"

namespace talus {
namespace {

constexpr double fastest_replay = 20.0;  // deg/s

void say(Gui& gui, std::string text) { gui.model.state.message = std::move(text); }

/// "The first frame", as a sentence begins.
const char* name_of(Landmark landmark) {
  switch (landmark) {
    case Landmark::first:
      return "The first frame";
    case Landmark::last:
      return "The last frame";
    case Landmark::theta_d:
      return "The frame at which the volume begins to grow";
    case Landmark::length_jump:
      return "The frame at which the largest coarse-graining length jumps";
    case Landmark::percolation:
      return "The frame in which a cluster first spans from floor to surface";
    case Landmark::theta_c:
      return "The last frame before failure";
  }
  return "";
}

/// Why a run has no such place.
std::string absence_of(const ViewModel& model, Landmark landmark, bool goes_on) {
  if (model.frame_count() == 0) return "No frame is recorded yet: the time line begins with the tilt.";
  const std::string name = name_of(landmark);
  if (landmark == Landmark::theta_c)
    return goes_on ? name + " is not known yet: the slope stands." : "There is no failure: the slope stands.";
  return name + (goes_on ? " is not known yet." : " does not exist, or has not been found yet.");
}

void next_overlay(MapLayers& layers) {
  const auto kinds = map_kinds();
  const std::size_t count = kinds.size();
  std::size_t next = layers.size() > 1
                         ? static_cast<std::size_t>(std::ranges::find(kinds, layers[1]) - kinds.begin()) + 1
                         : 0;
  if (next < count && kinds[next] == layers[0]) ++next;
  layers.resize(1);
  if (next < count) layers.push_back(kinds[next]);
}

/// Its own, then each colour map.
void next_colours(std::optional<ColourMap>& colours) {
  const auto all = colour_maps();
  const std::size_t next =
      colours ? static_cast<std::size_t>(std::ranges::find(all, *colours) - all.begin()) + 1 : 0;
  colours = next < all.size() ? std::optional(all[next]) : std::nullopt;
}

void choose_map(MapLayers& layers, std::size_t k) {
  if (k >= map_kinds().size()) return;
  layers[0] = map_kinds()[k];
  if (layers.size() > 1 && layers[1] == layers[0]) layers.pop_back();
}

/// Changes a number of the map by a step within its limits, and says what it is now.
void change_number(Gui& gui, double& value, double step, double low, double high, const char* what,
                   const char* unit) {
  value = std::clamp(value + step, low, high);
  const char* limit = value == low ? ", the minimum" : value == high ? ", the maximum" : "";
  say(gui, fmt::format("{}: {:.3g} {}{}.", what, value, unit, limit));
}

/// Of a selected grain only: what is drawn once there is one.
std::string of_selected(const ViewModel& model, const std::string& what) {
  return what + (model.state.selected ? "." : ", once a grain is selected.");
}

/// What a key changes of the numbers of a map.
bool change_numbers(Gui& gui, ImWchar key) {
  ViewState& state = gui.model.state;
  switch (key) {
    case '[':
    case ']':
      change_number(gui, state.map.threshold_factor, key == '[' ? -0.1 : 0.1, 0.1, 4.0,
                    "Threshold of overloaded grains", "Γc");
      return true;
    case ',':
    case '.':
      change_number(gui, state.map.length, key == ',' ? -1.0 : 1.0, 1.0, 40.0,
                    "Length of coarse graining, for the maps coarse, density, stress", "D");
      return true;
    case ';':
    case '\'':
      change_number(gui, state.neighbourhood, key == ';' ? -1.0 : 1.0, 1.0, 40.0,
                    "Neighbourhood of the selected grain", "D");
      return true;
    default:
      return false;
  }
}

/// What a key changes of where the picture is.
bool change_place(Gui& gui, ImWchar key) {
  const ViewCamera& camera = gui.model.state.camera;
  const double step = 3.0 * gui.model.mean_diameter();
  switch (key) {
    case '+':
    case '=':
      zoom_about(gui, 1.25, camera.centre_x, camera.centre_y);
      return true;
    case '-':
      zoom_about(gui, 0.8, camera.centre_x, camera.centre_y);
      return true;
    case 'w':
      move_picture(gui, 0.0, step);
      return true;
    case 'z':
      move_picture(gui, 0.0, -step);
      return true;
    case 'a':
      move_picture(gui, -step, 0.0);
      return true;
    case 'x':
      move_picture(gui, step, 0.0);
      return true;
    case 'f':
      show_whole_bed(gui);
      return true;
    default:
      return false;
  }
}

/// What a key changes of which map is drawn.
bool change_map(Gui& gui, ImWchar key) {
  MapSettings& map = gui.model.state.map;
  if (key == 'm') {
    next_colours(map.colours);
    say(gui, fmt::format("Colours of the bar: {}.",
                         map.colours ? colour_map_name(*map.colours) : std::string_view("those of the map")));
    return true;
  }
  if (key == 'o')
    next_overlay(map.layers);
  else if (key == '0')
    map.layers.resize(1);
  else if (key >= '1' && key <= '9')
    choose_map(map.layers, static_cast<std::size_t>(key - '1'));
  else
    return false;
  say(gui, fmt::format("Map: {}{}.", layers_name(map.layers), map.layers.size() > 1 ? "" : ", no overlay"));
  return true;
}

}  // namespace

void refuse_in_replay(Gui& gui, const char* what) {
  say(gui, fmt::format("{}: this is a replay; N goes on from the frame shown, as a run of its own.", what));
}

void go_to_landmark(Gui& gui, Landmark landmark) {
  ViewModel& model = gui.model;
  const bool live = model.is_live(), goes_on = live && !model.live()->status().done;
  if (live && landmark == Landmark::last) {
    if (!model.looks_back()) say(gui, "The run is shown as it is now.");
    return model.follow();
  }
  if (!model.has(landmark)) return say(gui, absence_of(model, landmark, goes_on));
  model.go_to(landmark);
  say(gui, fmt::format("{}, at {:.2f}°.", name_of(landmark), degrees(model.frame().tilt)));
}

void zoom_about(Gui& gui, double factor, double x, double y) {
  if (gui.model.zoom(factor, x, y)) return;
  say(gui, factor < 1.0 ? "The whole bed is visible; there is nothing to zoom out to."
                        : "This is the largest zoom.");
}

void move_picture(Gui& gui, double dx, double dy) {
  ViewModel& model = gui.model;
  const ViewCamera& camera = model.state.camera;
  model.state.selecting.follow = false;
  if (model.look({camera.centre_x + dx, camera.centre_y + dy, camera.zoom})) return;
  say(gui, "The bed ends there; zoom in (+ or the wheel) to move the picture.");
}

void show_whole_bed(Gui& gui) {
  ViewState& state = gui.model.state;
  if (state.camera.zoom == 1.0) say(gui, "The whole bed is shown.");
  state.selecting.follow = false;
  state.camera.zoom = 1.0;
}

void toggle_following(Gui& gui) {
  ViewState& state = gui.model.state;
  state.selecting.follow = !state.selecting.follow;
  if (!state.selecting.follow) return say(gui, "The picture stays where it is.");
  if (!state.selected) {
    state.selecting.follow = false;
    return say(gui, "Click the grain to follow first.");
  }
  constexpr double surroundings = 40.0;  // D
  state.camera.zoom =
      std::max(state.camera.zoom, gui.model.statics().length / (surroundings * gui.model.mean_diameter()));
  say(gui, fmt::format("The picture follows grain {}.", *state.selected));
}

void toggle_trails(Gui& gui) {
  SelectingState& selecting = gui.model.state.selecting;
  selecting.trails = !selecting.trails;
  const std::size_t count = gui.model.selected_grains().size();
  if (!selecting.trails)
    say(gui, "No trails are drawn.");
  else if (count == 0)
    say(gui, "Trails are drawn of selected grains, once there are some.");
  else
    say(gui, fmt::format("Trails of {} selected grain{}, from the first frame to the one shown.", count,
                         count == 1 ? "" : "s"));
}

void change_speed(Gui& gui, double factor) {
  ViewModel& model = gui.model;
  if (model.is_live())
    return say(gui, "A run that is computed goes as fast as it can; < and > are for a replay.");
  model.set_speed(std::min(factor * model.speed(), fastest_replay));
  say(gui, fmt::format("Speed of the replay: {:.3g} deg/s{}.", model.speed(),
                       model.speed() >= fastest_replay ? ", the maximum" : ""));
}

bool change_view(Gui& gui, ImWchar key) {
  ViewState& state = gui.model.state;
  switch (key) {
    case 't':
      state.map.turned = !state.map.turned;
      say(gui, state.map.turned ? "The bed is turned to its slope." : "The bed lies along the picture.");
      return true;
    case 'v':
      state.since = state.since ? std::nullopt : std::optional(gui.model.frame().tilt);
      say(gui, state.since ? fmt::format("Maps of motion and strain show what has moved since {:.2f}°.",
                                         degrees(*state.since))
                           : std::string("Maps of motion and strain show what moves in a degree of tilt."));
      return true;
    case 'i':
      state.highlight_cluster = !state.highlight_cluster;
      say(gui, state.highlight_cluster
                   ? of_selected(gui.model, "The cluster of an overloaded grain is outlined")
                   : "No cluster is outlined.");
      return true;
    case 'y':
      state.show_neighbourhoods = !state.show_neighbourhoods;
      say(gui, state.show_neighbourhoods ? of_selected(gui.model, "The neighbourhoods of the grain are drawn")
                                         : "No neighbourhoods are drawn.");
      return true;
    case 'C':
      state.theme = next_theme(state.theme);
      return true;
    case 'h':
      state.show_controls = state.show_inspector = !state.show_controls;
      say(gui, state.show_controls ? "The columns are shown, where there is room."
                                   : "The columns are hidden: h shows them.");
      return true;
    case 'l':
      state.show_plots = !state.show_plots;
      say(gui, state.show_plots ? "The plots are shown, where there is room."
                                : "The plots are hidden: l shows them.");
      return true;
    case '?':
      state.show_help = !state.show_help;
      return true;
    case 'n':
      gui.model.select(state.selected ? (*state.selected + 1) % gui.model.statics().free_count : 0);
      return true;
    default:
      return change_numbers(gui, key) || change_place(gui, key) || change_map(gui, key);
  }
}

}  // namespace talus
