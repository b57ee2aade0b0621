#pragma once
/// Overloaded grains, their clusters, and colours of clusters that persist from frame to frame.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "analysis/overload/clusters.h"
#include "analysis/overload/coarse_graining.h"
#include "core/snapshot.h"
#include "render/colour.h"

namespace talus::pictures {

/// One cluster of a frame: its identity over the frames, and the index of its colour after the first of the
/// largest palette (smaller palettes repeat); -1 while the cluster is too small for a colour.
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
/// Returns its colours. In maps of clusters the first is that of clusters that span the bed, and of no other.
std::vector<render::Colour> cluster_palette(ClusterPalette palette = ClusterPalette::muted);

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

/// The rule by which maps, traces and curves find overloaded grains, and join them into clusters.
struct OverloadRule {
  double theta_c = 0.0;                    ///< rad, angle of repose: Gamma_c = sin(theta_c)
  double threshold_factor = 1.0;           ///< threshold of overloaded grains over Gamma_c
  bool joined_by_neighbours = false;       ///< join grains closer than 1.1 times the sum of their radii, not
                                           ///< only those that touch with a force
  double l_min = analysis::default_l_min;  ///< D: diameter of the neighbourhood whose stress ratio is the
                                           ///< gamma of a grain; 0: the grain alone
  bool operator==(const OverloadRule&) const = default;
};

/// Returns the threshold of the stress ratio of overloaded grains: threshold_factor times sin(theta_c).
double threshold_of(const OverloadRule& rule);

/// Returns a frame as its maps see it: gamma of a grain is that of its neighbourhood of diameter `l_min` (D).
/// Maps, traces and clusters are all made from such a frame.
Frame mapped_frame(Frame frame, const RunStatics& statics, double l_min);

/// Returns the clusters of the overloaded free grains of a frame of mapped_frame.
analysis::Clusters overloaded_clusters(const BedFrame& bed, const OverloadRule& rule);

}  // namespace talus::pictures
