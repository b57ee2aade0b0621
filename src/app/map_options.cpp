#include "app/map_options.h"

#include <fmt/core.h>

#include "app/choices.h"
#include "base/text.h"
#include "pictures/cluster_colours.h"
#include "render/layout.h"

namespace talus::app {
namespace {

CLI::Validator in_range(pictures::OptionRange range) { return app::in_range(range.low, range.high); }

std::string list_of_traces() { return joined(pictures::trace_kinds(), ", ", pictures::trace_name); }

std::string list_of_colours() { return joined(render::colour_maps(), ", ", render::colour_map_name); }

std::string list_of_palettes() { return joined(pictures::cluster_palettes, " or ", pictures::palette_name); }

void add_live_options(CLI::App& command, pictures::MapOptions& options) {
  command
      .add_option(
          "--map", options.maps,
          "Maps to draw, separated by commas; a plus overlays two, as in gamma+forces. Available maps: " +
              pictures::list_of_maps() + "; talus maps describes them")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--width", options.width, "Width of the picture in pixels; the height follows from the bed")
      ->capture_default_str()
      ->check(app::in_range(render::smallest_width, render::largest_side));
  command
      .add_option("--theta-c", options.theta_c,
                  "Angle of repose in degrees, for Gamma_c = sin(theta_c) [that of the run]")
      ->check(in_range(pictures::theta_c_range));
  command
      .add_option("--l-min", options.l_min,
                  "For maps gamma, overloaded and clusters, and their traces: diameter of the neighbourhood "
                  "of a grain, in mean diameters: 3 includes its first neighbours, 0 is the grain alone [3]")
      ->check(in_range(pictures::l_min_range));
  command.add_option("--colours", options.colours,
                     fmt::format("Colours of the bar: {}; _r reverses them, as in gray_r [default of each "
                                 "map]; of clusters: {} [muted]; separate the two by a comma",
                                 list_of_colours(), list_of_palettes()));
  command
      .add_option("--context", options.context,
                  "Rendering context: osmesa, egl, or auto for the first of them that works")
      ->capture_default_str();
}

void add_scale_options(CLI::App& command, pictures::MapOptions& options) {
  command
      .add_option(
          "--threshold", options.threshold,
          "Grains are overloaded if gamma is at least this multiple of Gamma_c; the paper states 1 and draws "
          "2 [1]")
      ->check(in_range(pictures::threshold_range));
  command
      .add_option("--length", options.length,
                  "For maps coarse, density, stress, shear_rate and temperature: diameter of the region "
                  "averaged over around a grain, in mean diameters [10]")
      ->check(in_range(pictures::length_range));
  command
      .add_option("--since", options.since,
                  "For maps displacement, rotation, nonaffine, shear, dilation and vorticity: motion since "
                  "this angle in degrees [since the preceding frame, per degree of tilt]")
      ->check(in_range(pictures::since_range));
  command.add_option("--joined", options.joined,
                     "Overloaded grains form a cluster through contacts that carry a force, or as neighbours "
                     "closer than 1.1 times the sum of their radii [contacts]");
  command
      .add_option("--range", options.range,
                  "LOW,HIGH: ends of the bar, in the unit of its title [default of the map]")
      ->delimiter(',')
      ->expected(2);
}

void add_frame_options(CLI::App& command, pictures::MapOptions& options) {
  command
      .add_option("--crop", options.crop,
                  "X0,Y0,X1,Y1: draw only this region of the bed, in mean diameters; 0,0 is the left end of "
                  "the floor")
      ->delimiter(',')
      ->expected(4);
  command.add_option(
      "--trace", options.traces,
      "Curves over the tilt below the map, with a mark at the tilt of the frame; separated by commas: " +
          list_of_traces());
  command.add_flag("--turned", options.turned, "Draw the bed at its tilt instead of in its own frame");
  command.add_flag("--transparent", options.transparent, "Transparent background instead of white");
  command.add_flag("--bare", options.bare, "Draw the bed alone, without caption, bar, scale and arrow");
  command
      .add_option("--printed", options.printed,
                  "Printed width of the picture in cm, e.g. 8.6 for a column; its letters are 8 points high "
                  "in print, unless --for is given, and the file states its resolution [from --for]")
      ->check(in_range(pictures::printed_range));
  command
      .add_option("--for", options.purpose,
                  "Purpose that sets the size of letters: paper (8 points, 17.8 cm wide), slide (16 points, "
                  "33.9 cm) or poster (24 points, 40 cm) [a screen; for PDF and SVG: paper]")
      ->check(one_of({"paper", "slide", "poster"}));
}

}  // namespace

void add_run_argument(CLI::App& command, std::string& run) {
  command.add_option("RUN", run, "Run to draw: RUN.h5, or the folder RUN.h5.run of a run under way")
      ->required();
}

void add_map_options(CLI::App& command, pictures::MapOptions& options, MapOptionSet set, CLI::Option* needs) {
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

}  // namespace talus::app
