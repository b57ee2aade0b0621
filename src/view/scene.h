#pragma once
/// The picture of the bed with what the view draws into it.

#include <memory>
#include <optional>
#include <vector>

#include "analysis/clusters.h"
#include "pictures/maps.h"
#include "render/frame_view.h"

namespace talus {

/// What a map is made from.
struct MapSource {
  std::shared_ptr<const Frame> frame, reference;  ///< the second as in MapFrame: may be null
  bool per_degree = true;
  std::vector<ClusterColour> colours;  ///< of the clusters, as in MapFrame: may be empty
  MapSettings settings;
  MapExtent extent;
  bool operator==(const MapSource&) const = default;
};

/// Whether the map depends on how much of the bed it shows: arrows are spread over it.
bool depends_on_extent(const MapLayers& layers);

/// The map, with its furniture. One that cannot be drawn, as its scale has no range, shows the grains alone,
/// with the reason as its title.
FrameView draw_map(const MapSource& source, const RunStatics& statics);

/// What is drawn over the map of a frame.
struct Overlay {
  std::optional<Index> selected;
  Index cluster = -1;                     ///< to be highlighted; -1: none
  std::vector<double> diameters;          ///< of circles about the selected grain, m
  std::optional<double> critical_length;  ///< l_c of the selected grain, m: a circle in another colour
};

/// Diameters for circles of a neighbourhood that has grown to `largest`: round steps, and the largest.
std::vector<double> growing_diameters(double largest);

/// The part of a map that is shown, with what is over it. Nothing is drawn beyond the extent of the map but
/// side walls and a smooth floor, as lines.
FrameView shown_map(const FrameView& map, const MapExtent& part, const BedFrame& bed, const Overlay& overlay,
                    const Clusters& clusters);

}  // namespace talus
