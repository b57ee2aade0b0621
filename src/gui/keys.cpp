#include <algorithm>

#include "core/trigonometry.h"
#include "gui/beside_actions.h"
#include "gui/branching.h"
#include "gui/panels.h"
#include "gui/run_actions.h"

namespace talus {
namespace {

struct KeyLine {
  const char* keys;
  const char* what;
};

constexpr KeyLine key_lines[] = {
    {"space", "play, pause"},
    {"right, left", "one step or frame forward; one frame back (shift 10, ctrl 100)"},
    {"home, end", "first, last frame; of a run that goes on, as it is now"},
    {"d, j, p, c", "to θ_d; to the jump of ℓ_c; to where a cluster first spans; to θ_c"},
    {"< >", "speed of a replay"},
    {"1 ... 9", "the maps, in the order of their list"},
    {"0", "no overlay"},
    {"o", "next overlay"},
    {"m", "next colours"},
    {"v", "motion and strain since the angle shown, or per degree"},
    {"[ ]", "threshold of overloaded grains"},
    {", .", "length of coarse graining"},
    {"; '", "neighbourhood of the selected grain"},
    {"t", "turn the bed to its slope"},
    {"+ -, wheel", "zoom"},
    {"w a x z, drag", "move the picture"},
    {"f", "whole bed"},
    {"n", "select the next grain; escape: none"},
    {"T, L", "trails of the selected grains; follow the selected grain"},
    {"i, y", "outline its cluster; draw its neighbourhoods"},
    {"B", "bookmark of the frame shown, with a note"},
    {"P, D", "a second view; in it, what changes from the frame shown on"},
    {"g, b", "run to the angle; deposit the bed"},
    {"r", "reset, with the seed given"},
    {"s", "save the state of a run that is computed"},
    {"e", "write the picture to the file named under files"},
    {"u, k", "push the selected grain; drop grains there"},
    {"N, U", "branch: go on from the frame shown; back before the last command"},
    {"R M A S F G", "unfold run, map, act, select, files, grain; tab: from field to field"},
    {"h", "show or hide the columns"},
    {"l", "show or hide the plots"},
    {"C", "next theme: light, dark, print"},
    {"?", "this list"},
    {"q", "quit"},
};

constexpr double fastest_replay = 20.0;  // deg/s

int factor_of_modifiers() {
  const ImGuiIO& io = ImGui::GetIO();
  return io.KeyCtrl ? 100 : io.KeyShift ? 10 : 1;
}

bool pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

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

void ask_for_panel(Gui& gui, ImWchar key) {
  gui.model.state.show_controls = true;
  gui.panel_asked = group_of_key(key);
}

void change_view(Gui& gui, ImWchar key) {
  ViewState& state = gui.model.state;
  const double step = 3.0 * gui.model.mean_diameter();
  switch (key) {
    case '[':
      state.map.threshold_factor = std::max(0.1, state.map.threshold_factor - 0.1);
      break;
    case ']':
      state.map.threshold_factor = std::min(4.0, state.map.threshold_factor + 0.1);
      break;
    case ',':
      state.map.length = std::max(1.0, state.map.length - 1.0);
      break;
    case '.':
      state.map.length = std::min(40.0, state.map.length + 1.0);
      break;
    case ';':
      state.neighbourhood = std::max(1.0, state.neighbourhood - 1.0);
      break;
    case '\'':
      state.neighbourhood = std::min(40.0, state.neighbourhood + 1.0);
      break;
    case '+':
    case '=':
      zoom_about(gui, 1.25, state.camera.centre_x, state.camera.centre_y);
      break;
    case '-':
      zoom_about(gui, 0.8, state.camera.centre_x, state.camera.centre_y);
      break;
    case 'w':
      state.camera.centre_y += step;
      break;
    case 'z':
      state.camera.centre_y -= step;
      break;
    case 'a':
      state.camera.centre_x -= step;
      break;
    case 'x':
      state.camera.centre_x += step;
      break;
    case 'f':
      show_whole_bed(gui);
      break;
    case 't':
      state.map.turned = !state.map.turned;
      break;
    case 'o':
      next_overlay(state.map.layers);
      break;
    case '0':
      state.map.layers.resize(1);
      break;
    case 'm':
      next_colours(state.map.colours);
      break;
    case 'v':
      state.since = state.since ? std::nullopt : std::optional(gui.model.frame().tilt);
      break;
    case 'i':
      state.highlight_cluster = !state.highlight_cluster;
      break;
    case 'y':
      state.show_neighbourhoods = !state.show_neighbourhoods;
      break;
    case 'C':
      state.theme = next_theme(state.theme);
      break;
    case 'h':
      state.show_controls = state.show_inspector = !state.show_controls;
      break;
    case 'l':
      state.show_plots = !state.show_plots;
      break;
    case '?':
      state.show_help = !state.show_help;
      break;
    case 'n':
      gui.model.select(state.selected ? (*state.selected + 1) % gui.model.statics().free_count : 0);
      break;
    default:
      if (key >= '1' && key <= '9') choose_map(state.map.layers, static_cast<std::size_t>(key - '1'));
  }
}

void act(Gui& gui, ImWchar key) {
  ViewModel& model = gui.model;
  switch (key) {
    case ' ':
      toggle_playing(gui);
      break;
    case 'd':
      model.go_to(Landmark::theta_d);
      break;
    case 'p':
      model.go_to(Landmark::percolation);
      break;
    case 'c':
      model.go_to(Landmark::theta_c);
      break;
    case 'j':
      model.go_to(Landmark::length_jump);
      break;
    case '<':
      model.set_speed(0.8 * model.speed());
      break;
    case '>':
      model.set_speed(std::min(1.25 * model.speed(), fastest_replay));
      break;
    case 'b':
      if (model.is_live()) model.live()->finish_deposition();
      break;
    case 'B':
      model.state.bookmark_asked = true;
      break;
    case 'P':
      toggle_beside(gui);
      break;
    case 'D':
      show_change_since_here(gui);
      break;
    case 'N':
      branch_here(gui);
      break;
    case 'U':
      go_back(gui);
      break;
    case 'R':
    case 'M':
    case 'A':
    case 'S':
    case 'F':
    case 'G':
      ask_for_panel(gui, key);
      break;
    case 'T':
      model.state.selecting.trails = !model.state.selecting.trails;
      break;
    case 'L':
      toggle_following(gui);
      break;
    case 'u':
      push_selected(gui);
      break;
    case 'k':
      drop_here(gui);
      break;
    case 'e':
      gui.requests.save_png_path = model.state.picture_path;
      break;
    case 'q':
      gui.requests.quit = model.may_discard();
      break;
    case 'g':
      if (model.is_live()) model.live()->run_to(radians(model.state.run_to_tilt));
      break;
    case 'r':
      reset(gui);
      break;
    case 's':
      save_state(gui);
      break;
    default:
      change_view(gui, key);
  }
}

}  // namespace

void handle_keys(Gui& gui) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  for (const ImWchar key : io.InputQueueCharacters) act(gui, key);
  if (pressed(ImGuiKey_RightArrow)) advance(gui, factor_of_modifiers());
  if (pressed(ImGuiKey_LeftArrow)) advance(gui, -factor_of_modifiers());
  if (pressed(ImGuiKey_Home)) gui.model.go_to(Landmark::first);
  if (pressed(ImGuiKey_End)) gui.model.go_to(Landmark::last);
  const bool list_open = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);  // it closes itself
  if (pressed(ImGuiKey_Escape) && !list_open) {
    if (gui.model.state.show_help)
      gui.model.state.show_help = false;
    else
      gui.model.select(std::optional<Index>());
  }
}

void draw_help(Gui& gui) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {0.95f * size.x, 0.95f * size.y});
  ImGui::Begin("Keys", &gui.model.state.show_help,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize);
  for (const KeyLine& line : key_lines) {
    ImGui::TextUnformatted(line.keys);
    ImGui::SameLine(9.0f * gui.em);
    rich_text(line.what);
  }
  ImGui::TextUnformatted("On the map: click a grain, drag to move, wheel to zoom.");
  ImGui::TextUnformatted(
      "With shift: click one more grain, drag a box. With ctrl: click a contact, drag a lasso.");
  ImGui::TextUnformatted(
      "With ctrl, from a grain of a run that is computed: pull it. With ctrl and shift: always a lasso.");
  note_place(gui, "help", ImGui::GetWindowPos(),
             {ImGui::GetWindowPos().x + ImGui::GetWindowWidth(),
              ImGui::GetWindowPos().y + ImGui::GetWindowHeight()});
  ImGui::End();
}

}  // namespace talus
