#include <algorithm>
#include <fmt/core.h>

#include "base/text.h"
#include "core/trigonometry.h"
#include "gui/panels.h"
#include "pictures/map_kind.h"
#include "render/colour.h"

namespace talus::gui {
namespace {

/// Line of the list of keys, with the action of its keys.
struct Key {
  const char* name;  ///< text in the list
  const char* what;
  ImWchar codes[9];  ///< characters, or values of KeyCode from 256 on; terminated by 0
  void (*act)(Gui& gui, ImWchar code);
};

/// Shows or hides an element, and reports which.
void toggle(Gui& gui, bool& shown, const std::string& on, const std::string& off) {
  shown = !shown;
  show_message(gui, shown ? on : off);
}

/// Returns the text for an element drawn only at a selected grain, which says so if none is selected.
std::string selected_only_text(const Gui& gui, const std::string& what) {
  return what + (gui.state.selected ? "." : ", once a grain is selected.");
}

/// Changes a number of the map by a step within its limits, and reports the new value.
void change_number(Gui& gui, double& value, double step, double low, double high, const char* what,
                   const char* unit) {
  value = std::clamp(value + step, low, high);
  const char* limit = value == low ? ", the minimum" : value == high ? ", the maximum" : "";
  show_message(gui, fmt::format("{}: {:.3g} {}{}.", what, value, unit, limit));
}

void show_map_message(Gui& gui) {
  const pictures::MapLayers& layers = gui.state.map.layers;
  show_message(gui, fmt::format("Map: {}{}.", pictures::name_of(gui.state.map),
                                layers.size() > 1 ? "" : ", no overlay"));
}

void choose_map(Gui& gui, ImWchar digit) {
  pictures::MapLayers& layers = gui.state.map.layers;
  if (const auto k = static_cast<std::size_t>(digit - '1'); k < pictures::map_kinds().size()) {
    layers[0] = pictures::map_kinds()[k];
    gui.state.map.own.reset();
    if (layers.size() > 1 && layers[1] == layers[0]) layers.pop_back();
  }
  show_map_message(gui);
}

void choose_overlay(Gui& gui, ImWchar key) {
  pictures::MapLayers& layers = gui.state.map.layers;
  const auto kinds = pictures::map_kinds();
  const std::size_t count = kinds.size();
  std::size_t next = layers.size() > 1
                         ? static_cast<std::size_t>(std::ranges::find(kinds, layers[1]) - kinds.begin()) + 1
                         : 0;
  if (next < count && kinds[next] == layers[0]) ++next;
  layers.resize(1);
  if (key == 'o' && next < count) layers.push_back(kinds[next]);
  show_map_message(gui);
}

/// Cycles through the bar's own colours and all colour maps; for clusters, through the palettes.
void next_colours(Gui& gui, ImWchar) {
  pictures::MapSettings& map = gui.state.map;
  if (pictures::has_palette(map) && !pictures::has_bar(map.layers)) {
    const std::size_t count = pictures::cluster_palettes.size();
    map.palette = pictures::cluster_palettes.at((static_cast<std::size_t>(map.palette) + 1) % count);
    return show_message(gui, fmt::format("Colours of clusters: {}.", pictures::palette_name(map.palette)));
  }
  std::optional<render::ColourMap>& colours = map.colours;
  const auto all = render::colour_maps();
  const std::size_t next =
      colours ? static_cast<std::size_t>(std::ranges::find(all, render::one_way(*colours)) - all.begin()) + 1
              : 0;
  colours = next < all.size() ? std::optional(all[next]) : std::nullopt;
  show_message(gui, fmt::format("Colours of the bar: {}.", colours ? render::colour_map_name(*colours)
                                                                   : std::string_view("those of the map")));
}

void change_reference(Gui& gui, ImWchar) {
  std::optional<double>& since = gui.state.since;
  since = since ? std::nullopt : std::optional(gui.model.frame().tilt);
  show_message(gui, since ? fmt::format("Maps of motion and strain show the change since {}°.",
                                        degrees_text(*since, 2))
                          : std::string("Maps of motion and strain show the change per degree of tilt."));
}

void move_by_key(Gui& gui, ImWchar key) {
  const double step = 3.0 * gui.model.mean_diameter();
  const int x = (key == 'x' ? 1 : 0) - (key == 'a' ? 1 : 0), y = (key == 'w' ? 1 : 0) - (key == 'z' ? 1 : 0);
  move_picture(gui, step * x, step * y);
}

void zoom_by_key(Gui& gui, ImWchar key) {
  const view::ViewCamera& camera = gui.state.camera;
  zoom_about(gui, key == '-' ? 0.8 : 1.25, camera.centre_x, camera.centre_y);
}

void advance_by_key(Gui& gui, ImWchar key) {
  const ImGuiIO& io = ImGui::GetIO();
  const int count = io.KeyCtrl ? 100 : io.KeyShift ? 10 : 1;
  advance(gui, key == key_right ? count : -count);
}

void go_by_key(Gui& gui, ImWchar key) {
  go_to_landmark(gui, key == 'd'   ? view::Landmark::theta_d
                      : key == 'j' ? view::Landmark::length_jump
                      : key == 'p' ? view::Landmark::percolation
                                   : view::Landmark::theta_c);
}

/// Selects the next grain. Escape closes the list of keys or, if it is closed, clears the selection.
void select_by_key(Gui& gui, ImWchar key) {
  const bool selected = gui.state.selected || !gui.state.selecting.selection.grains.empty() ||
                        gui.state.selecting.selection.contact;
  if (key == 'n')
    gui.model.select(gui.state.selected ? (*gui.state.selected + 1) % gui.model.statics().free_count : 0);
  else if (ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup))
    return;  // the list closes itself
  else if (gui.state.show_help)
    gui.state.show_help = false;
  else if (selected)
    gui.model.select(std::optional<Index>());
  else
    show_message(gui, "Nothing is selected.");
}

/// Multiplies the speed of a replay by a factor; in a live run, selects the next pace.
void change_speed(Gui& gui, double factor) {
  constexpr double fastest_replay = 20.0;  // deg/s
  if (gui.model.is_live()) {
    const int last = static_cast<int>(std::size(view::live_paces)) - 1;
    gui.state.pace = std::clamp(gui.state.pace + (factor < 1.0 ? -1 : 1), 0, last);
    return show_message(gui, fmt::format("Pace of the run: {}.", view::live_paces[gui.state.pace].name));
  }
  view::Replay& replay = *gui.model.replay();
  replay.set_speed(std::min(factor * replay.speed(), fastest_replay));
  show_message(gui, fmt::format("Speed of the replay: {:.3g} deg/s{}.", replay.speed(),
                                replay.speed() >= fastest_replay ? ", the maximum" : ""));
}

/// Shows or hides the second view; chooses another map for it if it would equal the first view.
void toggle_second_view(Gui& gui) {
  view::SecondViewState& second_view = gui.state.second_view;
  second_view.shown = !second_view.shown;
  const bool alike =
      !second_view.minus && (second_view.layers.empty() || second_view.layers == gui.state.map.layers);
  if (second_view.shown && alike)
    second_view.layers = {gui.state.map.layers.at(0) == pictures::MapKind::displacement
                              ? pictures::MapKind::gamma
                              : pictures::MapKind::displacement};
}

/// Shows in the second view what changes from the frame shown on.
void show_change_since_here(Gui& gui) {
  view::SecondViewState& second_view = gui.state.second_view;
  second_view.shown = true;
  second_view.minus = gui.model.frame().tilt;
  gui.state.message =
      fmt::format("The second view shows the change since {}°.", degrees_text(*second_view.minus, 2));
}

// Actions of rows with one key, or with one for each of two actions.
template <void (*action)(Gui&)>
void just(Gui& gui, ImWchar) {
  action(gui);
}
template <ImWchar key, void (*action)(Gui&), void (*other)(Gui&)>
void either(Gui& gui, ImWchar pressed) {
  pressed == key ? action(gui) : other(gui);
}

/// All keys in the order of the list. A test compares docs/view.md with it.
constexpr Key all_keys[] = {
    {"space", "play, pause", {' '}, just<toggle_playing>},
    {"right, left",
     "one step or frame forward; one frame back (shift 10, ctrl 100)",
     {key_right, key_left},
     advance_by_key},
    {"home, end",
     "first, last frame; in a live run, its current state",
     {key_home, key_end},
     [](Gui& gui, ImWchar key) {
       go_to_landmark(gui, key == key_home ? view::Landmark::first : view::Landmark::last);
     }},
    {"d, j, p, c",
     "to θ_d; to the jump of ℓ_c; to the first spanning cluster; to θ_c",
     {'d', 'j', 'p', 'c'},
     go_by_key},
    {"< >",
     "speed of a replay, pace of a run",
     {'<', '>'},
     [](Gui& gui, ImWchar key) { change_speed(gui, key == '<' ? 0.8 : 1.25); }},
    {"1 ... 9",
     "the maps, in the order of their list",
     {'1', '2', '3', '4', '5', '6', '7', '8', '9'},
     choose_map},
    {"0, o", "no overlay; the next overlay", {'0', 'o'}, choose_overlay},
    {"m", "next colours", {'m'}, next_colours},
    {"v", "motion and strain since the angle shown, or per degree", {'v'}, change_reference},
    {"[ ]",
     "threshold of overloaded grains",
     {'[', ']'},
     [](Gui& gui, ImWchar key) {
       change_number(gui, gui.state.map.threshold_factor, key == '[' ? -0.1 : 0.1, 0.1, 4.0,
                     "Threshold of overloaded grains", "Γc");
     }},
    {", .",
     "length of coarse graining",
     {',', '.'},
     [](Gui& gui, ImWchar key) {
       change_number(gui, gui.state.map.length, key == ',' ? -1.0 : 1.0, 1.0, 40.0,
                     "Length of coarse graining, for the maps coarse, density, stress", "D");
     }},
    {"; '",
     "neighbourhood of the selected grain",
     {';', '\''},
     [](Gui& gui, ImWchar key) {
       change_number(gui, gui.state.neighbourhood, key == ';' ? -1.0 : 1.0, 1.0, 40.0,
                     "Neighbourhood of the selected grain", "D");
     }},
    {"t",
     "turn the bed to its slope",
     {'t'},
     [](Gui& gui, ImWchar) {
       toggle(gui, gui.state.map.turned, "The bed is turned to its slope.",
              "The bed lies along the picture.");
     }},
    {"+ -, wheel", "zoom", {'+', '=', '-'}, zoom_by_key},
    {"w a x z, drag", "move the picture", {'w', 'a', 'x', 'z'}, move_by_key},
    {"f", "whole bed", {'f'}, just<show_whole_bed>},
    {"n", "select the next grain; escape: none", {'n', key_escape}, select_by_key},
    {"L", "follow the selected grain", {'L'}, just<toggle_following>},
    {"i, y",
     "outline its cluster; draw its neighbourhoods",
     {'i', 'y'},
     [](Gui& gui, ImWchar key) {
       if (key == 'i')
         toggle(gui, gui.state.highlight_cluster,
                selected_only_text(gui, "The cluster of an overloaded grain is outlined"),
                "No cluster is outlined.");
       else
         toggle(gui, gui.state.show_neighbourhoods,
                selected_only_text(gui, "The neighbourhoods of the grain are drawn"),
                "No neighbourhoods are drawn.");
     }},
    {"P, D",
     "second view; in it, the change from the frame shown",
     {'P', 'D'},
     either<'P', toggle_second_view, show_change_since_here>},
    {"g, b", "run to the angle; deposit the bed", {'g', 'b'}, either<'g', run_to_tilt, deposit>},
    {"r", "reset, with the given seed", {'r'}, just<reset>},
    {"s", "save the state of a live run", {'s'}, just<save_state>},
    {"e",
     "write the picture to the file named under files",
     {'e'},
     [](Gui& gui, ImWchar) { gui.requests.save_png_path = gui.state.picture_path; }},
    {"u, k", "push the selected grain; drop grains there", {'u', 'k'}, either<'u', push_selected, drop_here>},
    {"N, U",
     "branch: continue from the frame shown; undo the last command",
     {'N', 'U'},
     either<'N', branch_here, go_back>},
    {"R M A F G",
     "unfold run, map, act, files, grain; tab: from field to field",
     {'R', 'M', 'A', 'F', 'G'},
     [](Gui& gui, ImWchar key) {
       gui.state.show_controls = true;
       gui.panel_asked = group_of_key(key);
       show_message(gui, fmt::format("Unfolded: {}.", gui.panel_asked));
     }},
    {"h, l",
     "show or hide the column; the plots",
     {'h', 'l'},
     [](Gui& gui, ImWchar key) {
       if (key == 'h')
         toggle(gui, gui.state.show_controls, "The column is shown.", "The column is hidden: h shows it.");
       else
         toggle(gui, gui.state.show_plots, "The plots are shown if there is room.",
                "The plots are hidden: l shows them.");
     }},
    {"C",
     "next theme: light, dark, print",
     {'C'},
     [](Gui& gui, ImWchar) {
       const auto theme = static_cast<std::size_t>(gui.state.theme);
       gui.state.theme = static_cast<view::Theme>((theme + 1) % view::theme_names.size());
     }},
    {"?", "this list", {'?'}, [](Gui& gui, ImWchar) { gui.state.show_help = !gui.state.show_help; }},
    {"q", "quit", {'q'}, [](Gui& gui, ImWchar) { gui.requests.quit = gui.model.may_discard(); }},
};

void act(Gui& gui, ImWchar code) {
  for (const Key& key : all_keys)
    if (code != 0 && std::ranges::find(key.codes, code) != std::end(key.codes)) return key.act(gui, code);
  if (code > ' ')
    show_message(gui, code < 127
                          ? fmt::format("{} does nothing here; ? lists the keys.", static_cast<char>(code))
                          : "That key does nothing here; ? lists the keys.");
}

}  // namespace

void handle_keys(Gui& gui) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  for (const ImWchar character : io.InputQueueCharacters) act(gui, std::min<ImWchar>(character, 127));
  for (const int key : {key_right, key_left, key_home, key_end, key_escape})
    if (key_pressed(static_cast<KeyCode>(key))) act(gui, static_cast<ImWchar>(key));
}

void draw_help(Gui& gui) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {0.95f * size.x, 0.95f * size.y});
  ImGui::Begin("Keys", &gui.state.show_help, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize);
  for (const Key& key : all_keys) {
    ImGui::TextUnformatted(key.name);
    ImGui::SameLine(9.0f * gui.em);
    rich_text(key.what);
  }
  ImGui::TextUnformatted("On the map: click a grain, drag to move, wheel to zoom.");
  ImGui::TextUnformatted(
      "With shift: click to add a grain, drag a box. With ctrl: click a contact, drag a lasso.");
  ImGui::TextUnformatted(
      "With ctrl, from a grain of a live run: pull it. With ctrl and shift: always a lasso.");
  note_place(gui, "help", ImGui::GetWindowPos(),
             {ImGui::GetWindowPos().x + ImGui::GetWindowWidth(),
              ImGui::GetWindowPos().y + ImGui::GetWindowHeight()});
  ImGui::End();
}

}  // namespace talus::gui
