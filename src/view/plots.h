#pragma once
/// The curves beside the map.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quantities.h"
#include "core/bed_frame.h"
#include "core/observables.h"
#include "core/snapshot.h"
#include "view/frame_values.h"

namespace talus::view {

/// What the curves of a run are over.
enum class PlotAxis { tilt, angle_left, time };

/// The axis, and what places on it depend on.
struct PlotAbscissa {
  PlotAxis axis = PlotAxis::tilt;
  double theta_c = not_known;  ///< rad; without it there is no angle_left
};

/// theta or theta_c - theta in deg, or t in s: where a tilt (rad) and a time (s) are.
double place_on(const PlotAbscissa& abscissa, double tilt, double time);
/// Rich text: "θ_c − θ in °".
std::string title_of(PlotAxis axis);

/// Places on the axis of the run that all its plots mark.
struct PlotMarks {
  std::optional<double> shown;    ///< of the frame shown
  std::optional<double> theta_c;  ///< dashed
  std::vector<double> ticks{};    ///< short ones, up from the axis: rearrangements
};

/// What stands behind a curve: the same of another run, or the mean of an ensemble.
struct GhostCurve {
  std::vector<double> x, mean;
  std::vector<double> deviation;  ///< standard deviation over the runs; NaN where there is one
};

/// One curve along the run, and what is known of it.
struct PlotSeries {
  std::string name;                                           ///< "p_o": short, for the legend
  std::vector<double> x, y;                                   ///< places on the axis; NaN where there is none
  bool law = false;                                           ///< what theory says, beside what was measured
  std::optional<analysis::Quantity> quantity = std::nullopt;  ///< what it shows, where the table has it
  GhostCurve behind{};                                        ///< empty where nothing is
};

/// A plot beside the map: curves along the run, or over what else `x_title` says.
struct Plot {
  std::string name;       ///< "stress", "overloaded", ...: also the name of its widget
  std::string title;      ///< "Γ = Q/P, σ_T/σ_N"
  std::string x_title;    ///< "θ in °"
  bool along_run = true;  ///< over the axis of the run, on which the frame shown has a place
  bool log_y = false;
  std::vector<PlotSeries> series;  ///< the first is what was measured, others laws or measures beside it
  std::string note{};              ///< rich text: what the curves depend on, "at 0.9 Γ_c"
  bool added = false;              ///< by the user, who can remove it
  bool falling_x = false;          ///< the largest x is at the left, so that failure is at the right
};

/// "stress", "overloaded", "cluster", "lengths", "strain", "energy", "gamma", "residual", "iterations": the
/// order in which they are shown.
enum class PlotKind : std::size_t {
  stress,      ///< Gamma and sigma_T/sigma_N of the packing, with the laws of a periodic bed
  overloaded,  ///< p_o
  cluster,     ///< share of the overloaded grains in their largest cluster
  lengths,     ///< mean and largest l_c, D
  strain,      ///< volume strain, %
  energy,      ///< kinetic energy of a grain, the mean, over m g D, m the mean mass
  gamma,       ///< probability density of gamma in the frame shown
  residual,    ///< of the solver, over steps
  iterations,  ///< of the solver, over steps
  count
};
inline constexpr std::size_t plot_count = static_cast<std::size_t>(PlotKind::count);

/// An empty curve of a quantity, called by its symbol, and an empty plot of some along the run.
PlotSeries series_of(const analysis::Quantity& quantity);
Plot plot_along_run(const std::string& name, const std::string& title, std::vector<PlotSeries> series);

/// An empty plot of one quantity along the run, named as it is, with its title, or its name, and its unit.
Plot plot_of_quantity(const analysis::Quantity& quantity);

/// All plots, empty, over the tilt.
std::vector<Plot> empty_plots();
/// Says on the plots along the run what they are over; their curves are to be filled anew.
void name_axis(PlotAxis axis, std::vector<Plot>& plots);

/// Fills the curves of the observables: of the quantities that a run records more often than its frames, the
/// laws beside them, and the energy.
void plot_observables(std::span<const ObservableRow> rows, const RunStatics& statics,
                      const PlotAbscissa& abscissa, std::vector<Plot>& plots);
/// Fills the curves of all other quantities, from frames with one threshold, or, of a `stored` analysis,
/// those of quantities that depend on no threshold; `times` (s) are of the frames, and may be more. Values
/// that are NaN make a gap.
void plot_frames(std::span<const analysis::FrameRecord> frames, std::span<const double> times,
                 double mean_diameter, const PlotAbscissa& abscissa, std::vector<Plot>& plots,
                 bool stored = false);
/// Notes the threshold, in Gamma_c, of the plots whose quantities have one; `assumed` (rad): the theta_c that
/// it follows from while the slope has not failed.
void note_threshold(double factor, std::optional<double> assumed, std::vector<Plot>& plots);

/// Of the values of a curve between two x, both included; those that are NaN do not count.
struct RangeStatistics {
  std::size_t count = 0;
  double mean = 0.0;       ///< NaN without values
  double deviation = 0.0;  ///< standard deviation, over count - 1; NaN below two values
  double slope = 0.0;      ///< of the least squares, per unit of x; NaN where all x are one
};
RangeStatistics statistics_of(const PlotSeries& series, double low, double high);
/// Fills gamma; a frame in which no grain carries anything leaves it empty.
void plot_gamma(const BedFrame& bed, std::vector<Plot>& plots);
/// Fills residual and iterations. Of many steps, groups in a row are drawn as one, at the largest value.
void plot_steps(std::span<const StepRow> steps, std::vector<Plot>& plots);

}  // namespace talus::view
