#include "pictures/cluster_colours.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "analysis/free_grains.h"
#include "analysis/overload/clusters.h"
#include "core/trigonometry.h"
#include "stress/stress.h"

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
  // is left out because it is too light.
  return {{213, 94, 0},   {0, 114, 178},   {68, 170, 153}, {170, 68, 153}, {230, 159, 0},   {115, 100, 215},
          {153, 153, 51}, {136, 204, 238}, {150, 85, 70},  {17, 119, 51},  {204, 102, 119}, {221, 204, 119}};
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

  std::vector<Index> worn(cluster_palette().size() - 1, 0);
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
      const auto least = static_cast<std::size_t>(std::ranges::min_element(worn) - worn.begin());
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

double threshold_of(const OverloadRule& rule) { return rule.threshold_factor * sine(rule.theta_c); }

Frame mapped_frame(Frame frame, const RunStatics& statics, double l_min) {
  return analysis::with_gamma_of_neighbourhoods(std::move(frame), statics, l_min * statics.mean_diameter);
}

analysis::Clusters overloaded_clusters(const BedFrame& bed, const OverloadRule& rule) {
  const double threshold = threshold_of(rule);
  std::vector<bool> overloaded(static_cast<std::size_t>(bed.statics.free_count));
  for (std::size_t i = 0; i < overloaded.size(); ++i)
    overloaded[i] = stress::is_overloaded(bed.frame.gamma[i], threshold);
  const auto links = rule.joined_by_neighbours ? analysis::neighbour_links(bed) : analysis::force_links(bed);
  return analysis::find_clusters(overloaded, links, bed.frame.x, analysis::period_of(bed.statics));
}

}  // namespace talus::pictures
