#include "studies/study_figures.h"

#include <algorithm>
#include <cmath>

#include "analysis/failure/last_rise.h"
#include "analysis/failure/place.h"
#include "analysis/quantities.h"
#include "core/bed_frame.h"
#include "core/trigonometry.h"

namespace talus::studies {
namespace {

/// Tolerance for equal tilts, deg; tilts are sums in radians.
constexpr double same_angle = 1e-6;

double figure(const Figures& figures, std::string_view name) {
  return find_value(figures, name).value_or(not_known);
}

/// Returns the mean displacement of the free grains along the bed between two frames, m.
double mean_displacement(const Frame& from, const Frame& to, const RunStatics& statics) {
  double sum = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) sum += displacement({to, statics}, from, i).x;
  return sum / statics.free_count;
}

/// A quantity of the bed at an angle.
struct BedField {
  std::string name;
  std::optional<analysis::QuantityMember> member;  ///< row in the table of quantities; creep has none
  std::string note;                                ///< addition of a study to the definition
};

/// Returns the quantities in the order of StudyQuantity.
const std::vector<BedField>& bed_fields() {
  static const std::vector<BedField> fields = {
      {"volume_strain", &analysis::FrameRecord::volume_strain, ""},
      {"centre_of_mass_strain", &analysis::FrameRecord::centre_of_mass_strain, ""},
      {"creep", std::nullopt,
       "mean displacement downslope of the free grains since the tilt began, over the depth of the bed"},
      {"overloaded_fraction", &analysis::FrameThreshold::overloaded_fraction,
       "; overloaded grains are those that have, with their first neighbours, gamma >= sin(theta_c), with "
       "theta_c of the same run"},
      {"stress_ratio", &analysis::FrameRecord::stress_ratio, ""},
      {"coordination_number", &analysis::FrameRecord::coordination_number, ""},
  };
  return fields;
}

StudyField field_of(const BedField& bed, StudyGroup group) {
  const bool first = group == StudyGroup::at_reference;
  const std::string name = bed.name + (first ? "_at_reference" : "_at_theta_c");
  if (!bed.member) return {name, "Creep in % of H", group, 100.0, first ? bed.note : "the same at theta_c"};
  const analysis::Quantity& quantity = analysis::quantity_of(*bed.member);
  return {name, analysis::shown_title(quantity), group, analysis::shown(quantity, 1.0, 1.0),
          first ? quantity.definition + bed.note : "the same at theta_c"};
}

double value_at(const ensemble::MemberSeries& series, const std::string& name, double angle) {
  const auto found = std::ranges::find(series.series, name, &ensemble::NamedSeries::name);
  const auto k = analysis::frame_not_after(series.theta, angle);
  return found != series.series.end() && k ? found->values[*k] : not_known;
}

/// Returns the creep over the depth of the bed, from the first frame of the tilt to the last one not after an
/// angle, deg.
double creep_at(const io::RunFile& run, double angle) {
  const analysis::SeriesPart rise = analysis::last_rise(run.frame_tilts());
  std::vector<double> theta;
  for (const double tilt : analysis::magnitudes(run.frame_tilts(), rise)) theta.push_back(degrees(tilt));
  const auto k = analysis::frame_not_after(theta, angle);
  const RunStatics& statics = run.header().statics;
  if (!k || !run.has_frames()) return not_known;
  return mean_displacement(run.frame(0), run.frame(rise.first + *k), statics) / statics.depth;
}

void measure_solver(const io::RunFile& run, StudyFigures& figures) {
  double steps = 0.0, iterations = 0.0;
  for (const StepRow& row : run.steps()) {
    if (at(row, StepField::phase) != 1.0) continue;
    ++steps;
    iterations += at(row, StepField::iterations);
  }
  const io::Checkpoint& end = run.checkpoint();
  at(figures, StudyQuantity::residual_max_rest) = figure(end.results, "residual_max_rest");
  at(figures, StudyQuantity::residual_max_moving) = figure(end.results, "residual_max_moving");
  at(figures, StudyQuantity::unconverged_share) = figure(end.results, "unconverged_steps") / steps;
  at(figures, StudyQuantity::iterations_per_step) = iterations / steps;
  at(figures, StudyQuantity::wall_seconds) = figure(end.timing, "deposition") + figure(end.timing, "tilt");
}

}  // namespace

const std::vector<StudyField>& study_fields() {
  static const std::vector<StudyField> fields = [] {
    using enum StudyGroup;
    const analysis::Quantity repose = analysis::quantity_of(&analysis::Analysis::theta_c);
    std::vector<StudyField> all = {
        {"theta_c_deg", analysis::shown_title(repose), slope, 1.0, repose.definition}};
    for (const StudyGroup group : {at_reference, at_theta_c})
      for (const BedField& bed : bed_fields()) all.push_back(field_of(bed, group));
    const StudyField of_solver[] = {
        {"residual_max_rest", "worst residual at rest", solver, 1.0,
         "largest natural-map residual eta of a step of the tilt at rest"},
        {"residual_max_moving", "while moving", solver, 1.0, "the same for the other steps"},
        {"unconverged_share", "not converged, in % of steps", solver, 100.0,
         "share of the steps of the tilt that missed their tolerance"},
        {"iterations_per_step", "iterations per step", solver, 1.0,
         "mean iterations of the solver in a step of the tilt"},
        {"wall_s", "wall time in s", solver, 1.0,
         "time spent in the steps of deposition and tilt, on one thread"},
    };
    all.insert(all.end(), std::begin(of_solver), std::end(of_solver));
    return all;
  }();
  return fields;
}

RunReach reach(const io::RunFile& run) {
  const double theta_c = degrees(figure(run.checkpoint().results, "theta_c"));
  if (!run.goes_by_time()) return {theta_c, degrees(run.checkpoint().world.tilt)};
  const std::vector<double> tilts =
      analysis::magnitudes(run.frame_tilts(), analysis::last_rise(run.frame_tilts()));
  return {theta_c, tilts.empty() ? 0.0 : degrees(tilts.back())};
}

StudyFigures study_figures(const io::RunFile& run, const ensemble::MemberResult& member, double reference) {
  StudyFigures figures;
  figures.fill(not_known);
  const auto [theta_c, end] = reach(run);
  at(figures, StudyQuantity::theta_c) = theta_c;
  const double last = std::isnan(theta_c) ? end : theta_c;
  for (std::size_t k = 0; k < bed_fields().size(); ++k) {
    const BedField& field = bed_fields()[k];
    const std::string name = field.member ? analysis::quantity_of(*field.member).name : "";
    auto& at_reference = figures[static_cast<std::size_t>(StudyQuantity::volume_strain_at_reference) + k];
    auto& at_theta_c = figures[static_cast<std::size_t>(StudyQuantity::volume_strain_at_theta_c) + k];
    if (reference <= last + same_angle)
      at_reference = field.member ? value_at(member.series, name, reference) : creep_at(run, reference);
    if (!std::isnan(theta_c))
      at_theta_c = field.member
                       ? ensemble::number_called(member.numbers,
                                                 analysis::name_of({*field.member, analysis::Place::theta_c}))
                       : creep_at(run, theta_c);
  }
  measure_solver(run, figures);
  return figures;
}

}  // namespace talus::studies
