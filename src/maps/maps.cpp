#include "maps/maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "stress/overload.h"

namespace talus {
namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::vector<double> map_shades(const Frame& frame, const RunStatics& statics, MapKind kind, double gamma_c) {
  std::vector<double> shades;
  for (const double gamma : std::span(frame.gamma).first(static_cast<std::size_t>(statics.free_count)))
    shades.push_back(kind == MapKind::gamma ? gamma_shade(gamma, gamma_c)
                                            : static_cast<double>(is_overloaded(gamma, gamma_c)));
  return shades;
}

/// A disc, and in a periodic bed its copy where it crosses an edge.
void add_disc(std::vector<Disc>& discs, Disc disc, const RunStatics& statics) {
  discs.push_back(disc);
  if (!statics.periodic) return;
  const auto length = static_cast<float>(statics.length);
  Disc copy = disc;
  if (disc.x - disc.radius < 0.0f)
    copy.x += length;
  else if (disc.x + disc.radius > length)
    copy.x -= length;
  else
    return;
  discs.push_back(copy);
}

std::vector<Disc> map_discs(const Frame& frame, const RunStatics& statics, std::span<const double> shades) {
  std::vector<Disc> discs;
  discs.reserve(frame.x.size() + frame.x.size() / 16);
  for (std::size_t i = 0; i < frame.x.size(); ++i) {
    Disc disc;
    disc.x = static_cast<float>(frame.x[i]);
    disc.y = static_cast<float>(frame.y[i]);
    disc.radius = static_cast<float>(statics.radius[i]);
    if (i < shades.size())
      disc.shade = static_cast<float>(shades[i]);
    else
      disc.hatched = 1.0f;
    add_disc(discs, disc, statics);
  }
  return discs;
}

/// 10 D, or less in a bed so short that 10 D would fill it.
void set_scale(FrameView& view, const RunStatics& statics) {
  int diameters = 10;
  for (int shorter : {5, 2, 1})
    if (diameters * statics.mean_diameter > 0.3 * statics.length) diameters = shorter;
  view.scale_length = diameters * statics.mean_diameter;
  view.scale_label = std::to_string(diameters) + " D";
}

void describe_gamma(FrameView& view, double gamma_c) {
  view.title = "Stress ratio γ of each grain";
  view.bar_title = "γ = q/p";
  view.bar_ticks = {{0.0, fixed(white_below, 2)},
                    {gamma_shade(gamma_c, gamma_c), "Γ_c = " + fixed(gamma_c, 2)},
                    {1.0, "2Γ_c = " + fixed(2.0 * gamma_c, 2)}};
}

void describe_overloaded(FrameView& view, const Frame& frame, const RunStatics& statics, double gamma_c) {
  const OverloadCount count = count_overloaded(frame, statics, gamma_c);
  view.title = "Overloaded grains";
  if (count.loaded > 0) view.title += ", p_o = " + fixed(count.fraction(), 3);
  view.swatches = {{1.0, "γ ≥ Γ_c = sin θ_c = " + fixed(gamma_c, 2)}, {0.0, "γ < Γ_c"}};
}

}  // namespace

MapKind map_kind(std::string_view name) {
  for (MapKind kind : {MapKind::gamma, MapKind::overloaded})
    if (name == map_name(kind)) return kind;
  throw Error(ExitCode::usage, "map '" + std::string(name) + "': expected gamma or overloaded");
}

std::string_view map_name(MapKind kind) { return kind == MapKind::gamma ? "gamma" : "overloaded"; }

double gamma_shade(double gamma, double gamma_c) {
  if (std::isnan(gamma)) return 0.0;
  return std::clamp((gamma - white_below) / (2.0 * gamma_c - white_below), 0.0, 1.0);
}

void extend(MapExtent& extent, const Frame& frame, const RunStatics& statics) {
  for (std::size_t i = 0; i < frame.y.size(); ++i) {
    extent.y_min = std::min(extent.y_min, frame.y[i] - statics.radius[i]);
    extent.y_max = std::max(extent.y_max, frame.y[i] + statics.radius[i]);
  }
}

FrameView bare_map(const Frame& frame, const RunStatics& statics, std::span<const double> shades,
                   const MapExtent& extent) {
  FrameView view;
  view.furniture = false;
  view.discs = map_discs(frame, statics, shades);
  view.x_max = statics.length;
  view.y_min = extent.y_min;
  view.y_max = extent.y_max;
  return view;
}

FrameView make_map(const Frame& frame, const RunStatics& statics, MapKind kind, double theta_c,
                   const MapExtent& extent) {
  if (!(theta_c > radians(2.0) && theta_c < radians(89.0)))
    throw Error(ExitCode::bad_data, "theta_c = " + fixed(degrees(theta_c), 3) +
                                        " deg: expected an angle of repose between 2 and 89 deg");
  const double gamma_c = sine(theta_c);
  FrameView view = bare_map(frame, statics, map_shades(frame, statics, kind, gamma_c), extent);
  view.furniture = true;
  view.walls = !statics.periodic;
  view.floor_line = statics.free_count == frame.grain_count();
  view.tilt = frame.tilt;
  view.caption = "θ = " + fixed(degrees(frame.tilt), 2) + "°, θ_c = " + fixed(degrees(theta_c), 2) + "°";
  set_scale(view, statics);
  if (kind == MapKind::gamma)
    describe_gamma(view, gamma_c);
  else
    describe_overloaded(view, frame, statics, gamma_c);
  return view;
}

}  // namespace talus
