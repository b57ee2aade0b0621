#pragma once
/// The recipes of all figures (catalogue.h), and the steps of theirs that tests look at. Each makes its
/// figure of groups of runs; no value where there is no run of the kind that it needs. `at`: the frames that
/// it shows instead of those named here.

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
// The mean stress of the packing over its tilt (paper, section IV).
/// sigma_T / sigma_N over tan(theta), of all groups (paper, Fig. 4).
std::optional<Figure> shear_stress_figure(std::span<const RunGroup> groups);

/// Gamma over sin(theta), of all groups (paper, Fig. 5).
std::optional<Figure> stress_ratio_figure(std::span<const RunGroup> groups);

// overload_figures.cpp
// Overloaded grains of periodic beds over tilt (paper, section V).
/// Probability density of gamma at 0, 10 and 15 deg (paper, Fig. 8).
std::optional<Figure> gamma_density_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

/// p_o over tilt, for each threshold (paper, Fig. 9).
std::optional<Figure> overloaded_fraction_figure(std::span<const RunGroup> groups);

/// Mean and largest l_c over tilt, for each threshold (paper, Fig. 12).
std::optional<Figure> length_figure(std::span<const RunGroup> groups);

/// p_o over the size of neighbourhoods, at 0 and 15 deg and just before failure.
std::optional<Figure> overload_scale_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

// map_panels.cpp
// Maps of a bed at growing tilt, one below the other (paper, Figs. 10 and 13).
/// The frames nearest to 0, 5, 10 and 15 deg, those of them that are there and come before theta_c (rad),
/// and the last one before theta_c. `tilts` as in frames_at.
pictures::FrameChoice panel_frames(const std::vector<double>& tilts, double theta_c);

/// Paper, Fig. 10: gamma in gray, of the first run that has failed.
std::optional<Figure> gamma_maps(std::span<const RunGroup> groups, const FrameWords& at = {});

/// Paper, Fig. 13: overloaded grains in black, of the same run; a column for each threshold.
std::optional<Figure> overload_maps(std::span<const RunGroup> groups, const FrameWords& at = {});

// neighbourhoods_figure.cpp
// Growing neighbourhoods of one overloaded grain (paper, Fig. 11).
/// The grain whose l_c are nearest to their means: with the smallest sum over the thresholds of
/// |l_c / mean - 1|, of the free grains that are overloaded at each of them and lie in the middle half of the
/// bed's height, and of its length between walls; of equal ones that with the smallest id. No value where
/// there is none. `thresholds`: those of the frame.
std::optional<Index> typical_grain(const BedFrame& bed, std::span<const analysis::FrameThreshold> thresholds);

/// The free grains with centres within `distance` (m) of that of a grain, in a periodic bed their nearest
/// images: x and y from that grain, and radius, in D, and gamma.
Table grains_around(const BedFrame& bed, Index centre, double distance);

/// Paper, Fig. 11: a grain that is overloaded at 10 deg, or at the nearest tilt before failure at which one
/// is, with circles about it, and gamma_l over l.
std::optional<Figure> neighbourhoods_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

// volume_strain_figure.cpp
// Volume of periodic beds over tilt, and theta_d by each estimator (paper, section VI).
/// Volume strain over tilt, from the free surface and from the centre of mass (paper, Fig. 14).
std::optional<Figure> volume_strain_figure(std::span<const RunGroup> groups);

// wall_figures.cpp
// What walls do to the stress of a bed (paper, section IV).
/// sigma_xx over x of the shortest bed between walls, at 0 and 10 deg and before failure (paper, Fig. 6).
std::optional<Figure> wall_stress_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

/// (sigma_T / sigma_N) / tan(theta) at failure over L, of all beds between walls, with the law of Eq. 15
/// (paper, Fig. 7).
std::optional<Figure> wall_ratio_figure(std::span<const RunGroup> groups);

// angle_figures.cpp
// The angles at which something happens in a run, over the runs of an ensemble: how they are distributed,
// and how they go together.
/// Bins of equal width, and where the first of them begins.
struct HistogramBins {
  double first = 0.0, width = 0.0;
  std::size_t count = 0;
};

/// Bins for these values, of which at least one is a number: about as wide as Freedman and Diaconis (1981)
/// have them, 2 IQR n^(-1/3), but a round number; an empty one on either side.
HistogramBins bins_for(const std::vector<double>& values);

/// The histogram of each angle, with mean, standard error, median and number.
std::optional<Figure> angle_distributions(std::span<const RunGroup> groups);

/// Each angle over each other one, with Pearson's coefficient; theta_d at the first threshold only.
std::optional<Figure> angle_correlations(std::span<const RunGroup> groups);

// contact_figures.cpp
// Distributions and correlations of contacts and forces, at the start of the tilt and before failure, as
// means over the runs of the first group that has failed.
/// Means over runs, element by element, of what frame frames[r] of run r has, with their standard errors:
/// the columns NAME and NAME_error. All are of the same length.
std::vector<Column> row_means(const RunChoice& runs, std::span<const std::size_t> frames,
                              std::vector<double> analysis::FrameRecord::*member, Column mean);

/// Polar histogram of the directions of contact normals, each contact counted once, and weighted by f_n.
std::optional<Figure> contact_directions(std::span<const RunGroup> groups, const FrameWords& at = {});
/// Probability density of the normal forces over their mean.
std::optional<Figure> force_distribution(std::span<const RunGroup> groups, const FrameWords& at = {});
/// Correlation of normal forces, of gamma and of the mean stress of grains, over distance.
std::optional<Figure> correlations(std::span<const RunGroup> groups, const FrameWords& at = {});
/// Fabric of the weak contacts along the strong ones, over their mobilised friction.
std::optional<Figure> weak_contacts_figure(std::span<const RunGroup> groups, const FrameWords& at = {});

// force_chains.cpp
// Pictures of the contacts of a bed just before it fails: their forces, and where friction is fully
// mobilised.
/// Contacts as lines (contact_lines.h), in D, with f_n over its mean, the smallest first, and whether their
/// friction is fully mobilised. Coordinates are rounded to 1e-4 D.
Table force_table(const BedFrame& bed);

/// The force chains of the first run that has failed, at its last frame before theta_c.
std::optional<Figure> force_chains(std::span<const RunGroup> groups, const FrameWords& at = {});

/// Share, largest cluster and correlation length of the critical contacts over theta, as means over the runs
/// of each group, and where they are in the same frame of the same run.
std::optional<Figure> critical_contacts_figure(std::span<const RunGroup> groups);

// quantity_figures.cpp
// Every quantity of frames that has a title, in a panel of its own: all groups over each other, and the
// difference of two.
/// Means over the tilt, and over theta_c - theta. What depends on the threshold is that at the first one.
std::optional<Figure> quantities_over_tilt(std::span<const RunGroup> groups);
std::optional<Figure> quantities_before_failure(std::span<const RunGroup> groups);

/// Of these, those of the contacts that tell how far failure is, over theta_c - theta.
std::optional<Figure> precursors_figure(std::span<const RunGroup> groups);

/// The means of the second group less those of the first, with the errors of both, at the angles that both
/// have; nothing unless there are two groups.
std::optional<Figure> differences_over_tilt(std::span<const RunGroup> groups);
std::optional<Figure> differences_before_failure(std::span<const RunGroup> groups);

// cycles_figure.cpp
// A bed whose tilt goes up and down: loops over the tilt, and what is left of each cycle.
/// A cycle of a course of the tilt: from one place where the tilt begins to rise to the next.
struct TiltCycle {
  std::size_t first = 0;  ///< its first place, which is the last one of the cycle before it
  std::size_t last = 0;
  std::size_t top = 0;     ///< the last of its places with the highest tilt
  bool is_closed = false;  ///< the tilt has fallen after the top
};

/// The cycles of tilts in the order of time. A tilt that only falls, or is held, is one cycle as well; none
/// for no tilts.
std::vector<TiltCycle> cycles_of(std::span<const double> tilts);

/// Of the first group whose runs have a programme of the tilt, and files; nothing where there is none.
std::optional<Figure> cycles_figure(std::span<const RunGroup> groups);

// dynamic_angle.cpp
// The dynamic angle of repose beside the angles that the paper expects it at.
/// Angle at rest of each run over its theta_c and its theta_d by each estimator, and the first of these runs
/// over time. No value where no flow was followed until it stopped (tilt.after_failure).
std::optional<Figure> dynamic_angle_figure(std::span<const RunGroup> groups);

/// One run over time from shortly before failure on: tilt, and mean velocity of the surface layer between two
/// rows of observables.
Table flow_trace(const runs::RunView& run);

// event_figure.cpp
// Rearrangements on the way to failure.
/// Of the runs of each group together: their sizes and waiting angles with the laws of maximum likelihood,
/// and how large each is, and how it changes the volume, over the tilt. No value without a rearrangement.
std::optional<Figure> event_figure(std::span<const RunGroup> groups);

// persistence_figure.cpp
// How the network of contact forces hangs together, and how that changes over tilt.
/// Of one bed: the persistence diagrams of its force network at the start and just before failure, and over
/// tilt the total persistence and the distance of the diagrams of each two frames in a row.
std::optional<Figure> persistence_figure(std::span<const RunGroup> groups);

}  // namespace talus::figures
