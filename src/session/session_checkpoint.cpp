/// A session to and from its checkpoint, value by value.

#include <cmath>
#include <limits>

#include "core/errors.h"
#include "session/session.h"

namespace talus {
namespace {

template <typename Pairs>
auto value_of(const Pairs& pairs, const std::string& name) {
  if (const auto value = find_value(pairs, name)) return *value;
  throw Error(ExitCode::bad_data,
              "the checkpoint has no value '" + name + "': it was written by another version");
}

/// A number of steps.
std::int64_t count_of(const Checkpoint& checkpoint, const std::string& name) {
  constexpr std::int64_t most = std::int64_t{1} << 53;
  const std::int64_t count = value_of(checkpoint.integers, name);
  if (count < 0 || count > most)
    throw Error(ExitCode::bad_data, "the checkpoint has " + std::to_string(count) + " as its '" + name +
                                        "', expected a number of steps");
  return count;
}

}  // namespace

Checkpoint Session::checkpoint(double seconds_writing) const {
  Checkpoint checkpoint;
  checkpoint.world = world_;
  checkpoint.integers = {{"phase", static_cast<std::int64_t>(phase_)},
                         {"tilt_steps", tilt_steps_},
                         {"quiet_steps", quiet_steps_},
                         {"flowing", flow_.flowing ? 1 : 0},
                         {"failed", flow_.failed ? 1 : 0},
                         {"unconverged_deposition", record_.unconverged_deposition},
                         {"unconverged_tilt", record_.unconverged_tilt}};
  checkpoint.reals = {{"baseline_volume", baseline_.volume},
                      {"baseline_centre_of_mass_height", baseline_.centre_of_mass_height},
                      {"onset_tilt", flow_.onset_tilt},
                      {"flow_displacement", flow_.displacement},
                      {"surface_height", surface_height_},
                      {"surface_displacement", surface_displacement_},
                      {"residual_since_row", residual_since_row_}};
  checkpoint.results = {{"theta_c", angle_of_repose().value_or(std::numeric_limits<double>::quiet_NaN())},
                        {"residual_max", std::max(record_.residual_max_rest, record_.residual_max_moving)},
                        {"residual_max_rest", record_.residual_max_rest},
                        {"residual_max_moving", record_.residual_max_moving},
                        {"unconverged_steps_deposition", static_cast<double>(record_.unconverged_deposition)},
                        {"unconverged_steps", static_cast<double>(record_.unconverged_tilt)}};
  add_commanded(checkpoint);
  add_warnings(checkpoint);
  if (scenario_.tilt.after_failure != AfterFailure::stop) add_flow(checkpoint);
  checkpoint.timing = {{"deposition", deposition_seconds_}, {"tilt", tilt_seconds_}};
  for (std::size_t k = 0; k < stage_count; ++k)
    checkpoint.timing.emplace_back(std::string("stage_") + std::string(stage_names[k]), stage_seconds_[k]);
  checkpoint.timing.emplace_back("write", seconds_writing);
  return checkpoint;
}

/// What no command has changed is not there, as in runs of before there were commands: it is the scenario's.
void Session::add_commanded(Checkpoint& checkpoint) const {
  if (friction_) checkpoint.reals.emplace_back("friction", *friction_);
  if (!course_) return;
  checkpoint.reals.emplace_back("tilt_rate", course_->rate);
  checkpoint.reals.emplace_back("tilt_from", course_->from);
  checkpoint.integers.emplace_back("tilt_since", course_->since);
}

void Session::take_commanded(const Checkpoint& checkpoint) {
  friction_ = find_value(checkpoint.reals, "friction");
  if (const std::optional<double> rate = find_value(checkpoint.reals, "tilt_rate"))
    course_ = TiltCourse{*rate, value_of(checkpoint.reals, "tilt_from"), count_of(checkpoint, "tilt_since")};
}

/// What was never broken is not there, as in runs of before there were guards.
void Session::add_warnings(Checkpoint& checkpoint) const {
  if (unconverged_in_a_row_ > 0)
    checkpoint.integers.emplace_back("unconverged_in_a_row", unconverged_in_a_row_);
  for (std::size_t k = 0; k < guard_count; ++k) {
    if (guard_warnings_.steps[k] == 0) continue;
    const std::string name = std::string("warnings_").append(guard_names[k]);
    checkpoint.results.emplace_back(name, static_cast<double>(guard_warnings_.steps[k]));
    checkpoint.results.emplace_back(name + "_first_step", static_cast<double>(guard_warnings_.first[k]));
  }
}

void Session::take_warnings(const Checkpoint& checkpoint) {
  for (const auto& [name, value] : checkpoint.integers)
    if (name == "unconverged_in_a_row") unconverged_in_a_row_ = value;
  for (std::size_t k = 0; k < guard_count; ++k) {
    const std::string name = std::string("warnings_").append(guard_names[k]);
    guard_warnings_.steps[k] = static_cast<std::int64_t>(find_value(checkpoint.results, name).value_or(0.0));
    guard_warnings_.first[k] =
        static_cast<std::int64_t>(find_value(checkpoint.results, name + "_first_step").value_or(0.0));
  }
}

void Session::add_flow(Checkpoint& checkpoint) const {
  const double angle = angle_at_rest_.value_or(std::numeric_limits<double>::quiet_NaN());
  checkpoint.integers.emplace_back("flow_steps", flow_steps_);
  checkpoint.integers.emplace_back("unconverged_flow", record_.unconverged_flow);
  checkpoint.results.emplace_back("theta_r", angle);
  checkpoint.results.emplace_back("unconverged_steps_flow", static_cast<double>(record_.unconverged_flow));
}

void Session::take_flow(const Checkpoint& checkpoint) {
  flow_steps_ = count_of(checkpoint, "flow_steps");
  record_.unconverged_flow = count_of(checkpoint, "unconverged_flow");
  const double angle = value_of(checkpoint.results, "theta_r");
  if (!std::isnan(angle)) angle_at_rest_ = angle;
}

Session::Session(const Scenario& scenario, Checkpoint checkpoint)
    : scenario_(scenario), world_(std::move(checkpoint.world)) {
  const auto& integers = checkpoint.integers;
  const auto& reals = checkpoint.reals;
  const std::int64_t phase = value_of(integers, "phase");
  if (phase < 0 || phase > static_cast<std::int64_t>(Phase::flow))
    throw Error(ExitCode::bad_data,
                "the checkpoint has phase " + std::to_string(phase) + ", expected 0, 1, 2 or 3");
  phase_ = static_cast<Phase>(phase);
  tilt_steps_ = count_of(checkpoint, "tilt_steps");
  quiet_steps_ = count_of(checkpoint, "quiet_steps");
  flow_.flowing = value_of(integers, "flowing") != 0;
  flow_.failed = value_of(integers, "failed") != 0;
  flow_.onset_tilt = value_of(reals, "onset_tilt");
  flow_.displacement = value_of(reals, "flow_displacement");
  record_.unconverged_deposition = count_of(checkpoint, "unconverged_deposition");
  record_.unconverged_tilt = count_of(checkpoint, "unconverged_tilt");
  record_.residual_max_rest = value_of(checkpoint.results, "residual_max_rest");
  record_.residual_max_moving = value_of(checkpoint.results, "residual_max_moving");
  baseline_.volume = value_of(reals, "baseline_volume");
  baseline_.centre_of_mass_height = value_of(reals, "baseline_centre_of_mass_height");
  surface_height_ = value_of(reals, "surface_height");
  surface_displacement_ = value_of(reals, "surface_displacement");
  residual_since_row_ = value_of(reals, "residual_since_row");
  take_commanded(checkpoint);
  take_warnings(checkpoint);
  if (scenario_.tilt.after_failure != AfterFailure::stop) take_flow(checkpoint);
  deposition_seconds_ = find_value(checkpoint.timing, "deposition").value_or(0.0);
  tilt_seconds_ = find_value(checkpoint.timing, "tilt").value_or(0.0);
  for (std::size_t k = 0; k < stage_count; ++k)
    stage_seconds_[k] =
        find_value(checkpoint.timing, std::string("stage_") + std::string(stage_names[k])).value_or(0.0);
}

}  // namespace talus
