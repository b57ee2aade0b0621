#include "analysis/frame_analysis.h"

#include <algorithm>
#include <cmath>

#include "analysis/contacts/contact_network.h"
#include "analysis/deformation/deformation.h"
#include "analysis/failure/failure_distance.h"
#include "analysis/free_grains.h"
#include "analysis/packing/packing.h"
#include "analysis/texture/texture.h"
#include "analysis/topology/topology.h"
#include "core/trigonometry.h"
#include "stress/stress.h"

namespace talus::analysis {
namespace {

constexpr std::array<double, 2> directions = {60.0, 120.0};  // deg; paper, section V B
constexpr double directed_within = 30.0;                     // deg
constexpr double force_range[] = {1e-3, 20.0};               // mean normal forces
constexpr double largest_network_threshold = 5.0;            // mean normal forces
constexpr double largest_distance = 10.0;                    // D, of pair correlations

double correlated_up_to(const RunStatics& statics) {
  return std::min(largest_distance * statics.mean_diameter, 0.5 * statics.length);
}

/// Returns edges of the bins of normal forces over their mean; both ends span decades.
std::vector<double> force_edges(int bins) { return logarithmic_edges(force_range[0], force_range[1], bins); }

void exclude_rattlers(int min_contacts, Index free_count, Frame& frame) {
  const std::vector<Index> contacts =
      stress::contacts_of_grains(frame.contacts.a, frame.contacts.b, free_count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(free_count); ++i)
    if (contacts[i] < min_contacts) frame.gamma[i] = not_known;
}

void measure_packing(const BedFrame& bed, int sections, FrameRecord& record) {
  record.volume = frame_volume(bed);
  record.bulk_solid_fraction = bulk_solid_fraction(bed, record.volume);
  measure_packing_stress(bed, record.volume, record);
  for (const Tensor2& section : section_stresses(bed, record.volume, sections))
    record.section_sigma_xx.push_back(section.xx);
}

void take_gamma(const BedFrame& bed, int bins, FrameRecord& record) {
  const Histogram histogram = stress_ratio_distribution(bed, bins);
  double sum = 0.0;
  for (const double gamma : free_grain_values(bed.frame.gamma, bed.statics))
    if (!std::isnan(gamma)) sum += gamma;
  record.gamma_density = histogram.density();
  record.gamma_error = histogram.error();
  record.gamma_mean = sum / histogram.total;
  record.gamma_share_above_one = histogram.outside / histogram.total;
}

/// Sets the directions of contact normals, converted from degrees to radians.
void take_directions(const Frame& frame, int bins, FrameRecord& record) {
  const auto per_radian = [](std::vector<double> densities) {
    for (double& density : densities) density = degrees(density);
    return densities;
  };
  record.direction_density = per_radian(normal_directions(frame, bins, false).density());
  record.direction_density_by_force = per_radian(normal_directions(frame, bins, true).density());
  std::ranges::transform(direction_peaks(frame), record.direction_peak.begin(), radians);
  const FabricComponent second = fabric_component(frame.contacts, 2),
                        sixth = fabric_component(frame.contacts, 6);
  record.fabric_amplitude = {second.amplitude, sixth.amplitude};
  record.fabric_angle = {radians(second.angle), radians(sixth.angle)};
}

void take_contacts(const BedFrame& bed, int bins, FrameRecord& record) {
  measure_coordination(bed, record);
  measure_networks(bed, record);
  measure_critical_contacts(bed, record);
  measure_failure_distance(bed, record.volume / bed.statics.length, record);
  measure_rigid_clusters(bed, record);
  measure_texture(bed, record);
  record.force_density = normal_forces(bed.frame, Histogram(force_edges(bins))).density();
  record.mobilisation_density = mobilised_friction(bed, bins).density();
}

void take_correlations(const BedFrame& bed, int bins, FrameRecord& record) {
  const double largest = correlated_up_to(bed.statics);
  record.normal_force_correlation = force_correlation(bed, largest, bins).value;
  record.gamma_correlation = stress_ratio_correlation(bed, largest, bins).value;
  record.mean_stress_correlation = mean_stress_correlation(bed, largest, bins).value;
}

/// Input of the search for clusters that is common to all thresholds.
struct ClusterGround {
  std::vector<Link> links;
  BedEdges edges;
};

void take_directed(const BedFrame& bed, const std::vector<bool>& overloaded, const ClusterGround& ground,
                   double height, FrameThreshold& record) {
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const DirectedPaths paths = directed_paths(bed, overloaded, ground.links, ground.edges,
                                               radians(directions[d]), radians(directed_within));
    record.directed_spans[d] = paths.spans ? 1 : 0;
    record.directed_height[d] = paths.height / height;
  }
}

/// Returns the record at one threshold. `height`: mean height of the bed, m.
FrameThreshold analyse_threshold(const BedFrame& bed, const CoarseGrainingRule& rule,
                                 const ClusterGround& ground, double height) {
  FrameThreshold record;
  measure_overloaded(stress::count_overloaded(bed, rule.threshold), bed.statics, record);
  const CoarseGraining lengths = coarse_graining(bed, rule);
  measure_lengths(lengths, record);
  record.lc.assign(bed.statics.radius.size(), std::numeric_limits<float>::quiet_NaN());
  std::ranges::transform(lengths.length, record.lc.begin(),
                         [](double length) { return static_cast<float>(length); });
  std::vector<bool> overloaded;
  for (const double gamma : free_grain_values(bed.frame.gamma, bed.statics))
    overloaded.push_back(stress::is_overloaded(gamma, rule.threshold));
  const Clusters clusters = find_clusters(overloaded, ground.links, bed.frame.x, period_of(bed.statics));
  measure_clusters(clusters, ground.edges, record);
  record.cluster.assign(bed.statics.radius.size(), -1);
  std::ranges::copy(clusters.label, record.cluster.begin());
  take_directed(bed, overloaded, ground, height, record);
  return record;
}

}  // namespace

Frame with_analysed_gamma(Frame frame, const RunStatics& statics, const AnalysisParameters& parameters) {
  if (parameters.min_contacts > 1) exclude_rattlers(parameters.min_contacts, statics.free_count, frame);
  return with_gamma_of_neighbourhoods(std::move(frame), statics, parameters.l_min * statics.mean_diameter);
}

void measure_overloaded(const stress::OverloadCount& count, const RunStatics& statics,
                        FrameThreshold& record) {
  record.overloaded_fraction = count.fraction();
  record.overloaded_fraction_of_all = static_cast<double>(count.overloaded) / statics.free_count;
}

void measure_lengths(const CoarseGraining& lengths, FrameThreshold& record) {
  record.lc_mean = lengths.mean;
  record.lc_error = lengths.standard_error;
  record.lc_max = lengths.largest;
  record.lc_share_cut = static_cast<double>(lengths.cut_off) / lengths.overloaded;
}

void measure_clusters(const Clusters& clusters, const BedEdges& edges, FrameThreshold& record) {
  const SpanningClusters spanning = find_spanning(clusters, edges);
  record.cluster_count = clusters.count();
  record.largest_cluster = largest_size(clusters);
  record.largest_share = largest_share(clusters);
  record.mean_cluster = mean_size(clusters);
  record.second_moment = second_moment(clusters);
  record.second_moment_of_others = second_moment_of_others(clusters);
  record.spans_depth = spanning.floor_to_surface >= 0 ? 1 : 0;
  record.spans_length = spanning.across >= 0 ? 1 : 0;
}

Analysis begin_analysis(const RunStatics& statics, const AnalysisParameters& parameters, double theta_c) {
  Analysis analysis;
  analysis.theta_c = theta_c;
  analysis.gamma_c = parameters.gamma_c.value_or(std::isnan(theta_c) ? not_known : sine(theta_c));
  analysis.lc_cut = length_cut(statics, parameters.l_min, parameters.lc_cut);
  if (!std::isnan(analysis.gamma_c))
    for (const double factor : parameters.threshold_factors)
      analysis.thresholds.push_back({.factor = factor,
                                     .gamma = factor * analysis.gamma_c,
                                     .end_ratio = parameters.lc_factor.value_or(factor) * analysis.gamma_c});
  const int bins = parameters.bins;
  analysis.section_edge = equal_edges(0.0, statics.length, parameters.sections);
  analysis.layer_edge = equal_edges(0.0, 1.0, critical_layers);
  analysis.gamma_edge = equal_edges(0.0, 1.0, bins);
  analysis.direction_edge = equal_edges(0.0, radians(180.0), bins);
  analysis.force_edge = force_edges(bins);
  analysis.mobilisation_edge = equal_edges(0.0, 1.0, bins);
  for (int b = 0; b < bins; ++b) analysis.network_threshold.push_back(largest_network_threshold * b / bins);
  for (int b = 0; b < bins; ++b)
    analysis.correlation_distance.push_back(correlated_up_to(statics) * (static_cast<double>(b) + 0.5) /
                                            bins);
  std::ranges::transform(directions, analysis.direction.begin(), radians);
  return analysis;
}

std::vector<FrameThreshold> analyse_thresholds(const BedFrame& bed, const AnalysisParameters& parameters,
                                               const Analysis& analysis, double volume) {
  std::vector<FrameThreshold> records;
  if (analysis.thresholds.empty()) return records;
  const bool by_contact = parameters.joining == Joining::contacts;
  const ClusterGround ground = {by_contact ? force_links(bed) : neighbour_links(bed), bed_edges(bed)};
  for (const RunThreshold& threshold : analysis.thresholds)
    records.push_back(analyse_threshold(bed,
                                        {.threshold = threshold.gamma,
                                         .end_ratio = threshold.end_ratio,
                                         .l_min = parameters.l_min * bed.statics.mean_diameter,
                                         .cut = analysis.lc_cut},
                                        ground, volume / bed.statics.length));
  return records;
}

FrameRecord analyse_frame(const BedFrame& bed, const AnalysisParameters& parameters,
                          const Analysis& analysis) {
  FrameRecord record;
  record.tilt = bed.frame.tilt;
  measure_packing(bed, parameters.sections, record);
  take_gamma(bed, parameters.bins, record);
  take_directions(bed.frame, parameters.bins, record);
  take_contacts(bed, parameters.bins, record);
  measure_weak_contacts(bed, analysis.mobilisation_edge, record);
  take_correlations(bed, parameters.bins, record);
  measure_local_solid_fraction(bed, record);
  measure_granular_temperature(bed, record);
  record.thresholds = analyse_thresholds(bed, parameters, analysis, record.volume);
  return record;
}

}  // namespace talus::analysis
