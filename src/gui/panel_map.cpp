#include <algorithm>
#include <fmt/core.h>
#include <functional>
#include <utility>

#include "core/trigonometry.h"
#include "gui/panels.h"
#include "pictures/map_plan.h"

namespace talus::gui {
namespace {

/// Chooses one of all values by its name, or none of them if `none` has a name.
template <typename Values, typename Value, typename Name>
bool choose_among(Gui& gui, const char* name, const char* label, const Values& all, const Name& name_of,
                  const char* none, std::optional<Value>& chosen) {
  std::vector<std::string> names;
  if (none != nullptr) names.emplace_back(none);
  const auto first = static_cast<std::ptrdiff_t>(names.size());
  for (const Value& value : all) names.emplace_back(name_of(value));
  int place = chosen ? static_cast<int>(first + (std::ranges::find(all, *chosen) - all.begin())) : 0;
  if (!named_choice(gui, name, label, names, place)) return false;
  chosen = place < first ? std::nullopt : std::optional<Value>(*(all.begin() + (place - first)));
  return true;
}

bool choose_kind(Gui& gui, const char* name, const char* label, const char* none,
                 std::optional<pictures::MapKind>& kind) {
  return choose_among(gui, name, label, pictures::map_kinds(), pictures::map_name, none, kind);
}

void choose_layers(Gui& gui) {
  pictures::MapSettings& map = gui.state.map;
  pictures::MapLayers& layers = map.layers;
  std::vector<std::string> names;
  for (const pictures::MapKind kind : pictures::map_kinds()) names.emplace_back(pictures::map_name(kind));
  for (const OwnQuantity& own : gui.model.own_maps()) names.push_back(own.name);
  auto base = std::optional(map.own ? map.own->name : std::string(pictures::map_name(layers.at(0))));
  if (choose_among(gui, "map kind", "map", names, std::identity(), nullptr, base)) {
    const std::string over = layers.size() > 1 ? std::string(pictures::map_name(layers[1])) : *base;
    pictures::choose_map(map, over == *base ? *base : *base + "+" + over, gui.model.own_maps());
  }
  ImGui::TextWrapped("%s", (map.own ? map.own->label : std::string(pictures::map_help(layers[0]))).c_str());
  auto over = layers.size() > 1 ? std::optional(layers[1]) : std::nullopt;
  if (choose_kind(gui, "overlay", "overlay", "nothing", over)) {
    layers.resize(1);
    if (over && (map.own || *over != layers[0])) layers.push_back(*over);
  }
}

void choose_colours(Gui& gui) {
  pictures::MapSettings& map = gui.state.map;
  if (std::optional palette = map.palette;
      pictures::has_palette(map) && choose_among(gui, "palette", "clusters", pictures::cluster_palettes,
                                                 pictures::palette_name, nullptr, palette))
    map.palette = *palette;
  bool reversed = map.colours && render::is_reversed(*map.colours);
  auto colours = map.colours ? std::optional(render::one_way(*map.colours)) : std::nullopt;
  if (choose_among(gui, "colours", "colours", render::colour_maps(), render::colour_map_name, "its own",
                   colours))
    map.colours = reversed && colours ? std::optional(render::reversed(*colours)) : colours;
  if (map.colours && named_checkbox(gui, "reversed", "reversed", reversed, "reverses the colours of the bar"))
    map.colours = render::reversed(*map.colours);
}

/// Selects the grains whose value on the map shown lies within the range of its bar, ends included.
void select_within_range(Gui& gui) {
  const pictures::MapSettings& map = gui.state.map;
  const render::Bar* const bar = gui.model.first().bar();
  const std::vector<double> values = bar == nullptr ? std::vector<double>() : bar->values;
  std::vector<Index> found;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (*map.range_low <= values[i] && values[i] <= *map.range_high) found.push_back(static_cast<Index>(i));
  show_message(gui, fmt::format("Grains selected: {}.", found.size()));
  gui.model.select(std::move(found));
}

/// Offers the range that fits the frame shown, for maps of motion, whose own range is fixed.
void offer_fit(Gui& gui) {
  pictures::MapSettings& map = gui.state.map;
  if (!view::moving_layer(map.layers)) return;
  ImGui::SameLine();
  if (!named_button(gui, "fit", "fit", "sets the ends of the bar to fit this frame, as talus render does"))
    return;
  const auto range = gui.model.first().fitting_range();
  if (!range) return show_message(gui, "Nothing has moved in this frame.");
  map.range_low = range->low;
  map.range_high = range->high;
}

/// Sets the ends of the bar, overriding those of the map.
void choose_range(Gui& gui) {
  pictures::MapSettings& map = gui.state.map;
  if (!pictures::has_bar(map.layers)) return;
  bool own = map.range_low || map.range_high;
  if (named_checkbox(gui, "range", "range", own,
                     "sets the ends of the bar, instead of the range of the map")) {
    const render::Bar* const bar = gui.model.first().bar();
    map.range_low.reset();
    map.range_high.reset();
    if (own && bar != nullptr) {  // begin with the current range
      map.range_low = bar->low;
      map.range_high = bar->high;
    }
  }
  if (!map.range_low || !map.range_high) return offer_fit(gui);
  ImGui::PushItemWidth(4.5f * gui.em);
  ImGui::SameLine();
  named_number(gui, "range low", "", *map.range_low, "%.3g");
  ImGui::SameLine();
  named_number(gui, "range high", "", *map.range_high, "%.3g");
  ImGui::PopItemWidth();
  if (named_button(gui, "select range", "Select the grains within it",
                   "those whose value on this map lies between the ends of the bar"))
    select_within_range(gui);
  offer_fit(gui);
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

void choose_second_view(Gui& gui) {
  view::SecondViewState& second_view = gui.state.second_view;
  named_checkbox(gui, "second view", "a second view", second_view.shown, "another map, or a change: P");
  if (!second_view.shown) return;
  auto kind = second_view.layers.empty() ? std::nullopt : std::optional(second_view.layers[0]);
  if (choose_kind(gui, "second view map", "its map", "same as the first", kind)) {
    second_view.layers.clear();
    if (kind) second_view.layers = {*kind};
  }
  choose_angle(gui, second_view.minus, "second minus", "minus the frame at an angle",
               "change since that angle: grains, and contacts gained and lost; D: since the frame shown");
}

}  // namespace

void draw_map_panel(Gui& gui) {
  choose_layers(gui);
  choose_colours(gui);
  choose_range(gui);
  ImGui::Separator();
  named_slider(
      gui, "l_min", "γ within ℓ", gui.state.map.l_min, 0.0, 10.0, "%.1f D",
      "diameter of the neighbourhood that gives a grain its γ; 3: its first neighbours, 0: the grain alone");
  named_slider(gui, "threshold", "threshold/Γ_c", gui.state.map.threshold_factor, 0.1, 4.0, "%.2f",
               "grains are overloaded if γ is at least this multiple of sin θc: [ and ]");
  named_slider(gui, "length", "coarse over ℓ", gui.state.map.length, 1.0, 40.0, "%.1f D",
               "averaging diameter of coarse, density, stress, shear_rate and temperature: , and .");
  choose_angle(gui, gui.state.since, "since", "moved since an angle",
               "maps of motion and strain since that tilt, instead of per degree");
  choose_second_view(gui);
  named_checkbox(gui, "turned", "turned to the slope", gui.state.map.turned, "t");
  named_checkbox(
      gui, "neighbours", "clusters of neighbours", gui.state.map.joined_by_neighbours,
      "clusters join grains closer than 1.1 times the sum of their radii, instead of those that touch");
  if (named_button(gui, "whole bed", "Whole bed", "f")) show_whole_bed(gui);
  ImGui::SameLine();
  ImGui::Text("zoom %.1f", gui.state.camera.zoom);
}

}  // namespace talus::gui
