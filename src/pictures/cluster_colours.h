#pragma once
/// Colours of clusters of overloaded grains that stay with them from frame to frame.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "analysis/overload/clusters.h"
#include "render/colour.h"

namespace talus::pictures {

/// Of one cluster of a frame: its identity over the frames, and its place in the largest palette, which
/// smaller ones repeat; -1 while it is so small that it has no colour yet.
struct ClusterColour {
  std::int64_t track = -1;
  int palette_index = -1;
  bool operator==(const ClusterColour&) const = default;
};

/// Clusters below this size have no colour of their own yet.
inline constexpr Index smallest_coloured_cluster = 10;

/// The colours that clusters can have; all are darker than the grains that are not overloaded.
enum class ClusterPalette {
  muted,     ///< twelve, for a screen and a colour print
  contrast,  ///< five, told apart in any colour blindness and in a gray print
};
inline constexpr std::array cluster_palettes = {ClusterPalette::muted, ClusterPalette::contrast};
/// "muted", "contrast".
std::string_view palette_name(ClusterPalette palette);
std::vector<render::Colour> cluster_palette(ClusterPalette palette = ClusterPalette::muted);

/// The rim of a cluster that spans the bed, by its colour: black, or a light gray if that is too dark.
render::Colour spanning_rim(const render::Colour& fill);

/// Follows clusters through the frames of a run, in their order. A cluster keeps its identity while it grows
/// or shrinks: that of the earlier cluster of which it has the most grains. So a merger takes the colour of
/// the larger part, and of a cluster that falls apart the largest piece keeps it. A new one takes the colour
/// that the fewest grains wear.
class ClusterColours {
 public:
  /// The clusters of the next frame; the result in their order.
  std::vector<ClusterColour> next(const analysis::Clusters& clusters);

 private:
  struct Track {
    int palette_index = -1;
    Index size = 0;
  };
  std::vector<std::int64_t> track_of_grain_;  ///< of the frame before; -1 for none
  std::vector<Track> tracks_;
};

}  // namespace talus::pictures
