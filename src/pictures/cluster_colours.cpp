#include "pictures/cluster_colours.h"

#include <algorithm>
#include <tuple>

namespace talus::pictures {
namespace {

/// The number of grains that a cluster shares with an earlier one.
struct SharedGrains {
  std::int64_t track = -1;
  Index cluster = -1;
  Index grains = 0;
};

/// Returns an entry for each pair of a cluster and an earlier one that share grains.
std::vector<SharedGrains> shared_grains(const analysis::Clusters& clusters,
                                        const std::vector<std::int64_t>& track_of_grain) {
  std::vector<std::pair<std::int64_t, Index>> pairs;
  for (std::size_t i = 0; i < std::min(clusters.label.size(), track_of_grain.size()); ++i)
    if (clusters.label[i] >= 0 && track_of_grain[i] >= 0)
      pairs.emplace_back(track_of_grain[i], clusters.label[i]);
  std::ranges::sort(pairs);
  std::vector<SharedGrains> shared;
  for (const auto& [track, cluster] : pairs) {
    if (shared.empty() || shared.back().track != track || shared.back().cluster != cluster)
      shared.push_back({track, cluster, 0});
    ++shared.back().grains;
  }
  return shared;
}

std::size_t min_worn(const std::vector<Index>& worn) {
  return static_cast<std::size_t>(std::ranges::min_element(worn) - worn.begin());
}

}  // namespace

std::string_view palette_name(ClusterPalette palette) {
  return palette == ClusterPalette::muted ? "muted" : "contrast";
}

std::vector<render::Colour> cluster_palette(ClusterPalette palette) {
  // Vermillion, sky blue and yellow from Okabe and Ito and from Tol, indigo, and a purple. Their lightness L*
  // differs by at least 10 from each other, from white, and from the gray of small clusters.
  if (palette == ClusterPalette::contrast)
    return {{196, 82, 0}, {51, 34, 136}, {136, 204, 238}, {140, 36, 104}, {240, 228, 66}};
  // Colours from Okabe and Ito (2008) and from Tol's "muted" scheme; successive ones differ strongly. Yellow
  // is left out because it is too light. A violet and a brown replace indigo and wine, on which the black rim
  // of a spanning cluster would be invisible.
  return {{213, 94, 0},   {0, 114, 178},   {68, 170, 153}, {170, 68, 153}, {230, 159, 0},   {115, 100, 215},
          {153, 153, 51}, {136, 204, 238}, {150, 85, 70},  {17, 119, 51},  {204, 102, 119}, {221, 204, 119}};
}

render::Colour spanning_rim(const render::Colour& fill) {
  constexpr double dark_luma = 78.0;
  return render::luma(fill) < dark_luma ? render::gray(0.25)
                                        : render::black;  // white would vanish against the background
}

std::vector<ClusterColour> ClusterColours::next(const analysis::Clusters& clusters) {
  std::vector<SharedGrains> shared = shared_grains(clusters, track_of_grain_);
  // Pairs with the most grains come first; ties are decided by the size of the earlier cluster.
  std::ranges::sort(shared, [&](const SharedGrains& one, const SharedGrains& other) {
    const auto key = [&](const SharedGrains& pair) {
      return std::tuple(-pair.grains, -tracks_[static_cast<std::size_t>(pair.track)].size, pair.track,
                        pair.cluster);
    };
    return key(one) < key(other);
  });
  std::vector<ClusterColour> colours(clusters.size.size());
  std::vector<bool> taken(tracks_.size(), false);
  for (const SharedGrains& pair : shared) {
    ClusterColour& colour = colours[static_cast<std::size_t>(pair.cluster)];
    const auto track = static_cast<std::size_t>(pair.track);
    if (colour.track >= 0 || taken[track]) continue;
    taken[track] = true;
    colour = {pair.track, tracks_[track].palette_index};
  }

  std::vector<Index> worn(cluster_palette().size(), 0);
  for (std::size_t k = 0; k < colours.size(); ++k)
    if (colours[k].palette_index >= 0)
      worn[static_cast<std::size_t>(colours[k].palette_index)] += clusters.size[k];
  for (std::size_t k = 0; k < colours.size(); ++k) {
    ClusterColour& colour = colours[k];
    if (colour.track < 0) {
      colour.track = static_cast<std::int64_t>(tracks_.size());
      tracks_.emplace_back();
    }
    if (colour.palette_index < 0 && clusters.size[k] >= smallest_coloured_cluster) {
      const std::size_t least = min_worn(worn);
      worn[least] += clusters.size[k];
      colour.palette_index = static_cast<int>(least);
    }
    tracks_[static_cast<std::size_t>(colour.track)] = {colour.palette_index, clusters.size[k]};
  }
  // A cluster that has become small is gray, as the legend states; its colour is kept until it grows again.
  for (std::size_t k = 0; k < colours.size(); ++k)
    if (clusters.size[k] < smallest_coloured_cluster) colours[k].palette_index = -1;
  track_of_grain_.assign(clusters.label.size(), -1);
  for (std::size_t i = 0; i < clusters.label.size(); ++i)
    if (clusters.label[i] >= 0)
      track_of_grain_[i] = colours[static_cast<std::size_t>(clusters.label[i])].track;
  return colours;
}

}  // namespace talus::pictures
