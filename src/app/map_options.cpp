#include "app/map_options.h"

#include <fmt/core.h>

#include "app/choices.h"
#include "base/text.h"
#include "pictures/cluster_colours.h"
#include "render/layout.h"

namespace talus::app {
namespace {

std::string list_of_traces() { return joined(pictures::trace_kinds(), ", ", pictures::trace_name); }

std::string list_of_colours() { return joined(render::colour_maps(), ", ", render::colour_map_name); }

std::string list_of_palettes() { return joined(pictures::cluster_palettes, " or ", pictures::palette_name); }

void add_live_options(CLI::App& command, pictures::MapOptions& options) {
  command
      .add_option("--map", options.maps,
                  "What is drawn: one map, or several with commas; two overlaid with a plus, as in "
                  "gamma+forces. The maps: " +
                      pictures::list_of_maps() + "; talus maps says what they show")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      .add_option("--width", options.width, "Width of the picture in pixels; the height follows from the bed")
      ->capture_default_str()
      ->check(in_range(render::smallest_width, render::largest_side));
  command
      .add_option("--theta-c", options.theta_c,
                  "Angle of repose in degrees, for Gamma_c = sin(theta_c) [that of the run]")
      ->check(in_range(2.0, 89.0));
  command
      .add_option(
          "--l-min", options.l_min,
          "Maps gamma, overloaded and clusters, and their traces: a grain is taken together with all "
          "whose centres lie within half of this of its own, in mean diameters: 3 for a grain and its "
          "first neighbours, 0 for the grain alone [3]")
      ->check(in_range(0.0, 100.0));
  command.add_option("--colours", options.colours,
                     fmt::format("Colours of the bar: {}, reversed with _r, as gray_r [each map its own]; of "
                                 "clusters: {} [muted]; one of each with a comma",
                                 list_of_colours(), list_of_palettes()));
  command
      .add_option("--context", options.context,
                  "What draws it: osmesa, egl, or auto for the first of them that works")
      ->capture_default_str();
}

void add_scale_options(CLI::App& command, pictures::MapOptions& options) {
  command
      .add_option("--threshold", options.threshold,
                  "Grains are overloaded from this times Gamma_c on; the paper prints 1 and draws 2 [1]")
      ->check(in_range(0.01, 100.0));
  command
      .add_option(
          "--length", options.length,
          "Maps coarse, density, stress, shear_rate and temperature: diameter of what is averaged over "
          "around a grain, in mean diameters [10]")
      ->check(in_range(1.0, 1000.0));
  command
      .add_option("--since", options.since,
                  "Maps displacement, rotation, nonaffine, shear, dilation and vorticity: since this angle "
                  "in degrees "
                  "[in a degree of tilt, from the frame before]")
      ->check(in_range(0.0, 90.0));
  command.add_option("--joined", options.joined,
                     "Clusters join by contacts that carry a force, or by neighbours: grains closer than 1.1 "
                     "times the sum of their radii [contacts]");
  command
      .add_option("--range", options.range,
                  "LOW,HIGH: ends of the bar, in the unit of its title [as the map has them]")
      ->delimiter(',')
      ->expected(2);
}

void add_frame_options(CLI::App& command, pictures::MapOptions& options) {
  command
      .add_option("--crop", options.crop,
                  "X0,Y0,X1,Y1: this region of the bed only, in mean diameters; 0,0 is the left end on the "
                  "floor")
      ->delimiter(',')
      ->expected(4);
  command.add_option(
      "--trace", options.traces,
      "Curves over the tilt below the map, with a mark where the frame is; one, or several with "
      "commas: " +
          list_of_traces());
  command.add_flag("--turned", options.turned, "Draw the bed at its slope instead of in its own frame");
  command.add_flag("--transparent", options.transparent, "Transparent background instead of white");
  command.add_flag("--bare", options.bare, "The bed alone: no caption, bar, scale or arrow");
  command
      .add_option(
          "--printed", options.printed,
          "How wide the picture will be printed, in cm, as 8.6 for a column: its letters have 8 points "
          "there, unless --for says otherwise, and the file says its resolution [as --for]")
      ->check(in_range(4.0, 200.0));
  command
      .add_option("--for", options.purpose,
                  "What the letters are for: paper (8 points, 17.8 cm wide), slide (16 points, 33.9 cm) or "
                  "poster (24 "
                  "points, 40 cm) [a screen; of PDF and SVG: paper]")
      ->check(one_of({"paper", "slide", "poster"}));
}

}  // namespace

void add_run_argument(CLI::App& command, std::string& run) {
  command.add_option("RUN", run, "Run to draw: RUN.h5, or the folder RUN.h5.run of one that is under way")
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
