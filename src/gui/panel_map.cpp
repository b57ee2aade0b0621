#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "core/trigonometry.h"
#include "gui/actions.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

/// Returns the names of all maps, preceded by the entry for none.
std::vector<std::string> kind_names(const char* none = nullptr) {
  std::vector<std::string> names;
  if (none != nullptr) names.emplace_back(none);
  for (const pictures::MapKind kind : pictures::map_kinds()) names.emplace_back(pictures::map_name(kind));
  return names;
}

int place_of(pictures::MapKind kind) {
  const auto kinds = pictures::map_kinds();
  return static_cast<int>(std::ranges::find(kinds, kind) - kinds.begin());
}

void choose_layers(Gui& gui) {
  pictures::MapLayers& layers = gui.model.state.map.layers;
  int base = place_of(layers.at(0));
  if (named_choice(gui, "map kind", "map", kind_names(), base)) {
    layers[0] = pictures::map_kinds()[static_cast<std::size_t>(base)];
    if (layers.size() > 1 && layers[1] == layers[0]) layers.pop_back();
  }
  ImGui::TextWrapped("%s", std::string(pictures::map_help(layers[0])).c_str());
  int over = layers.size() > 1 ? place_of(layers[1]) + 1 : 0;
  if (named_choice(gui, "overlay", "overlay", kind_names("nothing"), over)) {
    layers.resize(1);
    const bool other = over > 0 && pictures::map_kinds()[static_cast<std::size_t>(over - 1)] != layers[0];
    if (other) layers.push_back(pictures::map_kinds()[static_cast<std::size_t>(over - 1)]);
  }
}

void choose_palette(Gui& gui) {
  pictures::MapSettings& map = gui.model.state.map;
  std::vector<std::string> names;
  for (const pictures::ClusterPalette palette : pictures::cluster_palettes)
    names.emplace_back(pictures::palette_name(palette));
  int chosen = static_cast<int>(map.palette);
  if (named_choice(gui, "palette", "clusters", names, chosen))
    map.palette = pictures::cluster_palettes.at(static_cast<std::size_t>(chosen));
}

void choose_colours(Gui& gui) {
  pictures::MapSettings& map = gui.model.state.map;
  if (pictures::shows(map.layers, pictures::MapKind::clusters)) choose_palette(gui);
  bool reversed = map.colours && render::is_reversed(*map.colours);
  std::vector<std::string> names = {"its own"};
  for (const render::ColourMap colours : render::colour_maps())
    names.emplace_back(render::colour_map_name(colours));
  int chosen = 0;
  for (std::size_t k = 0; k < render::colour_maps().size(); ++k)
    if (map.colours && render::one_way(*map.colours) == render::colour_maps()[k])
      chosen = static_cast<int>(k) + 1;
  if (named_choice(gui, "colours", "colours", names, chosen)) {
    map.colours.reset();
    if (chosen > 0) map.colours = render::colour_maps()[static_cast<std::size_t>(chosen - 1)];
    if (reversed && map.colours) map.colours = render::reversed(*map.colours);
  }
  if (map.colours && named_checkbox(gui, "reversed", "reversed", reversed, "reverses the colours of the bar"))
    map.colours = render::reversed(*map.colours);
}

/// Selects the grains whose value on the map shown lies within the range of its bar, ends included.
void select_within_range(Gui& gui) {
  const pictures::MapSettings& map = gui.model.state.map;
  const view::View shown = gui.model.first();
  (void)shown.annotated_map();  // values are those of the map drawn last
  const std::vector<double>& values = shown.values().values;
  std::vector<Index> found;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (*map.range_low <= values[i] && values[i] <= *map.range_high) found.push_back(static_cast<Index>(i));
  show_message(gui, fmt::format("Grains selected: {}.", found.size()));
  gui.model.select(std::move(found));
}

/// Sets the ends of the bar, overriding those of the map.
void choose_range(Gui& gui) {
  pictures::MapSettings& map = gui.model.state.map;
  if (!pictures::has_bar(map.layers)) return;
  bool own = map.range_low || map.range_high;
  if (named_checkbox(gui, "range", "range", own,
                     "sets the ends of the bar, instead of the range of the map")) {
    const render::FrameView shown = gui.model.first().annotated_map();
    map.range_low.reset();
    map.range_high.reset();
    const auto with_bar = std::ranges::find_if(
        shown.legends, [](const render::Legend& legend) { return !legend.bars.empty(); });
    if (own && with_bar != shown.legends.end()) {  // begin with the current range
      map.range_low = with_bar->bars.front().low;
      map.range_high = with_bar->bars.front().high;
    }
  }
  if (!map.range_low || !map.range_high) return;
  ImGui::PushItemWidth(4.5f * gui.em);
  ImGui::SameLine();
  named_number(gui, "range low", "", *map.range_low, "%.3g");
  ImGui::SameLine();
  named_number(gui, "range high", "", *map.range_high, "%.3g");
  ImGui::PopItemWidth();
  if (named_button(gui, "select range", "Select the grains within it",
                   "those whose value on this map lies between the ends of the bar"))
    select_within_range(gui);
}

/// Edits an optional angle (rad): a checkbox, which sets it to that of the frame shown, and a slider.
void choose_angle(Gui& gui, std::optional<double>& angle, const std::string& name, const char* label,
                  const char* tip) {
  bool there = angle.has_value();
  if (named_checkbox(gui, name.c_str(), label, there, tip))
    angle = there ? std::optional(gui.model.frame().tilt) : std::nullopt;
  if (!angle) return;
  double shown = degrees(*angle);
  if (named_slider(gui, (name + " angle").c_str(), "since", shown, 0.0, 60.0, "%.2f°"))
    angle = radians(shown);
}

/// Chooses the content of the second view.
void choose_second_view(Gui& gui) {
  view::SecondViewState& second_view = gui.model.state.second_view;
  named_checkbox(gui, "second view", "a second view", second_view.shown, "another map, or a change: P");
  if (!second_view.shown) return;
  int chosen = second_view.layers.empty() ? 0 : place_of(second_view.layers[0]) + 1;
  if (named_choice(gui, "second view map", "its map", kind_names("same as the first"), chosen)) {
    second_view.layers.clear();
    if (chosen > 0) second_view.layers = {pictures::map_kinds()[static_cast<std::size_t>(chosen - 1)]};
  }
  choose_angle(gui, second_view.minus, "second minus", "minus the frame at an angle",
               "change since that angle: grains, and contacts gained and lost; D: since the frame shown");
}

}  // namespace

void draw_map_panel(Gui& gui) {
  view::ViewState& state = gui.model.state;
  choose_layers(gui);
  choose_colours(gui);
  choose_range(gui);
  ImGui::Separator();
  named_slider(
      gui, "l_min", "γ within ℓ", state.map.l_min, 0.0, 10.0, "%.1f D",
      "diameter of the neighbourhood that gives a grain its γ; 3: its first neighbours, 0: the grain alone");
  named_slider(gui, "threshold", "overloaded", state.map.threshold_factor, 0.1, 4.0, "γ ≥ %.2f Γc",
               "grains are overloaded if γ is at least this multiple of Γc: [ and ]");
  named_slider(gui, "length", "coarse over ℓ", state.map.length, 1.0, 40.0, "%.1f D",
               "averaging diameter of coarse, density, stress, shear_rate and temperature: , and .");
  choose_angle(gui, state.since, "since", "moved since an angle",
               "maps of motion and strain since that tilt, instead of per degree");
  choose_second_view(gui);
  named_checkbox(gui, "turned", "turned to the slope", state.map.turned, "t");
  named_checkbox(
      gui, "neighbours", "clusters of neighbours", state.map.joined_by_neighbours,
      "clusters join grains closer than 1.1 times the sum of their radii, instead of those that touch");
  if (named_button(gui, "whole bed", "Whole bed", "f")) show_whole_bed(gui);
  ImGui::SameLine();
  ImGui::Text("zoom %.1f", state.camera.zoom);
}

}  // namespace talus::gui
