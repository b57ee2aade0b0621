#include <fmt/core.h>

#include "gui/beside_actions.h"
#include "gui/branching.h"
#include "gui/panels.h"
#include "gui/run_actions.h"
#include "gui/view_actions.h"

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

int factor_of_modifiers() {
  const ImGuiIO& io = ImGui::GetIO();
  return io.KeyCtrl ? 100 : io.KeyShift ? 10 : 1;
}

bool pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

void ask_for_panel(Gui& gui, ImWchar key) {
  gui.model.state.show_controls = true;
  gui.panel_asked = group_of_key(key);
}

void act(Gui& gui, ImWchar key) {
  ViewModel& model = gui.model;
  switch (key) {
    case ' ':
      toggle_playing(gui);
      break;
    case 'd':
      go_to_landmark(gui, Landmark::theta_d);
      break;
    case 'p':
      go_to_landmark(gui, Landmark::percolation);
      break;
    case 'c':
      go_to_landmark(gui, Landmark::theta_c);
      break;
    case 'j':
      go_to_landmark(gui, Landmark::length_jump);
      break;
    case '<':
      change_speed(gui, 0.8);
      break;
    case '>':
      change_speed(gui, 1.25);
      break;
    case 'b':
      deposit(gui);
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
      toggle_trails(gui);
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
      run_to_tilt(gui);
      break;
    case 'r':
      reset(gui);
      break;
    case 's':
      save_state(gui);
      break;
    default:
      if (!change_view(gui, key) && key > ' ')
        model.state.message =
            key < 127 ? fmt::format("{} does nothing here; ? lists the keys.", static_cast<char>(key))
                      : "That key does nothing here; ? lists the keys.";
  }
}

/// Ends what is least missed: the list of keys, else what is selected.
void escape(Gui& gui) {
  ViewState& state = gui.model.state;
  const bool selected =
      state.selected || !state.selecting.selection.grains.empty() || state.selecting.selection.contact;
  if (state.show_help)
    state.show_help = false;
  else if (selected)
    gui.model.select(std::optional<Index>());
  else
    state.message = "Nothing is selected.";
}

}  // namespace

void handle_keys(Gui& gui) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) return;
  for (const ImWchar key : io.InputQueueCharacters) act(gui, key);
  if (pressed(ImGuiKey_RightArrow)) advance(gui, factor_of_modifiers());
  if (pressed(ImGuiKey_LeftArrow)) advance(gui, -factor_of_modifiers());
  if (pressed(ImGuiKey_Home)) go_to_landmark(gui, Landmark::first);
  if (pressed(ImGuiKey_End)) go_to_landmark(gui, Landmark::last);
  const bool list_open = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup);  // it closes itself
  if (pressed(ImGuiKey_Escape) && !list_open) escape(gui);
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
