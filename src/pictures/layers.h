#pragma once
/// The layer that each kind of map makes of a frame; make_map composes one or two of them.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pictures/maps.h"
#include "pictures/scale.h"

namespace talus::pictures {

/// Grains or lines, and their legend.
struct MapLayer {
  std::string title;                ///< begins with a capital letter
  std::vector<GrainStyle> styles;   ///< one for each free grain; empty: the layer has lines only
  std::vector<render::Line> lines;  ///< without copies across a periodic edge
  render::Legend legend;
  std::vector<double> values{};  ///< one for each free grain, if values on `scale` determine their looks
  std::optional<Scale> scale{};
};

// Parts of layers and of their legends.

inline render::Line line_between(double x0, double y0, double x1, double y1, double half_width,
                                 const render::Colour& colour) {
  return {static_cast<float>(x0), static_cast<float>(y0),         static_cast<float>(x1),
          static_cast<float>(y1), static_cast<float>(half_width), colour};
}

inline render::Swatch disc_swatch(const GrainStyle& style, const std::string& label) {
  return {render::Swatch::Kind::disc, style.fill, style.rim, 0.0, label};
}

inline render::Swatch line_swatch(const render::Colour& colour, double width, const std::string& label) {
  return {render::Swatch::Kind::line, colour, colour, width, label};
}

// maps.cpp
/// Returns layer k of the settings; `seen` as for make_map.
MapLayer make_layer(const analysis::GrainSource& bed, const MapSettings& settings, const MapExtent& extent,
                    std::size_t k, const SeenFrames* seen = nullptr);
/// Returns the colour of lines over layer k: black, or, if its grains can be dark, a colour that differs from
/// theirs and, also in gray, from black and white.
render::Colour colour_over(const MapSettings& settings, std::size_t k);
/// Returns "θ = 12.25°, θ_c = 19.52°", with "(assumed)" if it is.
std::string caption_of(const Frame& frame, const MapSettings& settings);

/// Returns a layer of grains in the colours of their values, which the bar receives; with `outlines`, grains
/// without a value (NaN) are outlines.
MapLayer scaled_layer(const std::string& title, const Scale& scale, std::vector<double> values,
                      render::Bar bar, bool outlines = false);

/// Returns the map of these layers of a frame, with its furniture, as make_map does.
render::FrameView compose_map(const analysis::GrainSource& frame, const MapSettings& settings,
                              const MapExtent& extent, std::vector<MapLayer> layers);

// grain_layers.cpp
MapLayer gamma_layer(const analysis::GrainSource& bed, const MapSettings& settings,
                     const ScaleChoice& choice);
MapLayer coarse_layer(const analysis::GrainSource& bed, const MapSettings& settings,
                      const ScaleChoice& choice);

// `over_grains`: as marks in grains that another layer fills
MapLayer overloaded_layer(const analysis::GrainSource& bed, const MapSettings& settings, bool over_grains);
MapLayer clusters_layer(const analysis::GrainSource& bed, const MapSettings& settings, bool over_grains,
                        const SeenFrames* seen);

/// Returns a map of shown_quantity. Throws Error(internal) for other kinds.
MapLayer value_layer(MapKind kind, const analysis::GrainSource& bed, const MapSettings& settings,
                     const ScaleChoice& choice);
/// Returns the value of each free grain, in the unit of map_reading, per degree if motion_span is; NaN if
/// there is no value, and 0 or NaN without a required reference.
std::vector<double> map_values(MapKind kind, const analysis::GrainSource& bed, const MapSettings& settings);

MapLayer size_layer(const analysis::GrainSource& bed, const ScaleChoice& choice);
MapLayer dyed_layer(const analysis::GrainSource& bed, const ScaleChoice& choice, const SeenFrames* seen);

/// The colour of lines over grains that another layer fills; none if they are outlines.
using OverColour = std::optional<render::Colour>;

/// D: width of the border of lines over filled grains. It separates them from grains of any shade.
inline constexpr double line_border = 0.06;
/// Adds a white border of that width, m, to opaque lines, below all of them.
void add_borders(std::vector<render::Line>& lines, double border);

// motion.cpp
/// Returns an arrow for each free grain, or for one in each square of side `spacing` (m) if that exceeds D;
/// arrows are then longer in proportion. Lengths are the displacements times a round factor, which the legend
/// states; the longest are cut.
MapLayer displacement_arrows(const analysis::GrainSource& bed, const MotionRanges& motion,
                             const OverColour& over, double spacing);

// contact_layers.cpp
/// D: half the width of the line of a contact with the mean force, and the largest distinguishable force over
/// the mean, at which the line is nearly as wide as the smallest grains.
inline constexpr struct { double half_width, widest; } force_lines = {0.05, 6.0};
/// D: the line of a contact with fully mobilised friction.
inline constexpr struct { double length, half_width; } critical_lines = {0.7, 0.11};
/// Returns a line from centre to centre of the bodies in contact, or to the point at a wall; half_width in m.
render::Line centre_line(const BedFrame& bed, Index contact, double half_width, const render::Colour& colour);
MapLayer forces_layer(const analysis::GrainSource& bed, const OverColour& over);
MapLayer critical_layer(const analysis::GrainSource& bed, const OverColour& over);

// How contacts support each grain; `over_grains` as above.
MapLayer coordination_layer(const analysis::GrainSource& bed, const ScaleChoice& choice);
MapLayer rigid_layer(const analysis::GrainSource& bed, bool over_grains);

// own_map.cpp
/// Returns the layer of settings.own. Its scale fits the values of the frame and those in the settings unless
/// a range is chosen, and has 0 in its middle if they have both signs. Throws Error(bad_data) if the frame
/// has no such values, and Error(usage) if a text cannot be set, or a range is invalid.
MapLayer own_layer(const analysis::GrainSource& frame, const MapSettings& settings);
/// Returns the smallest and the largest of the finite values, or nothing.
std::vector<double> ends_of(std::span<const double> values);

/// Returns the diameter over which coarse maps average, m. Throws Error(usage) if it exceeds the bed.
double coarse_length(const analysis::GrainSource& bed, const MapSettings& settings);

/// Returns Gamma_c = sin(theta_c).
double gamma_c_of(const MapSettings& settings);

// motion.cpp
// Motion of each grain between two frames, and the ranges of scales that fit it.

/// The interval over which motion is measured.
struct MotionSpan {
  bool per_degree = false;
  double degrees = 1.0;  ///< divisor
  std::string title;     ///< for example " since 5.00°"
  std::string unit;      ///< for example " per degree"
};
MotionSpan motion_span(const analysis::GrainSource& bed);

/// Counts of non-negative values in narrow classes, which give quantiles in little memory.
class LogHistogram {
 public:
  /// Makes an empty histogram; values below `smallest` count as 0.
  explicit LogHistogram(double smallest = 1e-9) : smallest_(smallest) {}
  void add(double value);
  /// Returns the value below which a fraction `share` of the values lies, at most 2.4 % too large.
  double quantile(double share) const;

 private:
  static constexpr int decades = 18, classes_per_decade = 100;
  double smallest_;
  std::array<std::int64_t, decades * classes_per_decade + 1> counts_{};
  std::int64_t total_ = 0;
};

/// Collects the frames that are drawn, and finds the ranges that fit them.
class MotionSample {
 public:
  /// Makes an empty sample for these maps of motion (fits_frames), drawn with these settings.
  explicit MotionSample(const MapLayers& maps, const MapSettings& settings = {});
  /// Adds a frame with its reference; one without a reference adds only velocities.
  void add(const analysis::GrainSource& bed);
  MotionRanges ranges() const;

 private:
  MapSettings settings_;
  std::map<MapKind, std::array<LogHistogram, 2>> sizes_;  ///< total, and per degree
};

}  // namespace talus::pictures
