#include "app/map_options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "render/layout.h"

namespace talus {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ExitCode::usage, message); }

/// "gamma: stress ratio of each grain ..." for each.
std::string list_of_maps() {
  std::string text;
  for (MapKind kind : map_kinds())
    text.append(text.empty() ? "" : "; ").append(map_name(kind)).append(": ").append(map_help(kind));
  return text;
}

std::string list_of_traces() {
  std::string text;
  for (TraceKind kind : trace_kinds())
    text.append(text.empty() ? "" : "; ").append(trace_name(kind)).append(": ").append(trace_help(kind));
  return text;
}

std::string list_of_colours() {
  std::string text;
  for (ColourMap map : colour_maps()) text.append(text.empty() ? "" : ", ").append(colour_map_name(map));
  return text;
}

void add_live_options(CLI::App& command, MapOptions& options) {
  command
      .add_option("--map", options.maps,
                  "What is drawn: one map, or several with commas; two overlaid with a plus, as in "
                  "gamma+forces. " +
                      list_of_maps())
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--width", options.width, "Width of the picture in pixels; the height follows from the bed")
      ->capture_default_str()
      ->check(CLI::Range(smallest_width, largest_side));
  command
      .add_option("--theta-c", options.theta_c,
                  "Angle of repose in degrees, for Gamma_c = sin(theta_c) [that of the run]")
      ->check(CLI::Range(2.0, 89.0));
  command
      .add_option(
          "--l-min", options.l_min,
          "Maps gamma, overloaded and clusters, and their traces: a grain is taken together with all "
          "whose centres lie within half of this of its own, in mean diameters: 3 for a grain and its "
          "first neighbours, 0 for the grain alone [3]")
      ->check(CLI::Range(0.0, 100.0));
  command.add_option("--colours", options.colours,
                     "Colours of the bar: " + list_of_colours() + " [each map its own]");
  command
      .add_option("--context", options.context,
                  "Where it is drawn: osmesa, egl, or auto for the first of them that works")
      ->capture_default_str();
}

void add_scale_options(CLI::App& command, MapOptions& options) {
  command
      .add_option("--threshold", options.threshold,
                  "Grains are overloaded from this times Gamma_c on; the paper prints 1 and draws 2 [1]")
      ->check(CLI::Range(0.01, 100.0));
  command
      .add_option("--length", options.length,
                  "Map coarse: diameter of the neighbourhood of a grain, in mean diameters [10]")
      ->check(CLI::Range(1.0, 1000.0));
  command
      .add_option(
          "--since", options.since,
          "Maps displacement and rotation: since this angle in degrees [in a degree of tilt, from the "
          "frame before]")
      ->check(CLI::Range(0.0, 90.0));
  command.add_option("--joined", options.joined,
                     "Clusters join by contacts that carry a force, or by neighbours: grains closer than 1.1 "
                     "times the sum of their radii [contacts]");
  command
      .add_option("--range", options.range,
                  "LOW,HIGH: ends of the bar, in the unit of its title [as the map has them]")
      ->delimiter(',')
      ->expected(2);
}

void add_frame_options(CLI::App& command, MapOptions& options) {
  command
      .add_option("--crop", options.crop,
                  "X0,Y0,X1,Y1: this region of the bed only, in mean diameters; 0,0 is the left end on the "
                  "floor")
      ->delimiter(',')
      ->expected(4);
  command.add_option(
      "--trace", options.traces,
      "Curves over the tilt below the map, with a mark where the frame is; one, or several with "
      "commas. " +
          list_of_traces());
  command.add_flag("--turned", options.turned, "The bed turned to its slope, instead of in its own frame");
  command.add_flag("--transparent", options.transparent, "Nothing behind the grains, instead of white");
  command.add_flag("--bare", options.bare, "The bed alone: no caption, bar, scale or arrow");
}

std::optional<Crop> parse_crop(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const Crop crop{values[0], values[1], values[2], values[3]};
  for (double value : values)
    if (!std::isfinite(value)) refuse("--crop: expected four finite numbers X0,Y0,X1,Y1");
  if (crop.x1 <= crop.x0 || crop.y1 <= crop.y0)
    refuse("--crop: the region is empty; expected X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1");
  return crop;
}

/// What all maps have in common.
MapSettings common_settings(const MapOptions& options) {
  MapSettings settings;
  settings.theta_c = options.theta_c ? radians(*options.theta_c) : std::numeric_limits<double>::quiet_NaN();
  settings.threshold_factor = options.threshold.value_or(settings.threshold_factor);
  settings.l_min = options.l_min.value_or(settings.l_min);
  settings.length = options.length.value_or(settings.length);
  settings.turned = options.turned;
  settings.transparent = options.transparent;
  settings.furniture = !options.bare;
  if (options.joined && *options.joined != "contacts" && *options.joined != "neighbours")
    refuse("--joined " + *options.joined + ": expected contacts or neighbours");
  settings.joined_by_neighbours = options.joined == "neighbours";
  if (!options.range.empty()) {
    settings.range_low = options.range[0];
    settings.range_high = options.range[1];
    if (!std::isfinite(options.range[0]) || !(options.range[0] < options.range[1]) ||
        !std::isfinite(options.range[1]))
      refuse("--range: expected LOW,HIGH with LOW < HIGH");
  }
  return settings;
}

bool draws_bar(const MapSettings& map) { return has_bar(map.layers); }

/// Options that would do nothing are errors: whoever wrote them expected something else.
void refuse_idle_options(const MapOptions& options, const MapPlan& plan) {
  const auto draws = [&plan](MapKind wanted) {
    return std::ranges::any_of(
        plan.maps, [wanted](const MapSettings& map) { return std::ranges::count(map.layers, wanted) > 0; });
  };
  if (!options.range.empty() && plan.maps.size() > 1)
    refuse("--range: its unit is that of one map; ask for the maps one by one");
  if (!options.range.empty() && !has_bar(plan.maps[0].layers))
    refuse("--range: the map " + layers_name(plan.maps[0].layers) + " has no bar");
  if (!options.colours.empty() && std::ranges::none_of(plan.maps, draws_bar))
    refuse("--colours: no map that is asked for has a bar; --colours is for those that do");
  if (options.length && !draws(MapKind::coarse)) refuse("--length: it is for the map coarse");
  if (options.since && !any_layer(plan, needs_reference))
    refuse("--since: it is for the maps displacement and rotation");
  if (options.l_min && !shows_gamma(plan))
    refuse("--l-min: no map or trace that is asked for goes by gamma of grains");
  if (options.threshold && !needs_theta_c(plan))
    refuse("--threshold: no map or trace that is asked for goes by Gamma_c");
  if (options.joined && !draws(MapKind::clusters) &&
      std::ranges::count(plan.traces, TraceKind::largest_cluster) == 0)
    refuse("--joined: it is for the map clusters and the trace of the largest one");
  if (options.bare && !options.traces.empty())
    refuse("--trace and --bare do not go together: traces are furniture");
}

}  // namespace

void add_run_argument(CLI::App& command, std::string& run) {
  command.add_option("RUN", run, "Run to draw: RUN.h5, or the folder RUN.h5.run of one that is under way")
      ->required();
}

void add_map_options(CLI::App& command, MapOptions& options, MapOptionSet set, CLI::Option* needs) {
  const std::size_t before = command.get_options().size();
  add_live_options(command, options);
  if (set == MapOptionSet::all) {
    add_scale_options(command, options);
    add_frame_options(command, options);
  }
  const std::vector<CLI::Option*> all = command.get_options();
  for (std::size_t k = before; k < all.size(); ++k) {
    all[k]->group("Maps");
    if (needs != nullptr) all[k]->needs(needs);
  }
}

MapPlan plan_maps(const MapOptions& options) {
  MapPlan plan;
  const MapSettings common = common_settings(options);
  std::set<std::string> names;
  for (const std::string& name : options.maps) {
    MapSettings& settings = plan.maps.emplace_back(common);
    settings.layers = map_layers(name);
    if (!names.insert(name).second) refuse("--map: " + name + " is given twice");
    if (!options.colours.empty() && has_bar(settings.layers)) settings.colours = colour_map(options.colours);
  }
  if (plan.maps.empty()) refuse("--map is missing; expected one of: " + list_of_maps());
  if (!options.colours.empty()) colour_map(options.colours);  // also where no map takes it
  if (!options.traces.empty()) plan.traces = trace_kinds(options.traces);
  plan.context = context_kind(options.context);
  plan.crop = parse_crop(options.crop);
  if (options.since) plan.since = radians(*options.since);
  plan.width = options.width;
  refuse_idle_options(options, plan);
  return plan;
}

bool any_layer(const MapPlan& plan, bool (*has)(MapKind)) {
  return std::ranges::any_of(plan.maps,
                             [has](const MapSettings& map) { return std::ranges::any_of(map.layers, has); });
}

bool draws_clusters(const MapPlan& plan) {
  return any_layer(plan, [](MapKind kind) { return kind == MapKind::clusters; });
}

bool needs_theta_c(const MapPlan& plan) {
  return any_layer(plan, needs_theta_c) ||
         std::ranges::any_of(plan.traces, [](TraceKind kind) { return needs_theta_c(kind); });
}

bool shows_gamma(const MapPlan& plan) {
  return any_layer(plan, shows_gamma) || std::ranges::any_of(plan.traces, trace_from_frames);
}

}  // namespace talus
