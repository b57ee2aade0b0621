#include "view/render_command.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "core/trigonometry.h"
#include "render/colour_map.h"

namespace talus::view {
namespace {

/// Formats a number as briefly as possible; eight digits distinguish any two frames.
std::string number(double value) { return fmt::format("{:.8g}", value == 0.0 ? 0.0 : value); }

/// Formats the part in D, rounded inwards, because `talus render` rejects parts that leave the bed.
std::string crop_text(const pictures::MapExtent& part, double diameter) {
  constexpr double parts = 100.0;  // hundredths of D
  const auto up = [&](double x) { return number(std::ceil(x / diameter * parts - 1e-9) / parts); };
  const auto down = [&](double x) { return number(std::floor(x / diameter * parts + 1e-9) / parts); };
  return fmt::format("{},{},{},{}", up(part.x_min), up(part.y_min), down(part.x_max), down(part.y_max));
}

/// Returns the range if it differs from the default of `talus render`: a range chosen by the user or, for
/// motion, the fixed range of the window.
std::optional<pictures::ScaleRange> range_of(const RenderRequest& shown) {
  const pictures::MapSettings& settings = shown.settings;
  if (!pictures::has_bar(settings.layers)) return std::nullopt;
  if (settings.range_low && settings.range_high)
    return pictures::ScaleRange{*settings.range_low, *settings.range_high};
  const auto bar =
      std::ranges::find_if(settings.layers, [](pictures::MapKind kind) { return pictures::has_bar({kind}); });
  if (!pictures::fits_frames(*bar)) return std::nullopt;
  return pictures::fixed_motion_range(*bar, !shown.since && !shown.in_flow);
}

}  // namespace

std::string render_command_line(const RenderRequest& shown) {
  const pictures::MapSettings& settings = shown.settings;
  const pictures::MapLayers& layers = settings.layers;
  std::string line = "talus render " + shell_quoted(shown.run);
  const auto add = [&line](const std::string& option, const std::string& value) {
    line += fmt::format(" {} {}", option, value);
  };
  const auto flag = [&line](const std::string& option) { line += " " + option; };
  add("--map", pictures::layers_name(layers));
  add("--at", shown.frame ? fmt::format("frame{}", *shown.frame) : number(degrees(shown.tilt)));
  if (shown.in_flow) flag("--flow");
  const bool by_theta_c = pictures::any_layer(layers, pictures::needs_theta_c);
  if (by_theta_c && settings.theta_c_assumed) add("--theta-c", number(degrees(settings.theta_c)));
  if (pictures::any_layer(layers, pictures::shows_gamma) && settings.l_min != pictures::MapSettings().l_min)
    add("--l-min", number(settings.l_min));
  const bool by_threshold = pictures::shows(layers, pictures::MapKind::overloaded) ||
                            pictures::shows(layers, pictures::MapKind::clusters);
  if (by_threshold && settings.threshold_factor != 1.0) add("--threshold", number(settings.threshold_factor));
  if (pictures::any_layer(layers, pictures::is_coarse) && settings.length != pictures::MapSettings().length)
    add("--length", number(settings.length));
  if (shown.since && pictures::any_layer(layers, pictures::needs_reference))
    add("--since", number(degrees(*shown.since)));
  if (settings.joined_by_neighbours && pictures::shows(layers, pictures::MapKind::clusters))
    add("--joined", "neighbours");
  std::vector<std::string_view> colours;
  if (pictures::has_bar(layers) && settings.colours)
    colours.push_back(render::colour_map_name(*settings.colours));
  if (pictures::shows(layers, pictures::MapKind::clusters) &&
      settings.palette != pictures::ClusterPalette::muted)
    colours.push_back(pictures::palette_name(settings.palette));
  if (!colours.empty()) add("--colours", joined(colours, ","));
  if (const std::optional<pictures::ScaleRange> range = range_of(shown))
    add("--range", fmt::format("{},{}", number(range->low), number(range->high)));
  if (shown.part) add("--crop", crop_text(*shown.part, shown.mean_diameter));
  if (settings.turned) flag("--turned");
  if (settings.transparent) flag("--transparent");
  if (settings.printed > 0.0) add("--printed", number(settings.printed));
  return line;
}

}  // namespace talus::view
