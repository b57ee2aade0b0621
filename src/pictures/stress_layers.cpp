#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/overload/coarse_graining.h"
#include "base/errors.h"
#include "core/trigonometry.h"
#include "pictures/layers.h"
#include "pictures/texts.h"

namespace talus::pictures {
namespace {

/// Values over Gamma_c at which grains are black. For gamma as in the paper's Fig. 10; lower for
/// neighbourhoods, whose averages vary less and must differ in shade about Gamma_c.
constexpr double black_gamma = 2.0, black_coarse = 1.5;

/// Returns a bar with ticks at the ends and at Gamma_c.
render::Bar stress_ratio_bar(const Scale& scale, double gamma_c, const std::string& title,
                             const std::string& end) {
  constexpr double clear_of_ends = 0.2;  // fraction of the bar, for the labels
  render::Bar bar{
      title, render::colour_ramp(scale.colours), {{0.0, number_label(scale.low)}}, scale.low, scale.high};
  const double share = share_of(scale, gamma_c);
  if (share > clear_of_ends && share < 1.0 - clear_of_ends)
    bar.ticks.push_back({share, fmt::format("Γ_c = {:.2f}", gamma_c)});
  bar.ticks.push_back({1.0, end});
  return bar;
}

}  // namespace

double coarse_length(const MapFrame& bed, const MapSettings& settings) {
  const double length = settings.length * bed.statics.mean_diameter;
  if (length > 0.0 && length <= bed.statics.length) return length;
  throw Error(
      ExitCode::usage,
      fmt::format(
          "neighbourhoods of {:.6g} D: expected a diameter above 0, up to the length of the bed, {:.6g} D",
          settings.length, bed.statics.length / bed.statics.mean_diameter));
}

double gamma_c_of(const MapSettings& settings) { return sine(settings.theta_c); }

std::string reading_text(const OverloadRule& rule) {
  return rule.l_min > 0.0 ? fmt::format("l = {:.6g} D", rule.l_min) : std::string("single grains");
}

MapLayer gamma_layer(const MapFrame& bed, const MapSettings& settings, const ScaleChoice& choice) {
  const double gamma_c = gamma_c_of(settings);
  const double black = black_gamma * gamma_c;  // a single grain fails at tiny angles
  const Scale scale =
      chosen({render::ColourMap::gray, black > white_below ? white_below : 0.0, black}, choice);
  const std::string end = choice.high ? number_label(scale.high) : fmt::format("2Γ_c = {:.2f}", scale.high);
  const auto free_grains = std::span(bed.frame.gamma).first(static_cast<std::size_t>(bed.statics.free_count));
  return scaled_layer(fmt::format("Stress ratio γ of {}{}",
                                  settings.l_min > 0.0 ? "grains with their neighbours, " : std::string(),
                                  reading_text(settings)),
                      scale, {free_grains.begin(), free_grains.end()},
                      stress_ratio_bar(scale, gamma_c, "γ = q/p", end));
}

MapLayer coarse_layer(const MapFrame& bed, const MapSettings& settings, const ScaleChoice& choice) {
  const double length = coarse_length(bed, settings);
  const double gamma_c = gamma_c_of(settings);
  const Scale scale = chosen({render::ColourMap::gray, 0.0, black_coarse * gamma_c}, choice);
  const std::string end = choice.high ? number_label(scale.high) : fmt::format("{:.2f}", scale.high);
  return scaled_layer(fmt::format("Stress ratio γ_l of neighbourhoods, l = {:.6g} D", settings.length), scale,
                      analysis::coarse_stress_ratio(bed, length),
                      stress_ratio_bar(scale, gamma_c, "γ_l", end));
}

}  // namespace talus::pictures
