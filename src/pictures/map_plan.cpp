#include "pictures/map_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <set>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "io/packed_file.h"
#include "pictures/layers.h"
#include "render/layout.h"

namespace talus::pictures {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ExitCode::usage, message); }

void check_range(const char* option, std::optional<double> value, ScaleRange range) {
  if (value && !(*value >= range.low && *value <= range.high))
    refuse(
        fmt::format("{}: expected a number from {} to {}, found {}", option, range.low, range.high, *value));
}

void check_numbers(const MapOptions& options) {
  constexpr ScaleRange sides = {render::smallest_width, render::largest_side};
  check_range("width", options.width, sides);
  if (options.height != 0) check_range("height", options.height, sides);
  check_range("theta_c", options.theta_c, theta_c_range);
  check_range("l_min", options.l_min, l_min_range);
  check_range("threshold", options.threshold, threshold_range);
  check_range("length", options.length, length_range);
  check_range("--since", options.since, since_range);
  check_range("printed", options.printed, printed_range);
}

std::optional<MapExtent> parse_crop(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  if (values.size() != 4) refuse("--crop: expected four numbers X0,Y0,X1,Y1");
  const MapExtent crop{values[0], values[2], values[1], values[3]};
  for (double value : values)
    if (!std::isfinite(value)) refuse("--crop: expected four finite numbers X0,Y0,X1,Y1");
  if (crop.x_max <= crop.x_min || crop.y_max <= crop.y_min)
    refuse("--crop: the region is empty; expected X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1");
  return crop;
}

/// The width of pictures for a purpose, and the size of their letters.
struct Purpose {
  std::string name;
  double printed, points;
};
const Purpose purposes[] = {{"paper", 17.8, 8.0}, {"slide", 33.9, 16.0}, {"poster", 40.0, 24.0}};

void print(MapSettings& settings, const MapOptions& options) {
  if (options.printed) settings.printed = *options.printed;
  if (options.purpose.empty() && !options.document) return;
  const std::string name = options.purpose.empty() ? "paper" : options.purpose;
  const auto found = std::ranges::find(purposes, name, &Purpose::name);
  if (found == std::end(purposes))
    refuse(fmt::format("--for {}: expected paper, slide or poster", visible_word(options.purpose)));
  settings.printed = options.printed.value_or(found->printed);
  settings.points = found->points;
}

/// Returns the settings shared by all maps.
MapSettings common_settings(const MapOptions& options) {
  MapSettings settings;
  settings.theta_c = options.theta_c ? radians(*options.theta_c) : not_known;
  settings.threshold_factor = options.threshold.value_or(settings.threshold_factor);
  settings.l_min = options.l_min.value_or(settings.l_min);
  settings.length = options.length.value_or(settings.length);
  settings.turned = options.turned;
  settings.transparent = options.transparent;
  settings.furniture = !options.bare;
  print(settings, options);
  if (options.joined && *options.joined != "contacts" && *options.joined != "neighbours")
    refuse(fmt::format("joined = {}: expected contacts or neighbours{}", visible_word(*options.joined),
                       did_you_mean(*options.joined, {"contacts", "neighbours"})));
  settings.joined_by_neighbours = options.joined == "neighbours";
  if (!options.range.empty()) {
    if (options.range.size() != 2) refuse("--range: expected LOW,HIGH with LOW < HIGH");
    settings.range_low = options.range[0];
    settings.range_high = options.range[1];
    if (!std::isfinite(options.range[0]) || !(options.range[0] < options.range[1]) ||
        !std::isfinite(options.range[1]))
      refuse("--range: expected LOW,HIGH with LOW < HIGH");
  }
  return settings;
}

/// Returns the names of maps with a property: "displacement, rotation, ...".
std::string maps_with(bool (*has)(MapKind)) {
  MapLayers those;
  std::ranges::copy_if(map_kinds(), std::back_inserter(those), has);
  return joined(those, ", ", map_name);
}

bool draws_bar(const MapSettings& map) { return has_bar(map.layers); }

/// Options without effect are errors, because the user expected something else.
void refuse_idle_options(const MapOptions& options, const MapPlan& plan) {
  if (!options.range.empty() && plan.maps.size() > 1)
    refuse("--range: its unit depends on the map; request one map at a time");
  if (!options.range.empty() && !has_bar(plan.maps[0].layers))
    refuse(fmt::format("--range: the map {} has no bar", name_of(plan.maps[0])));
  if (options.length && !any_layer(plan, is_coarse))
    refuse("length applies only to the maps " + maps_with(is_coarse));
  if (options.since && !any_layer(plan, needs_reference))
    refuse("--since applies only to the maps " + maps_with(needs_reference));
  if (options.l_min && !shows_gamma(plan))
    refuse("l_min has no effect: no requested map or trace depends on the gamma of grains");
  if (options.threshold && !needs_theta_c(plan))
    refuse("the threshold has no effect: no requested map or trace depends on Gamma_c");
  if (options.joined && !shows(plan, MapKind::clusters) &&
      std::ranges::count(plan.traces, TraceKind::largest_cluster) == 0)
    refuse("joining applies only to the map clusters and the trace largest_cluster");
  if (options.bare && !options.traces.empty())
    refuse("--trace and --bare cannot be combined: a bare bed has no traces");
  if (options.bare && !options.purpose.empty())
    refuse("--for and --bare cannot be combined: a bare bed has no text");
}

[[noreturn]] void refuse_colours(std::string_view name) {
  // Known from other programs, but not offered.
  constexpr std::array uneven = {"turbo", "jet", "rainbow", "hsv"};
  const bool is_uneven = std::ranges::find(uneven, name) != uneven.end();
  std::vector<std::string> names;
  for (const render::ColourMap map : render::colour_maps()) {
    names.emplace_back(render::colour_map_name(map));
    names.emplace_back(render::colour_map_name(render::reversed(map)));
  }
  for (const ClusterPalette palette : cluster_palettes) names.emplace_back(palette_name(palette));
  refuse(fmt::format(
      "--colours {}: {}expected one of {}, each also reversed, such as gray_r; for clusters {}{}",
      visible_word(std::string(name)),
      is_uneven ? "its lightness rises and falls, so that it shows edges that the data do not have; " : "",
      joined(render::colour_maps(), ", ", render::colour_map_name),
      joined(cluster_palettes, " or ", palette_name),
      is_uneven ? std::string() : did_you_mean(std::string(name), names)));
}

/// Sets the colours of bars and of clusters, at most one of each.
void choose_colours(std::string_view words, MapPlan& plan) {
  int bars = 0, palettes = 0;
  for (std::string_view rest = words; !rest.empty();) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string_view word = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    const auto palette = std::ranges::find(cluster_palettes, word, palette_name);
    int& seen = palette == cluster_palettes.end() ? bars : palettes;
    if (++seen > 1)
      refuse(fmt::format("--colours {}: expected one colour map for bars, and one for clusters", words));
    if (palette != cluster_palettes.end()) {
      if (std::ranges::none_of(plan.maps, has_palette))
        refuse(fmt::format("--colours {} applies only to the map clusters", word));
      for (MapSettings& map : plan.maps) map.palette = *palette;
      continue;
    }
    const std::optional<render::ColourMap> colours = render::colour_map(word);
    if (!colours) refuse_colours(word);
    if (std::ranges::none_of(plan.maps, draws_bar))
      refuse(fmt::format("--colours {}: no requested map has a bar", word));
    for (MapSettings& map : plan.maps)
      if (has_bar(map.layers)) map.colours = colours;
  }
}

}  // namespace

std::vector<OwnQuantity> stored_maps(const io::RunFile& run) {
  std::vector<OwnQuantity> all = io::read_own(run);
  const auto grains = static_cast<std::size_t>(run.header().statics.radius.size()),
             free_count = static_cast<std::size_t>(run.header().statics.free_count);
  for (OwnQuantity& own : all) {
    for (std::size_t k = 0; own.of_grains && k < own.values.size(); ++k)
      if (k % grains >= free_count) own.values[k] = not_known;
    own.values = ends_of(own.values);
  }
  return all;
}

void choose_map(MapSettings& map, const std::string& name, std::span<const OwnQuantity> own) {
  const auto stored = [own](const std::string& part) {
    return std::ranges::find(own, part, &OwnQuantity::name);
  };
  const std::size_t plus = std::min(name.find('+'), name.size());
  const std::string upper = name.substr(std::min(plus + 1, name.size()));
  if (stored(upper) != own.end())
    refuse(fmt::format("map '{}': {} is stored with the run, and can only be the lower map", name, upper));
  const auto lower = stored(name.substr(0, plus));
  map.own = lower == own.end() ? std::nullopt : std::optional(*lower);
  map.layers = map.own ? MapLayers() : map_layers(name, own);
  if (!map.own) return;
  if (!upper.empty()) map.layers = map_layers(upper, own);
  if (map.layers.size() > 1) refuse(fmt::format("map '{}': at most two can be overlaid", name));
  map.layers.insert(map.layers.begin(),
                    map.own->kind == OwnQuantity::Kind::number ? MapKind::pressure : MapKind::rigid);
}

MapPlan plan_maps(const MapOptions& options, const std::string& path) try {
  return plan_maps(options);
} catch (const Error& error) {  // the name of a map may be that of values stored with the run
  if (io::run_presence(path) == io::RunPresence::none)
    throw Error(error.code(), "{} (and there is no run {})", error.what(), path);
  return plan_maps(options, stored_maps(io::RunFile::open(path)));
}

MapPlan plan_maps(const MapOptions& options, std::span<const OwnQuantity> own) {
  check_numbers(options);
  MapPlan plan;
  const MapSettings common = common_settings(options);
  std::set<std::string> names;
  for (const std::string& name : options.maps) {
    choose_map(plan.maps.emplace_back(common), name, own);
    if (!names.insert(name).second) refuse(fmt::format("--map: {} is given twice", name));
  }
  if (plan.maps.empty()) refuse("no map is requested; expected one of " + list_of_maps());
  if (!options.traces.empty()) plan.traces = trace_kinds(options.traces);
  plan.crop = parse_crop(options.crop);
  if (options.since) plan.since = radians(*options.since);
  plan.width = options.width;
  plan.height = options.height;
  refuse_idle_options(options, plan);
  choose_colours(options.colours, plan);
  plan.context = render::context_kind(options.context);
  return plan;
}

bool any_layer(const MapPlan& plan, bool (*has)(MapKind)) {
  return std::ranges::any_of(plan.maps, [has](const MapSettings& map) { return any_layer(map.layers, has); });
}

bool shows(const MapPlan& plan, MapKind kind) {
  return std::ranges::any_of(plan.maps, [kind](const MapSettings& map) { return shows(map.layers, kind); });
}

bool needs_theta_c(const MapPlan& plan) {
  return any_layer(plan, needs_theta_c) ||
         std::ranges::any_of(plan.traces, [](TraceKind kind) { return needs_theta_c(kind); });
}

bool shows_gamma(const MapPlan& plan) {
  return any_layer(plan, shows_gamma) || std::ranges::any_of(plan.traces, trace_from_frames);
}

}  // namespace talus::pictures
