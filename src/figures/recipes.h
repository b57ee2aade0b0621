#pragma once
/// Functions that make each figure of the catalogue (catalogue.h), and those of their steps that are tested.
/// Each makes its figure from groups of runs and returns no value if there is no run of the required kind.
/// `at`: frames to show instead of those named here.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/bed_frame.h"
#include "figures/figure.h"
#include "figures/group_table.h"
#include "figures/run_angles.h"
#include "figures/run_group.h"
#include "figures/shown_frames.h"
#include "pictures/frame_choice.h"

namespace talus::figures {

// packing_stress_figures.cpp
// Mean stress of the packing as a function of tilt (paper, section IV).
/// Plots sigma_T / sigma_N over tan(theta), for all groups (paper, Fig. 4).
std::optional<Figure> shear_stress_figure(std::span<const RunGroup> groups);

/// Plots Gamma over sin(theta), for all groups (paper, Fig. 5).
std::optional<Figure> stress_ratio_figure(std::span<const RunGroup> groups);

// overload_figures.cpp
// Overloaded grains of periodic beds as a function of tilt (paper, section V).
/// Plots the probability density of gamma at 0, 10 and 15 deg (paper, Fig. 8).
std::optional<Figure> gamma_density_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

/// Plots p_o over tilt, for each threshold (paper, Fig. 9).
std::optional<Figure> overloaded_fraction_figure(std::span<const RunGroup> groups);

/// Plots the mean and largest l_c over tilt, for each threshold (paper, Fig. 12).
std::optional<Figure> length_figure(std::span<const RunGroup> groups);

/// Plots p_o over the size of neighbourhoods, at 0 and 15 deg and just before failure.
std::optional<Figure> overload_scale_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

// map_panels.cpp
// Maps of a bed at increasing tilt, one below the other (paper, Figs. 10 and 13).
/// Returns the available frames nearest to 0, 5, 10 and 15 deg that come before theta_c (rad), and the last
/// frame before theta_c. `tilts` as in frames_at.
pictures::FrameChoice panel_frames(const std::vector<double>& tilts, double theta_c);

/// Shows maps of gamma in gray for the first run that has failed (paper, Fig. 10).
std::optional<Figure> gamma_maps(std::span<const RunGroup> groups, const FrameWords& at = {});

/// Shows maps of the overloaded grains in black for the same run, with a column for each threshold (paper,
/// Fig. 13).
std::optional<Figure> overload_maps(std::span<const RunGroup> groups, const FrameWords& at = {});

// neighbourhoods_figure.cpp
// Growing neighbourhoods of one overloaded grain (paper, Fig. 11).
/// Returns the grain whose l_c are closest to their means, that is, with the smallest sum over the thresholds
/// of |l_c / mean - 1|. Candidates are the free grains that are overloaded at each threshold and lie in the
/// middle half of the height of the bed, and between walls also of its length. Of equal grains, that with the
/// smallest id counts. Returns no value without candidates. `thresholds`: those of the frame.
std::optional<Index> typical_grain(const BedFrame& bed, std::span<const analysis::FrameThreshold> thresholds);

/// Returns the free grains with centres within `distance` (m) of that of a grain, in a periodic bed with
/// their nearest images: x and y relative to that grain and the radius, in D, and gamma.
Table grains_around(const BedFrame& bed, Index centre, double distance);

/// Shows a grain that is overloaded at 10 deg, or at the nearest tilt before failure at which such a grain
/// exists, with circles about it, and gamma_l over l (paper, Fig. 11).
std::optional<Figure> neighbourhoods_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

// volume_strain_figure.cpp
// Volume of periodic beds as a function of tilt, and theta_d by each estimator (paper, section VI).
/// Plots the volume strain over tilt, from the free surface and from the centre of mass (paper, Fig. 14).
std::optional<Figure> volume_strain_figure(std::span<const RunGroup> groups);

// wall_figures.cpp
// Effect of walls on the stress of a bed (paper, section IV).
/// Plots sigma_xx over x in the shortest bed between walls, at 0 and 10 deg and before failure (paper, Fig.
/// 6).
std::optional<Figure> wall_stress_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

/// Plots (sigma_T / sigma_N) / tan(theta) at failure over L, for all beds between walls, with the law of Eq.
/// 15 (paper, Fig. 7).
std::optional<Figure> wall_ratio_figure(std::span<const RunGroup> groups);

// angle_distributions.cpp and angle_correlations.cpp
// Characteristic angles of the runs of an ensemble: their distributions and correlations.
/// Bins of equal width, and the lower edge of the first.
struct HistogramBins {
  double first = 0.0, width = 0.0;
  std::size_t count = 0;
};

/// Returns bins for values of which at least one is a number. The width follows Freedman and Diaconis (1981),
/// 2 IQR n^(-1/3), rounded to a round number; there is one empty bin on either side.
HistogramBins bins_for(const std::vector<double>& values);

/// Plots a histogram of each angle, with mean, standard error, median and number.
std::optional<Figure> angle_distributions(std::span<const RunGroup> groups);

/// Plots each angle over every other angle, with Pearson's coefficient; theta_d is shown at the first
/// threshold only.
std::optional<Figure> angle_correlations(std::span<const RunGroup> groups);

// contact_figures.cpp
// Distributions and correlations of contacts and forces, at the start of the tilt and before failure, as
// means over the runs of the first group that has failed.
/// Returns element-wise means over the runs of the values in frame frames[r] of run r, with their standard
/// errors: the columns NAME and NAME_error. All lists must have the same length.
std::vector<Column> row_means(const RunChoice& runs, std::span<const std::size_t> frames,
                              std::vector<double> analysis::FrameRecord::*member, Column mean);

/// Plots a polar histogram of the directions of contact normals, with each contact counted once and weighted
/// by f_n.
std::optional<Figure> contact_directions(std::span<const RunGroup> groups, const FrameWords& at = {});
/// Plots the probability density of the normal forces over their mean.
std::optional<Figure> force_distribution(std::span<const RunGroup> groups, const FrameWords& at = {});
/// Plots the correlation of normal forces, of gamma and of the mean stress of grains, over distance.
std::optional<Figure> correlations(std::span<const RunGroup> groups, const FrameWords& at = {});
/// Plots the fabric of the weak contacts along the strong ones, over their mobilised friction.
std::optional<Figure> weak_contacts_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

// force_chains.cpp
// Pictures of the contacts of a bed just before failure: their forces, and the contacts with fully mobilised
// friction.
/// Returns the contacts as lines (contact_lines.h), in D, with f_n over its mean in ascending order, and
/// whether friction is fully mobilised. Coordinates are rounded to 1e-4 D.
Table force_table(const BedFrame& bed);

/// Shows the force chains of the first run that has failed, at its last frame before theta_c.
std::optional<Figure> force_chains(std::span<const RunGroup> groups, const FrameWords& at = {});

/// Plots the share, largest cluster and correlation length of the critical contacts over theta, as means over
/// the runs of each group, and their positions in the same frame of the same run.
std::optional<Figure> critical_contacts_figure(std::span<const RunGroup> groups);

// quantity_figures.cpp
// All titled quantities of frames, each in its own panel: all groups together, and the difference of two
// groups.
/// Plots means over the tilt, and over theta_c - theta. Quantities that depend on the threshold are shown at
/// the first one.
std::optional<Figure> quantities_over_tilt(std::span<const RunGroup> groups);
std::optional<Figure> quantities_before_failure(std::span<const RunGroup> groups);

/// Plots the quantities of the contacts that indicate the distance to failure, over theta_c - theta.
std::optional<Figure> precursors_figure(std::span<const RunGroup> groups);

/// Plots the means of the second group minus those of the first, with the errors of both, at the angles that
/// both have; no value unless there are exactly two groups.
std::optional<Figure> differences_over_tilt(std::span<const RunGroup> groups);
std::optional<Figure> differences_before_failure(std::span<const RunGroup> groups);

// cycles_figure.cpp
// A bed whose tilt rises and falls: loops over the tilt, and the residual change after each cycle.
/// A cycle of a tilt history, from one place where the tilt begins to rise to the next.
struct TiltCycle {
  std::size_t first = 0;  ///< first index, which is the last index of the preceding cycle
  std::size_t last = 0;
  std::size_t top = 0;     ///< last index with the highest tilt of the cycle
  bool is_closed = false;  ///< whether the tilt has fallen after the top
};

/// Returns the cycles of tilts in the order of time. A tilt that only falls or is held is one cycle; there is
/// none without tilts.
std::vector<TiltCycle> cycles_of(std::span<const double> tilts);

/// Plots the cycles of the first group whose runs have a tilt programme and files; no value without such a
/// group.
std::optional<Figure> cycles_figure(std::span<const RunGroup> groups);

// dynamic_angle.cpp
// Comparison of the dynamic angle of repose with the angles that the paper expects it to equal.
/// Plots the angle at rest of each run over its theta_c and over its theta_d by each estimator, and the first
/// of these runs over time. No value if no flow was followed until it stopped (tilt.after_failure).
std::optional<Figure> dynamic_angle_figure(std::span<const RunGroup> groups);

/// Returns the history of one run from shortly before failure: tilt, and mean velocity of the surface layer
/// between two rows of observables.
Table flow_trace(const runs::RunView& run);

// event_figure.cpp
// Rearrangements before failure.
/// Plots the rearrangements of all runs of each group together: distributions of sizes and waiting angles
/// with their maximum-likelihood laws, and the size and volume change of each over the tilt. No value without
/// a rearrangement.
std::optional<Figure> event_figure(std::span<const RunGroup> groups);

// persistence_figure.cpp
// Connectivity of the network of contact forces, and its change with tilt.
/// Plots for one bed the persistence diagrams of the force network at the start and just before failure,
/// and, over the tilt, the total persistence and the distance between the diagrams of consecutive frames.
std::optional<Figure> persistence_figure(std::span<const RunGroup> groups);

}  // namespace talus::figures
