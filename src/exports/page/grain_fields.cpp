#include "exports/page/grain_fields.h"

#include <algorithm>
#include <fmt/core.h>

#include "base/errors.h"

namespace talus::exports {
namespace {

/// Resolutions finer than the display: a shade of a map is 1/256 of its range.
constexpr double ratio_step = 1.0 / 4000.0;
constexpr double pressure_step = 1.0 / 200.0;  // rho g D
constexpr double length_step = 1.0 / 100.0;    // D
constexpr Quantum motion{1e-7, 0.02, true};    // D, or D per degree
constexpr double rotation_steps = 400.0;       // steps up to the end of the scale
constexpr double middle_code = 32767.0;

/// Returns the quantum of rotations, which are signed and centred on zero.
Quantum rotation_quantum(const pictures::MapSettings& settings) {
  const auto per_degree = settings.motion.range(pictures::MapKind::rotation, true);
  const auto fitting = per_degree ? per_degree : settings.motion.range(pictures::MapKind::rotation, false);
  const double step =
      fitting.value_or(pictures::fixed_motion_range(pictures::MapKind::rotation, true)).high / rotation_steps;
  return {-middle_code * step, step};
}

}  // namespace

GrainFields::GrainFields(const PageRun& run) : run_(run) {
  const RunStatics& statics = run.statics();
  const auto free_grains = static_cast<std::size_t>(statics.free_count);
  const std::size_t columns = run.frames.size();
  x_quantum_ = statics.periodic ? places_of_period(statics.length) : places_of_box(0.0, statics.length);
  y_quantum_ = places_of_box(run.extent.y_min, run.extent.y_max);
  x_ = code_table(statics.radius.size(), columns, 2);
  y_ = code_table(statics.radius.size(), columns, 2);
  const auto add = [&](pictures::MapKind kind, const std::string& label, const std::string& unit,
                       const Quantum& quantum) {
    fields_.push_back({std::string(pictures::map_name(kind)), label, unit, 3, quantum,
                       code_table(free_grains, columns, 2, no_code)});
  };
  add(pictures::MapKind::gamma,
      "γ, " + (run.settings.l_min > 0.0 ? pictures::reading_text(run.settings) : "of the grain alone"), "",
      {0.0, ratio_step});
  if (run.shows(pictures::MapKind::coarse))
    add(pictures::MapKind::coarse, fmt::format("γ_l, l = {:.6g} D", run.settings.length), "",
        {0.0, ratio_step});
  add(pictures::MapKind::pressure, "P", "ρgD", {-1.0, pressure_step});
  add(pictures::MapKind::displacement, "moved", "D per degree", motion);
  add(pictures::MapKind::rotation, "turned", "° per degree", rotation_quantum(run.settings));
  if (!run.has_threshold()) return;
  fields_.push_back({"lc", "ℓ_c", "D", 3, {0.0, length_step}, code_table(free_grains, columns, 2, no_code)});
  fields_.push_back({"cluster", "", "", 0, {0.0, 1.0}, code_table(free_grains, columns, 2, no_code)});
}

GrainField& GrainFields::field(const std::string& name) {
  const auto found = std::ranges::find(fields_, name, &GrainField::name);
  if (found == fields_.end()) throw Error(ExitCode::internal, "there is no grain field called " + name);
  return *found;
}

void GrainFields::set(GrainField& target, std::size_t column, std::size_t grain, double value) {
  target.codes.at(grain, column) = code_of(target.quantum, value);
}

void GrainFields::add(const PageFrame& frame, pictures::MapKind kind, const pictures::MapLayer& layer) {
  if (layer.values.empty()) return;
  GrainField& target = field(std::string(pictures::map_name(kind)));
  for (std::size_t i = 0; i < layer.values.size(); ++i) set(target, frame.column, i, layer.values[i]);
}

void GrainFields::add(const PageFrame& frame) {
  for (std::size_t i = 0; i < frame.frame.x.size(); ++i) {
    x_.at(i, frame.column) = place_code(x_quantum_, frame.frame.x[i]);
    y_.at(i, frame.column) = place_code(y_quantum_, frame.frame.y[i]);
  }
  if (!run_.has_threshold()) return;
  GrainField &lengths = field("lc"), &clusters = field("cluster");
  for (std::size_t i = 0; i < lengths.codes.rows; ++i) {
    set(lengths, frame.column, i, static_cast<double>(frame.lc[i]) / run_.statics().mean_diameter);
    set(clusters, frame.column, i,
        frame.clusters.label[i] < 0 ? not_known : static_cast<double>(frame.clusters.label[i]));
  }
}

}  // namespace talus::exports
