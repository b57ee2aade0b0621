#pragma once
/// Picture of the bed with the marks of the view, and the command line that draws it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/overload/clusters.h"
#include "pictures/maps.h"
#include "pictures/picture_series.h"
#include "render/frame_view.h"

namespace talus::view {

/// Everything that determines a map.
struct MapKey {
  std::shared_ptr<const Frame> frame, reference;  ///< `reference` may be null
  pictures::MapSettings settings;
  pictures::MapExtent extent;
  std::optional<std::size_t> since;  ///< frame from which motion is measured
  std::size_t colour_frames = 0;     ///< number of frames that determine its colours
  bool change = false;               ///< the frame minus the reference instead of the frame
  bool operator==(const MapKey&) const = default;
};
/// Returns the key of the map that draw_map draws of these frames.
MapKey map_key(const pictures::PictureSeries& series, std::size_t k, std::shared_ptr<const Frame> frame,
               std::shared_ptr<const Frame> reference, bool change = false);

/// Draws the first map of the series at frame k, as `picture` does, or the `change` from the reference (may
/// be null) to the frame, as make_change_map does; both are then frames of mapped_frame. A map that cannot be
/// drawn, because its scale has no range, shows the grains alone, with the reason as title.
render::FrameView draw_map(const pictures::PictureSeries& series, std::size_t k, const Frame& frame,
                           const Frame* reference, bool change = false);

/// Returns the layer that the bar of a map belongs to, if it is one of motion (fits_frames).
std::optional<pictures::MapKind> moving_layer(const pictures::MapLayers& layers);

/// Returns the part of a map that is shown. Beyond the map only walls and a smooth floor are drawn.
render::FrameView shown_map(const render::FrameView& map, const pictures::MapExtent& part,
                            const BedFrame& bed);

inline constexpr render::Colour selection_colour{0, 90, 220};

/// Marks drawn over the map of a frame, within the bed.
struct Overlay {
  std::optional<Index> selected;          ///< inspected grain
  Index cluster = -1;                     ///< cluster to outline; -1: none
  std::vector<double> diameters;          ///< diameters of circles about the inspected grain, m
  std::optional<double> critical_length;  ///< l_c of the inspected grain, m: a circle in another colour
  std::vector<Index> grains;              ///< grains marked with a thin ring
  std::optional<Index>
      contact;  ///< contact of the frame: a ring about its point, and a line between its bodies
};

/// Returns the diameters of circles for a neighbourhood that has grown to `largest`: round steps, and that.
std::vector<double> growing_diameters(double largest);

/// Rings end at the edges of `extent`, that of the bed.
void add_overlay(render::FrameView& view, const BedFrame& bed, const Overlay& overlay,
                 const analysis::Clusters& clusters, const pictures::MapExtent& extent);

/// Returns the map for a dark background. The space behind the discs is left empty, and all grays of the bed
/// and of the legends are mirrored; colours stay. If the middle of a colour bar is gray, the grains keep
/// their colours, and only lines and the floor are mirrored.
render::FrameView on_dark_ground(render::FrameView map);

/// Picture shown, as far as `talus render` has options for it.
struct RenderRequest {
  std::string run;                          ///< path
  pictures::MapSettings settings;           ///< an assumed theta_c is written into the command
  double tilt = 0.0;                        ///< rad, tilt of a frame of the run
  std::optional<std::size_t> frame;         ///< number of the frame, if its tilt is not unique
  bool in_flow = false;                     ///< the frame comes after failure: the entire flow is requested
  std::optional<double> since;              ///< rad
  std::optional<pictures::MapExtent> part;  ///< m; empty: the entire bed
  double mean_diameter = 1.0;               ///< m
};

/// Returns "talus render RUN --map gamma --at 12.25", quoted for the shell, with an option for each setting
/// that the map depends on and that differs from the default.
std::string render_command_line(const RenderRequest& shown);

}  // namespace talus::view
