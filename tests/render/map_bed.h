#pragma once
/// Maps of hand-made packings: D = 1 m, grains of 2 kg/m^2, gravity 10 m/s^2.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/trigonometry.h"
#include "pictures/maps.h"
#include "unit/analysis/packings.h"

namespace talus::test {

/// Adds data that packings omit and maps need: angles, images, velocities, masses.
inline void complete(Packing& packing) {
  const std::size_t count = packing.frame.x.size();
  packing.frame.angle.assign(count, 0.0);
  packing.frame.image.assign(count, 0);
  packing.frame.vx.assign(count, 0.0);
  packing.frame.vy.assign(count, 0.0);
  packing.statics.gravity = 10.0;
  packing.statics.mass.clear();
  for (const double radius : packing.statics.radius)
    packing.statics.mass.push_back(2.0 * pi * radius * radius);
}

/// Returns adjacent free grains of radius 0.5 above y = 0, with these gamma.
inline Packing row_of_grains(const std::vector<double>& gamma, bool periodic = false) {
  Packing packing = empty_packing(static_cast<double>(gamma.size()), periodic);
  for (std::size_t i = 0; i < gamma.size(); ++i) add_grain(packing, 0.5 + static_cast<double>(i), 0.5);
  packing.frame.gamma = gamma;
  complete(packing);
  return packing;
}

/// Returns settings with Gamma_c = sin 30 deg = 0.5 and gamma of single grains.
inline pictures::MapSettings settings_of(const std::string& layers) {
  pictures::MapSettings settings;
  settings.l_min = 0.0;
  settings.layers = pictures::map_layers(layers);
  settings.theta_c = radians(30.0);
  return settings;
}

/// Returns these settings in gray, with a range.
inline pictures::MapSettings in_gray(const std::string& layers, double low, double high) {
  pictures::MapSettings settings = settings_of(layers);
  settings.colours = render::ColourMap::gray;
  settings.range_low = low;
  settings.range_high = high;
  return settings;
}

/// Returns the shade in the map of gamma (paper, Fig. 10): 0 is white, up to 0.05 and if a grain carries
/// nothing; 1 is black, from 2 gamma_c on; linear between.
inline double gamma_shade(double gamma, double gamma_c) {
  return std::isnan(gamma) ? 0.0 : std::clamp((gamma - 0.05) / (2.0 * gamma_c - 0.05), 0.0, 1.0);
}

inline pictures::MapExtent extent_of(const Packing& packing) {
  pictures::MapExtent extent = pictures::bed_extent(packing.statics);
  pictures::extend(extent, {packing.frame, packing.statics});
  return extent;
}

inline render::FrameView map_of(const Packing& packing, const pictures::MapSettings& settings,
                                const Frame* reference = nullptr, bool per_degree = true) {
  return pictures::make_map({{packing.frame, packing.statics}, reference, per_degree, {}}, settings,
                            extent_of(packing));
}

inline render::FrameView map_of(const Packing& packing, const std::string& layers) {
  return map_of(packing, settings_of(layers));
}

}  // namespace talus::test
