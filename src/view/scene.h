#pragma once
/// The picture of the bed with what the view draws into it.

#include <memory>
#include <optional>
#include <vector>

#include "analysis/overload/clusters.h"
#include "pictures/picture_series.h"
#include "render/frame_view.h"

namespace talus::view {

/// What tells the first map of a series at a frame from other maps of the run.
struct MapSource {
  std::shared_ptr<const Frame> frame, reference;  ///< as in `picture`: the second may be null
  pictures::MapSettings settings;
  pictures::MapExtent extent;
  std::optional<std::size_t> since;
  std::size_t met = 0;  ///< how many frames its colours follow from
  bool change = false;  ///< the frame minus the reference (change_map.h), instead of the frame
  bool operator==(const MapSource&) const = default;
};

/// Of the map at frame k.
MapSource source_of(const pictures::PictureSeries& series, std::size_t k, std::shared_ptr<const Frame> frame,
                    std::shared_ptr<const Frame> reference);

/// A number that a map gives each free grain, NaN where it has none.
struct GrainValues {
  std::vector<double> values;  ///< empty where it gives none
  std::string title;           ///< rich text, of its bar: "γ = q/p"
};

/// Those of the first layer of the map that has any.
GrainValues grain_values(const MapSource& source, const RunStatics& statics);

/// The ends of the bar of the first layer that has one whose grains have numbers, where none are chosen.
std::optional<pictures::ScaleRange> own_range(const MapSource& source, const RunStatics& statics);

/// Whether the map depends on how much of the bed it shows: arrows are spread over it.
bool depends_on_extent(const pictures::MapLayers& layers);

/// The first map of the series at frame k, as `picture` makes it. One that cannot be drawn, as its scale has
/// no range, shows the grains alone, with the reason as its title.
render::FrameView draw_map(const pictures::PictureSeries& series, std::size_t k, const Frame& frame,
                           const Frame* reference);

/// The frame minus the reference, which may be null, as make_change_map has it, by the settings of the first
/// map of the series; drawn as draw_map where it cannot be. Both are frames of mapped_frame.
render::FrameView draw_change(const pictures::PictureSeries& series, const Frame& frame,
                              const Frame* reference);

/// The part of a map that is shown. Nothing is drawn beyond the extent of the map but side walls and a smooth
/// floor, as lines.
render::FrameView shown_map(const render::FrameView& map, const pictures::MapExtent& part,
                            const BedFrame& bed);

/// Of what is selected, and of where it has been.
inline constexpr render::Colour selection_colour{0, 90, 220}, trail_colour{0, 60, 150};

/// What is drawn over the map of a frame.
struct Overlay {
  std::optional<Index> selected;          ///< the grain that is looked at
  Index cluster = -1;                     ///< to be outlined; -1: none
  std::vector<double> diameters;          ///< of circles about the selected grain, m
  std::optional<double> critical_length;  ///< l_c of the selected grain, m: a circle in another colour
  std::vector<Index> grains;              ///< each with a thin ring
  std::optional<Index> contact;  ///< of those of the frame: a ring about its point, a line between its bodies
  /// Places of grains from frame to frame, m; in a periodic bed they go on beyond its edge.
  std::vector<std::vector<Vec2>> trails;
};

/// Diameters for circles of a neighbourhood that has grown to `largest`: round steps, and the largest.
std::vector<double> growing_diameters(double largest);

void add_overlay(render::FrameView& view, const BedFrame& bed, const Overlay& overlay,
                 const analysis::Clusters& clusters);

}  // namespace talus::view
