#pragma once
/// Curves next to the map.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/quantities.h"
#include "core/observables.h"
#include "core/snapshot.h"
#include "core/statistics.h"
#include "view/frame_values.h"
#include "view/selection.h"

namespace talus::view {

/// Abscissa of the curves of a run.
enum class PlotAxis { tilt, angle_left, time };

/// Abscissa with the values that places on it depend on.
struct PlotAbscissa {
  PlotAxis axis = PlotAxis::tilt;
  double theta_c = not_known;  ///< rad; required for angle_left
};

/// Returns theta or theta_c - theta in deg, or t in s, for a tilt (rad) and a time (s).
double place_on(const PlotAbscissa& abscissa, double tilt, double time);
/// Returns rich text: "θ_c − θ (°)".
std::string title_of(PlotAxis axis);

/// Places on the abscissa that all plots along the run mark.
struct PlotMarks {
  std::optional<double> shown;    ///< frame shown
  std::optional<double> theta_c;  ///< drawn dashed
  std::vector<double> ticks{};    ///< short ticks above the axis: rearrangements
};

/// One curve along the run, with its description.
struct PlotSeries {
  std::string name;          ///< short name for the legend: "p_o"
  std::vector<double> x, y;  ///< places on the axis, and values; NaN if there is none
  bool law = false;          ///< prediction of theory, drawn with the measurement
  std::optional<analysis::Quantity> quantity = std::nullopt;  ///< quantity shown, if the table has it
};

/// Plot next to the map: curves along the run, or over the abscissa that `x_title` names.
struct Plot {
  std::string name;       ///< also the name of its widget: "stress", "overloaded", ...
  std::string title;      ///< "Γ = Q/P, σ_T/σ_N"
  std::string x_title;    ///< "θ (°)"
  bool along_run = true;  ///< over the axis of the run, on which the frame shown is marked
  bool log_y = false;
  std::vector<PlotSeries> series;  ///< the first is the measurement; the others are laws or further measures
  std::string note{};              ///< rich text: the parameters of the curves, "at 0.9 Γ_c"
  bool added = false;              ///< added by the user, who can remove it
  bool falling_x = false;          ///< the largest x is on the left, so that failure is on the right
};

/// Plots in display order; the enumerators are their names.
enum class PlotKind : std::size_t {
  stress,      ///< Gamma and sigma_T/sigma_N of the packing, with the laws for a periodic bed
  overloaded,  ///< p_o
  cluster,     ///< share of the overloaded grains that are in their largest cluster
  lengths,     ///< mean and largest l_c, D
  strain,      ///< volume strain, %
  energy,      ///< mean kinetic energy per grain, in units of m g D with the mean mass m
  gamma,       ///< probability density of gamma in the frame shown
};

/// Returns an empty curve of a quantity, named by its symbol, and an empty plot along the run.
PlotSeries series_of(const analysis::Quantity& quantity);
Plot plot_along_run(const std::string& name, const std::string& title, std::vector<PlotSeries> series);

/// Returns an empty plot of one quantity along the run. It has its name, title and unit.
Plot plot_of_quantity(const analysis::Quantity& quantity);

/// Returns all plots, empty, over the tilt.
std::vector<Plot> empty_plots();
/// Sets the abscissa of the plots along the run; the caller must then fill their curves again.
void name_axis(PlotAxis axis, std::vector<Plot>& plots);

/// Fills the curves of the observables: those recorded between frames, their laws, and the energy.
void plot_observables(std::span<const ObservableRow> rows, const RunStatics& statics,
                      const PlotAbscissa& abscissa, std::vector<Plot>& plots);
/// Fills the curves of all other quantities, from frames with one threshold; from a `stored` analysis, only
/// those of quantities without a threshold. `times` (s) are those of the frames, and may have further
/// entries. NaN values leave a gap.
void plot_frames(std::span<const analysis::FrameRecord> frames, std::span<const double> times,
                 double mean_diameter, const PlotAbscissa& abscissa, std::vector<Plot>& plots,
                 bool stored = false);
/// Notes the threshold, in Gamma_c, on the plots whose quantities have one. `assumed` (rad) is the theta_c
/// used for it if the slope has not failed.
void note_threshold(double factor, std::optional<double> assumed, std::vector<Plot>& plots);

/// Statistics of a curve between two x, both included, ignoring NaN.
struct RangeStatistics : Statistics {
  double slope = 0.0;  ///< slope of the least-squares line, per unit of x; NaN if all x are equal
};
RangeStatistics statistics_of(const PlotSeries& series, double low, double high);
/// Fills gamma; it stays empty if no grain of the frame carries force.
void plot_gamma(const BedFrame& bed, std::vector<Plot>& plots);

/// Returns two plots along the run: "contact forces", in units of the weight `weight` (N/m), and
/// "mobilisation", which is 1 while the contact slides. An open contact has no mobilisation.
std::vector<Plot> contact_plots(std::span<const HistoryInstant> instants, double weight,
                                const PlotAbscissa& abscissa);

}  // namespace talus::view
