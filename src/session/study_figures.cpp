#include "session/study_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/trigonometry.h"
#include "session/analysis_input.h"
#include "stress/overload.h"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Tilts are sums in radians: two that are meant to be equal differ by less than this, deg.
constexpr double same_angle = 1e-6;

double figure(const Figures& figures, std::string_view name) {
  return find_value(figures, name).value_or(none);
}

/// Mean displacement of the free grains along the bed between two frames, m.
double mean_displacement(const Frame& from, const Frame& to, const RunStatics& statics) {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(statics.free_count); ++i)
    sum += to.x[i] - from.x[i] + (to.image[i] - from.image[i]) * statics.length;
  return sum / statics.free_count;
}

/// Sets the quantities of the bed at an angle, in deg, from `first` on in the order of StudyQuantity.
void measure_bed(const RunFile& run, const std::vector<ObservableRow>& rows, double angle, double theta_c,
                 StudyQuantity first, StudyFigures& figures) {
  const double highest = radians(angle + same_angle);
  const auto row = std::find_if(rows.rbegin(), rows.rend(), [&](const ObservableRow& candidate) {
    return at(candidate, Observable::tilt) <= highest;
  });
  const auto& tilts = run.frame_tilts();
  const auto above = std::upper_bound(tilts.begin(), tilts.end(), highest);
  if (row == rows.rend() || above == tilts.begin()) return;
  const Frame frame =
      analysed_frame(run, AnalysisParameters(), static_cast<std::size_t>(above - tilts.begin()) - 1);
  const RunStatics& statics = run.header().statics;
  const double overloaded =
      std::isnan(theta_c) ? none : count_overloaded(frame, statics, sine(radians(theta_c))).fraction();
  const double values[] = {at(*row, Observable::volume_strain),
                           at(*row, Observable::centre_of_mass_strain),
                           mean_displacement(run.frame(0), frame, statics) / statics.depth,
                           overloaded,
                           at(*row, Observable::stress_ratio),
                           at(*row, Observable::coordination_number)};
  std::copy(std::begin(values), std::end(values), figures.begin() + static_cast<std::ptrdiff_t>(first));
}

void measure_solver(const RunFile& run, StudyFigures& figures) {
  double steps = 0.0, passes = 0.0;
  for (const StepRow& row : run.steps()) {
    if (at(row, StepField::phase) != 1.0) continue;
    ++steps;
    passes += at(row, StepField::iterations);
  }
  const Checkpoint& end = run.checkpoint();
  at(figures, StudyQuantity::residual_max_rest) = figure(end.results, "residual_max_rest");
  at(figures, StudyQuantity::residual_max_moving) = figure(end.results, "residual_max_moving");
  at(figures, StudyQuantity::unconverged_share) = figure(end.results, "unconverged_steps") / steps;
  at(figures, StudyQuantity::passes_per_step) = passes / steps;
  at(figures, StudyQuantity::wall_seconds) = figure(end.timing, "deposition") + figure(end.timing, "tilt");
}

}  // namespace

const std::array<StudyField, study_quantity_count> study_fields = {{
    {"theta_c_deg", "theta_c", StudyGroup::slope, 1.0, "deg", "angle of repose"},
    {"volume_strain_at_reference", "volume strain", StudyGroup::at_reference, 100.0, "%",
     "(V - V0)/V0, negative = contraction"},
    {"centre_of_mass_strain_at_reference", "centre-of-mass strain", StudyGroup::at_reference, 100.0, "%",
     "(y - y0)/y0 of the centre of mass, a quieter estimate of the volume strain"},
    {"creep_at_reference", "creep", StudyGroup::at_reference, 100.0, "% of H",
     "mean displacement downslope of the free grains since the tilt began, over the depth of the bed"},
    {"overloaded_fraction_at_reference", "p_o", StudyGroup::at_reference, 1.0, "",
     "share of overloaded grains: those that have, with their first neighbours, gamma >= sin(theta_c), "
     "theta_c "
     "that of the same run"},
    {"stress_ratio_at_reference", "Gamma", StudyGroup::at_reference, 1.0, "", "Q/P of the packing"},
    {"coordination_number_at_reference", "z", StudyGroup::at_reference, 1.0, "", "coordination number"},
    {"volume_strain_at_theta_c", "volume strain", StudyGroup::at_theta_c, 100.0, "%", "the same at theta_c"},
    {"centre_of_mass_strain_at_theta_c", "centre-of-mass strain", StudyGroup::at_theta_c, 100.0, "%",
     "the same at theta_c"},
    {"creep_at_theta_c", "creep", StudyGroup::at_theta_c, 100.0, "% of H", "the same at theta_c"},
    {"overloaded_fraction_at_theta_c", "p_o", StudyGroup::at_theta_c, 1.0, "", "the same at theta_c"},
    {"stress_ratio_at_theta_c", "Gamma", StudyGroup::at_theta_c, 1.0, "", "the same at theta_c"},
    {"coordination_number_at_theta_c", "z", StudyGroup::at_theta_c, 1.0, "", "the same at theta_c"},
    {"residual_max_rest", "worst residual at rest", StudyGroup::solver, 1.0, "",
     "worst natural-map residual eta of a step of the tilt at rest"},
    {"residual_max_moving", "while moving", StudyGroup::solver, 1.0, "", "the same of the other steps"},
    {"unconverged_share", "not converged", StudyGroup::solver, 100.0, "% of steps",
     "share of the steps of the tilt that missed the tolerance asked of them"},
    {"passes_per_step", "passes a step", StudyGroup::solver, 1.0, "",
     "mean passes of the solver over all contacts in a step of the tilt"},
    {"wall_s", "wall time", StudyGroup::solver, 1.0, "s",
     "time spent in the steps of deposition and tilt, on one thread"},
}};

RunReach reach(const RunFile& run) {
  return {degrees(figure(run.checkpoint().results, "theta_c")), degrees(run.checkpoint().world.tilt)};
}

StudyFigures study_figures(const RunFile& run, double reference) {
  StudyFigures figures;
  figures.fill(none);
  const auto [theta_c, end] = reach(run);
  at(figures, StudyQuantity::theta_c) = theta_c;
  const std::vector<ObservableRow> rows = run.observables();
  const double last = std::isnan(theta_c) ? end : theta_c;
  if (reference <= last + same_angle)
    measure_bed(run, rows, reference, theta_c, StudyQuantity::volume_strain_at_reference, figures);
  if (!std::isnan(theta_c))
    measure_bed(run, rows, theta_c, theta_c, StudyQuantity::volume_strain_at_theta_c, figures);
  measure_solver(run, figures);
  return figures;
}

}  // namespace talus
