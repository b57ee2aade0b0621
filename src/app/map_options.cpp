#include "app/map_options.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <optional>

#include "app/options.h"
#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/cluster_colours.h"
#include "pictures/map_plan.h"
#include "render/layout.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

CLI::Validator in_range(pictures::ScaleRange range) { return app::in_range(range.low, range.high); }

std::string list_of_traces() { return joined(pictures::trace_kinds(), ", ", pictures::trace_name); }

std::string list_of_colours() { return joined(render::colour_maps(), ", ", render::colour_map_name); }

std::string list_of_palettes() { return joined(pictures::cluster_palettes, " or ", pictures::palette_name); }

void add_live_options(CLI::App& command, MapArguments& arguments) {
  add_option(command, "--map", arguments.options.maps, "MAP,...",
             "Maps to draw, separated by commas; a plus overlays two, as in gamma+forces. Available maps: " +
                 pictures::list_of_maps() +
                 ", and the names of values stored with the run [gamma,overloaded]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_option(
      command, "--size", arguments.size, "SIZE",
      fmt::format(
          "Size of a picture or movie: its width in pixels, e.g. 1920, or in print, e.g. 8.6cm for a column; "
          "or both sides, e.g. 1920x1080 or 17.8x10cm, which the maps then fill. In cm, letters have the "
          "size of --for, and the file states its resolution [{}; the height follows from the bed]",
          arguments.options.width));
  add_option(command, "--colours", arguments.options.colours, "COLOURS",
             fmt::format("Colours of the bar: {}; _r reverses them, as in gray_r [default of each map]; of "
                         "clusters: {} [muted]; separate the two by a comma",
                         list_of_colours(), list_of_palettes()));
  add_option(command, "--context", arguments.options.context, "CONTEXT",
             "Rendering context: osmesa, egl, or auto for the first of them that works")
      ->capture_default_str();
}

void add_scale_options(CLI::App& command, MapArguments& arguments) {
  pictures::MapOptions& options = arguments.options;
  add_option(
      command, "--set", arguments.settings, "KEY=VALUE",
      "Change a parameter, as of an analysis. gamma_c: Gamma_c, the threshold of the packing [the sine of "
      "theta_c of the run]. threshold_factors: grains are overloaded if gamma is at least this multiple of "
      "Gamma_c; the paper states 1 and draws 2 [1]. l_min: diameter of the neighbourhood whose stress ratio "
      "is the gamma of a grain; 3 includes its first neighbours, 0 is the grain alone [3]. joining: "
      "overloaded grains form a cluster through contacts that carry a force, or as neighbours closer than "
      "1.1 times the sum of their radii [contacts]. length: diameter of the region averaged over around a "
      "grain in maps coarse, density, stress, shear_rate and temperature [10]. Lengths are in mean diameters")
      ->allow_extra_args(false);
  add_option(command, "--since", options.since, "DEG",
             "For maps displacement, rotation, nonaffine, shear, dilation and vorticity: motion since this "
             "angle in degrees [since the preceding frame, per degree of tilt]")
      ->check(in_range(pictures::since_range));
  add_option(command, "--range", options.range, "LOW,HIGH",
             "Ends of the bar, in the unit of its title [default of the map]")
      ->delimiter(',')
      ->expected(2);
}

void add_look_options(CLI::App& command, pictures::MapOptions& options) {
  add_option(command, "--crop", options.crop, "X0,Y0,X1,Y1",
             "Draw only this region of the bed, in mean diameters; 0,0 is the left end of the floor")
      ->delimiter(',')
      ->expected(4);
  add_option(
      command, "--trace", options.traces, "CURVE,...",
      "Curves over the tilt below the map, with a mark at the tilt of the frame; separated by commas: " +
          list_of_traces());
  command.add_flag("--turned", options.turned, "Draw the bed at its tilt instead of in its own frame");
  command.add_flag("--transparent", options.transparent, "Transparent background instead of white");
  command.add_flag("--bare", options.bare, "Draw the bed alone, without caption, bar, scale and arrow");
  command
      .add_option("--for", options.purpose,
                  "Purpose that sets the size of letters and, unless --size is in cm, of the page: paper (8 "
                  "points, 17.8 cm wide), slide (16 points, 33.9 cm) or poster (24 points, 40 cm) [a screen; "
                  "for PDF and SVG: paper]")
      ->check(one_of({"paper", "slide", "poster"}));
}

/// The parameters of maps: those of an analysis that they have, and the width of coarse-grained ones.
struct MapParameters {
  analysis::AnalysisParameters analysis;
  double length = pictures::MapSettings().length;
};

const std::vector<scenario::Key<MapParameters>>& map_keys() {
  static const std::vector<scenario::Key<MapParameters>> keys = [] {
    std::vector<scenario::Key<MapParameters>> all;
    for (const runs::AnalysisKey& key : runs::analysis_keys())
      for (const char* name : {"threshold_factors", "gamma_c", "l_min", "joining"})
        if (key.name == name) all.emplace_back(&MapParameters::analysis, key);
    all.emplace_back(length_key(), &MapParameters::length);
    return all;
  }();
  return keys;
}

/// Returns the angle of repose, deg, whose sine is gamma_c.
double theta_c_of(double gamma_c) {
  const auto [low, high] = pictures::theta_c_range;
  const double theta_c = degrees(std::asin(gamma_c));
  if (theta_c < low || theta_c > high)
    throw Error(ExitCode::usage,
                "--set gamma_c={:g}: maps need a Gamma_c from {:.3f} to {:.4f}, the sine of {:g} to {:g} deg",
                gamma_c, sine(radians(low)), sine(radians(high)), low, high);
  return theta_c;
}

}  // namespace

void add_map_options(CLI::App& command, MapArguments& arguments, MapOptionSet set, CLI::Option* needs) {
  const std::size_t before = command.get_options().size();
  add_live_options(command, arguments);
  if (set == MapOptionSet::all) {
    add_scale_options(command, arguments);
    add_look_options(command, arguments.options);
  }
  const std::vector<CLI::Option*> all = command.get_options();
  for (std::size_t k = before; k < all.size(); ++k) {
    all[k]->group(map_group);
    if (needs != nullptr) all[k]->needs(needs);
  }
}

scenario::KeyHead length_key() {
  const auto [low, high] = pictures::length_range;
  return {"length", "D", scenario::NumberRange{low, high, true, {}},
          "diameter of the region over which a coarse-grained field averages"};
}

pictures::MapOptions map_options(const MapArguments& arguments) {
  pictures::MapOptions options = arguments.options;
  set_size(options, arguments.size);
  const auto values = scenario::read_settings(scenario::heads(map_keys()), arguments.settings, "l_min=0");
  MapParameters parameters;
  for (const scenario::Key<MapParameters>& key : map_keys()) {
    const auto given = values.find(&key);
    if (given == values.end()) continue;
    key.set(parameters, given->second);
    const analysis::AnalysisParameters& analysis = parameters.analysis;
    if (key.name == "threshold_factors") options.threshold = analysis.threshold_factors.front();
    if (key.name == "gamma_c" && analysis.gamma_c) options.theta_c = theta_c_of(*analysis.gamma_c);
    if (key.name == "l_min") options.l_min = analysis.l_min;
    if (key.name == "joining")
      options.joined = analysis.joining == analysis::Joining::neighbours ? "neighbours" : "contacts";
    if (key.name == "length") options.length = parameters.length;
  }
  return options;
}

bool is_map_setting(const std::string& setting) {
  return scenario::find_key(scenario::heads(map_keys()), scenario::trimmed(std::string_view(setting).substr(
                                                             0, setting.find('=')))) != nullptr;
}

std::string beside_run(const std::string& run, const std::string& ending) {
  std::filesystem::path name = run;
  if (!name.has_filename()) name = name.parent_path();  // RUN.h5.run/
  if (name.extension() == ".run") name.replace_extension();
  if (name.extension() == ".h5") name.replace_extension();
  return name.string() + ending;
}

namespace {

std::optional<double> positive_number(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && number > 0.0 && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

[[noreturn]] void refuse(const std::string& text, const std::string& expected) {
  throw Error(ExitCode::usage, "--size {}: expected {}", visible_word(text), expected);
}

}  // namespace

WrittenSize parse_size(const std::string& text) {
  WrittenSize size;
  std::string_view sides = text;
  size.in_cm = sides.ends_with("cm");
  if (size.in_cm) sides.remove_suffix(2);
  const std::size_t middle = std::min(sides.find('x'), sides.size());
  const bool has_height = middle < sides.size();
  const auto width = positive_number(sides.substr(0, middle));
  const auto height = has_height ? positive_number(sides.substr(middle + 1)) : std::optional(0.0);
  if (!width || !height || (!size.in_cm && (std::round(*width) != *width || std::round(*height) != *height)))
    refuse(text, "a width or both sides, in pixels or cm: 1600, 1920x1080, 8.6cm or 17.8x10cm");
  size.width = *width;
  size.height = *height;
  return size;
}

void set_size(pictures::MapOptions& options, const std::string& text) {
  if (text.empty()) return;
  const WrittenSize size = parse_size(text);
  const auto [narrowest, widest] = pictures::printed_range;
  if (size.in_cm && (size.width < narrowest || size.width > widest))
    refuse(text, fmt::format("a width from {} to {} cm", narrowest, widest));
  const double width = size.in_cm ? options.width : size.width;
  const double height = size.in_cm ? std::round(width * size.height / size.width) : size.height;
  const auto possible = [](double side) {
    return side >= render::smallest_width && side <= render::largest_side;
  };
  if (!possible(width) || (size.height > 0.0 && !possible(height)))
    refuse(text, size.in_cm ? "a height from an eighth to ten times the width"
                            : fmt::format("{} to {} pixels on each side", render::smallest_width,
                                          render::largest_side));
  if (size.in_cm) options.printed = size.width;
  options.width = static_cast<int>(width);
  options.height = static_cast<int>(height);
}

}  // namespace talus::app
