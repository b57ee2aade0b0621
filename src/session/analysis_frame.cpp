#include "session/analysis_frame.h"

#include <algorithm>
#include <cmath>

#include "analysis/clusters.h"
#include "analysis/coarse_graining.h"
#include "analysis/contact_network.h"
#include "analysis/fabric.h"
#include "analysis/free_grains.h"
#include "analysis/links.h"
#include "analysis/packing.h"
#include "analysis/pair_correlation.h"
#include "analysis/percolation.h"
#include "core/trigonometry.h"
#include "stress/overload.h"

namespace talus {
namespace {

constexpr double directions[] = {60.0, 120.0};  // deg; paper, section V B
constexpr double directed_within = 30.0;        // deg
constexpr double force_range[] = {1e-3, 20.0};  // mean normal forces
constexpr double largest_distance = 10.0;       // D, of pair correlations

double correlated_up_to(const RunStatics& statics) {
  return std::min(largest_distance * statics.mean_diameter, 0.5 * statics.length);
}

/// Of the bins of normal forces over their mean: the tail and the small ones span decades.
std::vector<double> force_edges(int bins) { return logarithmic_edges(force_range[0], force_range[1], bins); }

void set_edges(Analysis& analysis, const char* name, double highest) {
  const auto edges = values<double>(analysis, name);
  for (std::size_t i = 0; i < edges.size(); ++i)
    edges[i] = highest * static_cast<double>(i) / static_cast<double>(edges.size() - 1);
}

/// Where the rows number k of a record are filled.
struct FrameRows {
  Analysis& analysis;
  std::size_t k;

  void set(const char* name, double value) const { row<double>(analysis, name, k)[0] = value; }
  void set(const char* name, const std::vector<double>& numbers) const {
    std::ranges::copy(numbers, row<double>(analysis, name, k).begin());
  }
  /// Of threshold f.
  void set(const char* name, std::size_t f, double value) const { row<double>(analysis, name, k)[f] = value; }
  void count(const char* name, std::size_t f, Index value) const { row<Index>(analysis, name, k)[f] = value; }
};

void analyse_packing(const Frame& frame, const RunStatics& statics, int sections, const FrameRows& rows) {
  const double volume = frame_volume(frame, statics);
  const PackingStress stress = packing_stress(frame, statics, volume);
  const Tensor2& sigma = stress.sigma;
  rows.set("packing/volume", volume);
  rows.set("packing/bulk_solid_fraction", bulk_solid_fraction(frame, statics, volume));
  rows.set("packing/stress", {sigma.xx, sigma.xy, sigma.yx, sigma.yy});
  rows.set("packing/sigma_t_over_n", stress.shear_over_normal);
  rows.set("packing/stress_ratio", stress.state.ratio);
  std::vector<double> along;
  for (const Tensor2& section : section_stresses(frame, statics, volume, sections))
    along.push_back(section.xx);
  rows.set("sections/sigma_xx", along);
}

void analyse_gamma(const Frame& frame, const RunStatics& statics, int bins, const FrameRows& rows) {
  const Histogram histogram = stress_ratio_distribution(frame, statics, bins);
  double sum = 0.0;
  for (const double gamma : of_free_grains(frame.gamma, statics))
    if (!std::isnan(gamma)) sum += gamma;
  rows.set("gamma/density", histogram.density());
  rows.set("gamma/error", histogram.error());
  rows.set("gamma/mean", sum / histogram.total);
  rows.set("gamma/share_above_one", histogram.outside / histogram.total);
}

/// Angles of contact normals come in degrees.
void analyse_directions(const Frame& frame, int bins, const FrameRows& rows) {
  const auto per_radian = [](std::vector<double> densities) {
    for (double& density : densities) density = degrees(density);
    return densities;
  };
  rows.set("contacts/direction_density", per_radian(normal_directions(frame, bins, false).density()));
  rows.set("contacts/direction_density_by_force", per_radian(normal_directions(frame, bins, true).density()));
  std::vector<double> peaks;
  for (const double peak : direction_peaks(frame)) peaks.push_back(radians(peak));
  rows.set("contacts/direction_peak", peaks);
  const FabricComponent second = fabric_component(frame, 2), sixth = fabric_component(frame, 6);
  rows.set("contacts/fabric_amplitude", {second.amplitude, sixth.amplitude});
  rows.set("contacts/fabric_angle", {radians(second.angle), radians(sixth.angle)});
}

void analyse_contacts(const Frame& frame, const RunStatics& statics, int bins, const FrameRows& rows) {
  const Coordination z = coordination(frame, statics);
  rows.set("contacts/coordination_number", z.carrying);
  rows.set("contacts/coordination_number_of_all", z.all);
  rows.set("contacts/coordination_number_without_rattlers", z.without_rattlers);
  rows.set("contacts/rattler_fraction", z.rattler_fraction);
  const Networks network = networks(frame, statics);
  rows.set("contacts/mean_normal_force", network.mean_normal_force);
  rows.set("contacts/force_density", normal_forces(frame, Histogram(force_edges(bins))).density());
  rows.set("contacts/mobilisation_density", mobilised_friction(frame, statics, bins).density());
  rows.set("contacts/strong_share", network.strong_share);
  rows.set("contacts/strong_share_of_mean_stress", network.strong_share_of_mean);
  rows.set("contacts/strong_share_of_deviator", network.strong_share_of_deviator);
  rows.set("contacts/strong_stress_ratio", network.strong_ratio);
  rows.set("contacts/weak_stress_ratio", network.weak_ratio);
  const CriticalContacts critical = critical_contacts(frame, statics);
  rows.set("contacts/critical_share", critical.share);
  rows.count("contacts/critical_largest", 0, critical.largest_cluster);
  rows.set("contacts/critical_correlation_length", critical.correlation_length);
}

void analyse_correlations(const Frame& frame, const RunStatics& statics, int bins, const FrameRows& rows) {
  const double largest = correlated_up_to(statics);
  rows.set("correlation/normal_force", force_correlation(frame, statics, largest, bins).value);
  rows.set("correlation/gamma", stress_ratio_correlation(frame, statics, largest, bins).value);
  rows.set("correlation/mean_stress", mean_stress_correlation(frame, statics, largest, bins).value);
}

void analyse_coarse_graining(const Frame& frame, const RunStatics& statics,
                             const AnalysisParameters& parameters, std::size_t f, const FrameRows& rows) {
  const CoarseGraining lc = coarse_graining(frame, statics,
                                            {.threshold = values<double>(rows.analysis, "threshold")[f],
                                             .end_ratio = values<double>(rows.analysis, "lc/end_ratio")[f],
                                             .l_min = parameters.l_min * statics.mean_diameter,
                                             .cut = values<double>(rows.analysis, "lc/cut")[0]});
  const auto lengths = row<float>(rows.analysis, "lc/length", rows.k);
  std::ranges::transform(lc.length, lengths.begin() + static_cast<std::ptrdiff_t>(f * statics.radius.size()),
                         [](double length) { return static_cast<float>(length); });
  rows.set("lc/mean", f, lc.mean);
  rows.set("lc/error", f, lc.standard_error);
  rows.set("lc/max", f, lc.overloaded > 0 ? lc.largest : std::nan(""));
  rows.set("lc/share_cut", f, static_cast<double>(lc.cut_off) / lc.overloaded);
}

/// What clusters of any threshold are made of.
struct ClusterGround {
  std::vector<Link> links;
  BedEdges edges;
};

void analyse_directed(const Frame& frame, const RunStatics& statics, const std::vector<bool>& overloaded,
                      const ClusterGround& ground, std::size_t f, const FrameRows& rows) {
  const double height = row<double>(rows.analysis, "packing/volume", rows.k)[0] / statics.length;
  for (std::size_t d = 0; d < std::size(directions); ++d) {
    const DirectedPaths paths = directed_paths(frame, statics, overloaded, ground.links, ground.edges,
                                               radians(directions[d]), radians(directed_within));
    const std::size_t place = f * std::size(directions) + d;
    rows.count("clusters/directed_spans", place, paths.spans ? 1 : 0);
    rows.set("clusters/directed_height", place, paths.height / height);
  }
}

void analyse_clusters(const Frame& frame, const RunStatics& statics, const std::vector<bool>& overloaded,
                      const ClusterGround& ground, std::size_t f, const FrameRows& rows) {
  const Clusters clusters = find_clusters(overloaded, ground.links, frame.x, period_of(statics));
  const auto labels = row<Index>(rows.analysis, "clusters/label", rows.k)
                          .subspan(f * statics.radius.size(), statics.radius.size());
  std::ranges::fill(labels, -1);
  std::ranges::copy(clusters.label, labels.begin());
  const Index largest = clusters.count() > 0 ? clusters.size.front() : 0;
  const Spanning spanning = find_spanning(clusters, ground.edges);
  rows.count("clusters/count", f, clusters.count());
  rows.count("clusters/largest", f, largest);
  rows.set("clusters/largest_share", f, static_cast<double>(largest) / clusters.members);
  rows.set("clusters/mean", f, mean_size(clusters));
  rows.set("clusters/second_moment", f, second_moment(clusters));
  rows.set("clusters/second_moment_of_others", f, second_moment_of_others(clusters));
  rows.count("clusters/spans_depth", f, spanning.floor_to_surface >= 0 ? 1 : 0);
  rows.count("clusters/spans_length", f, spanning.across >= 0 ? 1 : 0);
}

}  // namespace

void set_axes(const RunStatics& statics, const AnalysisParameters& parameters, Analysis& analysis) {
  set_edges(analysis, "sections/edge", statics.length);
  set_edges(analysis, "gamma/edge", 1.0);
  set_edges(analysis, "contacts/direction_edge", radians(180.0));
  std::ranges::copy(force_edges(parameters.bins), values<double>(analysis, "contacts/force_edge").begin());
  set_edges(analysis, "contacts/mobilisation_edge", 1.0);
  const auto distance = values<double>(analysis, "correlation/distance");
  for (std::size_t b = 0; b < distance.size(); ++b)
    distance[b] = correlated_up_to(statics) * (static_cast<double>(b) + 0.5) / parameters.bins;
  const auto direction = values<double>(analysis, "clusters/direction");
  std::ranges::transform(directions, direction.begin(), radians);
}

void analyse_frame(const Frame& frame, const RunStatics& statics, const AnalysisParameters& parameters,
                   std::size_t k, Analysis& analysis) {
  const FrameRows rows{analysis, k};
  analyse_packing(frame, statics, parameters.sections, rows);
  analyse_gamma(frame, statics, parameters.bins, rows);
  analyse_directions(frame, parameters.bins, rows);
  analyse_contacts(frame, statics, parameters.bins, rows);
  analyse_correlations(frame, statics, parameters.bins, rows);
  if (analysis.sizes.at('F') == 0) return;
  const auto thresholds = values<double>(analysis, "threshold");
  const ClusterGround ground = {
      parameters.joining == Joining::contacts ? force_links(frame, statics) : neighbour_links(frame, statics),
      bed_edges(frame, statics)};
  for (std::size_t f = 0; f < thresholds.size(); ++f) {
    const OverloadCount count = count_overloaded(frame, statics, thresholds[f]);
    rows.set("overloaded/fraction", f, count.fraction());
    rows.set("overloaded/fraction_of_all", f, static_cast<double>(count.overloaded) / statics.free_count);
    std::vector<bool> overloaded;
    for (const double gamma : of_free_grains(frame.gamma, statics))
      overloaded.push_back(is_overloaded(gamma, thresholds[f]));
    analyse_coarse_graining(frame, statics, parameters, f, rows);
    analyse_clusters(frame, statics, overloaded, ground, f, rows);
    analyse_directed(frame, statics, overloaded, ground, f, rows);
  }
}

}  // namespace talus
