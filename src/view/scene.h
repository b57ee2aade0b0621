#pragma once
/// Picture of the bed with the marks of the view.

#include <memory>
#include <optional>
#include <vector>

#include "analysis/overload/clusters.h"
#include "pictures/picture_series.h"
#include "render/frame_view.h"

namespace talus::view {

/// Data that determine the first map of a series at a frame.
struct MapSource {
  std::shared_ptr<const Frame> frame, reference;  ///< those of `picture`; `reference` may be null
  pictures::MapSettings settings;
  pictures::MapExtent extent;
  std::optional<std::size_t> since;
  std::size_t colour_frames = 0;  ///< number of frames that determine its colours
  bool change = false;            ///< show the frame minus the reference (change_map.h) instead of the frame
  bool operator==(const MapSource&) const = default;
};

/// Returns the source of the map at frame k.
MapSource source_of(const pictures::PictureSeries& series, std::size_t k, std::shared_ptr<const Frame> frame,
                    std::shared_ptr<const Frame> reference);

/// Values that a map assigns to the free grains; NaN if a grain has none.
struct GrainValues {
  std::vector<double> values;  ///< empty if the map assigns none
  std::string title;           ///< title of its bar, rich text: "γ = q/p"
};

/// Returns the values of the first layer of the map that has any.
GrainValues grain_values(const MapSource& source, const RunStatics& statics);

/// Returns whether the map depends on the part of the bed shown: arrows are spread over it.
bool depends_on_extent(const pictures::MapLayers& layers);

/// Draws the first map of the series at frame k, as `picture` does. A map that cannot be drawn, because its
/// scale has no range, shows the grains alone, with the reason as title.
render::FrameView draw_map(const pictures::PictureSeries& series, std::size_t k, const Frame& frame,
                           const Frame* reference);

/// Draws the frame minus the reference (may be null) as make_change_map does, with the settings of the first
/// map of the series; falls back to draw_map if that is impossible. Both are frames of mapped_frame.
render::FrameView draw_change(const pictures::PictureSeries& series, const Frame& frame,
                              const Frame* reference);

/// Returns the part of a map that is shown. Beyond the extent of the map only side walls and a smooth floor
/// are drawn, as lines.
render::FrameView shown_map(const render::FrameView& map, const pictures::MapExtent& part,
                            const BedFrame& bed);

inline constexpr render::Colour selection_colour{0, 90, 220};

/// Marks drawn over the map of a frame.
struct Overlay {
  std::optional<Index> selected;          ///< inspected grain
  Index cluster = -1;                     ///< cluster to outline; -1: none
  std::vector<double> diameters;          ///< diameters of circles about the inspected grain, m
  std::optional<double> critical_length;  ///< l_c of the inspected grain, m: a circle in another colour
  std::vector<Index> grains;              ///< grains marked with a thin ring
  std::optional<Index>
      contact;  ///< contact of the frame: a ring about its point, and a line between its bodies
};

/// Returns the diameters of the circles for a neighbourhood that has grown to `largest`: round steps, and the
/// largest.
std::vector<double> growing_diameters(double largest);

void add_overlay(render::FrameView& view, const BedFrame& bed, const Overlay& overlay,
                 const analysis::Clusters& clusters);

}  // namespace talus::view
