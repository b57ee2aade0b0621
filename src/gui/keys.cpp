#include <algorithm>

#include "core/trigonometry.h"
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
    {"right, left", "a step or a frame on; a frame back (shift 10, ctrl 100)"},
    {"home, end", "first, last frame"},
    {"d, p, c", "to theta_d; to where a cluster first spans; to theta_c"},
    {"1 ... 9", "the maps, in the order of their list"},
    {"0", "nothing over the map"},
    {"o", "next overlay"},
    {"[ ]", "threshold of overloaded grains"},
    {", .", "length of coarse graining"},
    {"; '", "neighbourhood of the selected grain"},
    {"t", "turn the bed to its slope"},
    {"+ -, wheel", "zoom"},
    {"w a x z, drag", "move the picture"},
    {"f", "whole bed"},
    {"n", "select the next grain; escape: none"},
    {"g", "run to the angle"},
    {"r", "reset, with the seed given"},
    {"s", "save a checkpoint of a recorded run"},
    {"e", "write the picture to the file named under files"},
    {"u, k", "push the selected grain; drop grains there"},
    {"h", "show or hide the panels"},
    {"l", "show or hide the plots"},
    {"?", "this list"},
    {"q", "quit"},
};

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

void choose_map(MapLayers& layers, std::size_t k) {
  if (k >= map_kinds().size()) return;
  layers[0] = map_kinds()[k];
  if (layers.size() > 1 && layers[1] == layers[0]) layers.pop_back();
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
      state.selected = state.selected ? (*state.selected + 1) % gui.model.statics().free_count : 0;
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
      gui.requests.quit = true;
      break;
    case 'g':
      if (model.is_live()) model.live()->run_to(radians(model.state.run_to_tilt));
      break;
    case 'r':
      if (model.is_live()) model.restart(static_cast<std::uint64_t>(std::max(model.state.seed, 0)));
      break;
    case 's':
      if (model.is_live()) model.live()->save();
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
  if (pressed(ImGuiKey_Escape)) {
    if (gui.model.state.show_help)
      gui.model.state.show_help = false;
    else
      gui.model.state.selected.reset();
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
    ImGui::TextUnformatted(line.what);
  }
  ImGui::TextUnformatted("On the map: click a grain, drag to move, wheel to zoom.");
  note_place(gui, "help", ImGui::GetWindowPos(),
             {ImGui::GetWindowPos().x + ImGui::GetWindowWidth(),
              ImGui::GetWindowPos().y + ImGui::GetWindowHeight()});
  ImGui::End();
}

}  // namespace talus
