#pragma once
/// Colours of clusters of overloaded grains that persist from frame to frame.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "analysis/overload/clusters.h"
#include "render/colour.h"

namespace talus::pictures {

/// One cluster of a frame: its identity over the frames, and its index in the largest palette (smaller
/// palettes repeat); -1 while the cluster is too small for a colour.
struct ClusterColour {
  std::int64_t track = -1;
  int palette_index = -1;
  bool operator==(const ClusterColour&) const = default;
};

/// Clusters below this size do not have a colour yet.
inline constexpr Index smallest_coloured_cluster = 10;

/// The colours of clusters; all are darker than grains that are not overloaded.
enum class ClusterPalette {
  muted,     ///< twelve colours, for a screen and a colour print
  contrast,  ///< five colours, distinguishable with any colour blindness and in a gray print
};
inline constexpr std::array cluster_palettes = {ClusterPalette::muted, ClusterPalette::contrast};
/// Returns "muted" or "contrast".
std::string_view palette_name(ClusterPalette palette);
std::vector<render::Colour> cluster_palette(ClusterPalette palette = ClusterPalette::muted);

/// Returns the rim of a spanning cluster of that colour: black, or a light gray if the colour is too dark.
render::Colour spanning_rim(const render::Colour& fill);

/// Tracks clusters through the frames of a run, in order. A cluster keeps its identity while it grows or
/// shrinks: it inherits that of the earlier cluster with which it shares the most grains. A merged cluster
/// therefore takes the colour of the larger part, and the largest fragment of a cluster keeps its colour. A
/// new cluster takes the colour that the fewest grains have.
class ClusterColours {
 public:
  /// Adds the clusters of the next frame, and returns their colours in the same order.
  std::vector<ClusterColour> next(const analysis::Clusters& clusters);

 private:
  struct Track {
    int palette_index = -1;
    Index size = 0;
  };
  std::vector<std::int64_t> track_of_grain_;  ///< tracks in the preceding frame; -1 for none
  std::vector<Track> tracks_;
};

}  // namespace talus::pictures
