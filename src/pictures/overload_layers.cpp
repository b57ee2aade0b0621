#include <fmt/core.h>
#include <string>

#include "analysis/overload/percolation.h"
#include "pictures/layers.h"
#include "pictures/texts.h"
#include "stress/overload.h"

namespace talus::pictures {
namespace {

/// Shade of clusters that have no colour.
constexpr double uncoloured_shade = 0.4;

/// Returns "Γ_c" or "2Γ_c".
std::string threshold_symbol(const MapSettings& settings) {
  const double factor = settings.threshold_factor;
  return factor == 1.0 ? "Γ_c" : fmt::format("{:.6g}Γ_c", factor);
}

/// Returns "Γ_c = sin θ_c = 0.34" or "2Γ_c = 0.69".
std::string threshold_text(const MapSettings& settings) {
  return fmt::format("{} = {}{:.2f}", threshold_symbol(settings),
                     settings.threshold_factor == 1.0 ? "sin θ_c = " : "", threshold_of(settings));
}

render::Swatch disc_swatch(const render::Colour& fill, const render::Colour& rim, const std::string& label) {
  return {render::Swatch::Kind::disc, fill, rim, 0.0, label};
}

/// Returns a colour for each cluster.
std::vector<render::Colour> colours_of(std::span<const ClusterColour> cluster_colours,
                                       ClusterPalette chosen) {
  const std::vector<render::Colour> palette = cluster_palette(chosen);
  std::vector<render::Colour> colours;
  for (const ClusterColour& colour : cluster_colours)
    colours.push_back(colour.palette_index < 0
                          ? render::gray(uncoloured_shade)
                          : palette[static_cast<std::size_t>(colour.palette_index) % palette.size()]);
  return colours;
}

std::string clusters_title(const analysis::Clusters& clusters, const MapSettings& settings) {
  const std::string reading = ", " + reading_text(settings);
  if (clusters.count() == 0) return "No clusters of overloaded grains" + reading;
  const double share = 100.0 * clusters.size[0] / clusters.members;
  return fmt::format("{}{}{}; the largest has {:.0f} % of the overloaded grains", clusters.count(),
                     clusters.count() == 1 ? " cluster" : " clusters", reading, share);
}

/// Returns the legend of the marks of spanning clusters.
std::vector<render::Swatch> spanning_swatches(const analysis::SpanningClusters& spanning,
                                              std::span<const render::Colour> colours, bool periodic) {
  const std::string across = periodic ? "spans the period" : "spans wall to wall";
  const auto swatch = [&](Index cluster, const std::string& label) {
    const render::Colour& fill = colours[static_cast<std::size_t>(cluster)];
    return disc_swatch(fill, spanning_rim(fill), label);
  };
  std::vector<render::Swatch> swatches;
  const bool both = spanning.floor_to_surface >= 0 && spanning.floor_to_surface == spanning.across;
  if (spanning.floor_to_surface >= 0)
    swatches.push_back(
        swatch(spanning.floor_to_surface, both ? "spans floor to surface, and " + across.substr(6)
                                               : std::string("spans floor to surface")));
  if (spanning.across >= 0 && !both) swatches.push_back(swatch(spanning.across, across));
  return swatches;
}

/// Returns the look of each free grain: black if gamma >= threshold, otherwise white; with `over_grains`, a
/// mark in a grain that another layer fills.
std::vector<GrainStyle> overload_styles(const BedFrame& bed, double threshold, bool over_grains) {
  std::vector<GrainStyle> styles;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const bool overloaded = stress::is_overloaded(bed.frame.gamma[i], threshold);
    const render::Colour fill = overloaded ? render::black : render::white;
    styles.push_back({fill, over_grains ? render::white : rim_of(fill), overloaded});
  }
  return styles;
}

}  // namespace

MapLayer overloaded_layer(const MapFrame& bed, const MapSettings& settings, bool over_grains) {
  const double threshold = threshold_of(settings);
  const stress::OverloadCount count = stress::count_overloaded(bed, threshold);
  MapLayer layer;
  layer.title = settings.l_min > 0.0 ? "Overloaded grains, " + reading_text(settings)
                                     : "Overloaded " + reading_text(settings);
  if (count.loaded > 0) layer.title += fmt::format(", p_o = {:.3f}", count.fraction());
  layer.styles = overload_styles(bed, threshold, over_grains);
  layer.legend.swatches = {disc_swatch(render::black, render::black, "γ ≥ " + threshold_text(settings))};
  if (!over_grains)
    layer.legend.swatches.push_back(
        disc_swatch(render::white, rim_of(render::white), "γ < " + threshold_symbol(settings)));
  return layer;
}

MapLayer clusters_layer(const MapFrame& bed, const MapSettings& settings, bool over_grains) {
  const analysis::Clusters clusters = overloaded_clusters(bed, settings);
  const analysis::SpanningClusters spanning = analysis::find_spanning(clusters, analysis::bed_edges(bed));
  ClusterColours tracker = bed.tracker != nullptr ? *bed.tracker : ClusterColours();
  const std::vector<render::Colour> colours = colours_of(
      bed.cluster_colours.empty() ? tracker.next(clusters)
                                  : std::vector(bed.cluster_colours.begin(), bed.cluster_colours.end()),
      settings.palette);
  MapLayer layer;
  layer.title = clusters_title(clusters, settings);
  for (const Index label : clusters.label) {
    if (label < 0) {
      layer.styles.push_back(outline_style());
      continue;
    }
    const bool spans = label == spanning.floor_to_surface || label == spanning.across;
    const render::Colour fill = colours[static_cast<std::size_t>(label)];
    layer.styles.push_back({fill, spans ? spanning_rim(fill) : rim_of(fill)});
  }
  const GrainStyle other = outline_style();
  layer.legend.swatches = spanning_swatches(spanning, colours, bed.statics.periodic);
  layer.legend.swatches.push_back(
      disc_swatch(render::gray(uncoloured_shade), rim_of(render::gray(uncoloured_shade)),
                  fmt::format("fewer than {} grains", smallest_coloured_cluster)));
  if (!over_grains)
    layer.legend.swatches.push_back(disc_swatch(other.fill, other.rim, "γ < " + threshold_text(settings)));
  return layer;
}

}  // namespace talus::pictures
