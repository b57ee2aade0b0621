/// A session to and from its checkpoint, value by value.

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/errors.h"
#include "session/session.h"

namespace talus {

/// The values of a checkpoint that a session needs, by name.
class StoredValues {
 public:
  StoredValues(const Checkpoint& checkpoint, const std::string& origin)
      : checkpoint_(checkpoint), origin_(origin) {}

  std::int64_t integer(const std::string& name) const {
    return value_of(checkpoint_.integers, "/checkpoint/integers/", name);
  }
  double real(const std::string& name) const {
    return value_of(checkpoint_.reals, "/checkpoint/reals/", name);
  }
  double result(const std::string& name) const { return value_of(checkpoint_.results, "/results/", name); }

  /// A number from 0 to `most`, of what the message says.
  std::int64_t count(const std::string& name, std::int64_t most = std::int64_t{1} << 53,
                     const std::string& expected = "a number of steps") const {
    const std::int64_t count = integer(name);
    if (count < 0 || count > most)
      refuse("/checkpoint/integers/" + name, "is " + std::to_string(count) + ", expected " + expected);
    return count;
  }

  const Checkpoint& all() const { return checkpoint_; }

 private:
  [[noreturn]] void refuse(const std::string& path, const std::string& fault) const {
    throw Error(ExitCode::bad_data, origin_ + ": data set " + path + " " + fault);
  }

  template <typename Value>
  Value value_of(const std::vector<std::pair<std::string, Value>>& named, const std::string& group,
                 const std::string& name) const {
    if (const std::optional<Value> value = find_value(named, name)) return *value;
    refuse(group + name, "is missing, without which the run cannot go on");
  }

  const Checkpoint& checkpoint_;
  const std::string& origin_;
};

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

void Session::take_commanded(const StoredValues& stored) {
  friction_ = find_value(stored.all().reals, "friction");
  if (const std::optional<double> rate = find_value(stored.all().reals, "tilt_rate"))
    course_ = TiltCourse{*rate, stored.real("tilt_from"), stored.count("tilt_since")};
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

void Session::take_flow(const StoredValues& stored) {
  flow_steps_ = stored.count("flow_steps");
  record_.unconverged_flow = stored.count("unconverged_flow");
  const double angle = stored.result("theta_r");
  if (!std::isnan(angle)) angle_at_rest_ = angle;
}

Session::Session(const Scenario& scenario, Checkpoint checkpoint, const std::string& origin)
    : scenario_(scenario), world_(std::move(checkpoint.world)), arrivals_(arrivals_of(scenario)) {
  const StoredValues stored(checkpoint, origin);
  phase_ = static_cast<Phase>(stored.count("phase", static_cast<std::int64_t>(Phase::flow), "0, 1, 2 or 3"));
  tilt_steps_ = stored.count("tilt_steps");
  quiet_steps_ = stored.count("quiet_steps");
  flow_.flowing = stored.integer("flowing") != 0;
  flow_.failed = stored.integer("failed") != 0;
  flow_.onset_tilt = stored.real("onset_tilt");
  flow_.displacement = stored.real("flow_displacement");
  record_.unconverged_deposition = stored.count("unconverged_deposition");
  record_.unconverged_tilt = stored.count("unconverged_tilt");
  record_.residual_max_rest = stored.result("residual_max_rest");
  record_.residual_max_moving = stored.result("residual_max_moving");
  baseline_.volume = stored.real("baseline_volume");
  baseline_.centre_of_mass_height = stored.real("baseline_centre_of_mass_height");
  surface_height_ = stored.real("surface_height");
  surface_displacement_ = stored.real("surface_displacement");
  residual_since_row_ = stored.real("residual_since_row");
  take_commanded(stored);
  take_warnings(checkpoint);
  if (scenario_.tilt.after_failure != AfterFailure::stop) take_flow(stored);
  deposition_seconds_ = find_value(checkpoint.timing, "deposition").value_or(0.0);
  tilt_seconds_ = find_value(checkpoint.timing, "tilt").value_or(0.0);
  for (std::size_t k = 0; k < stage_count; ++k)
    stage_seconds_[k] =
        find_value(checkpoint.timing, std::string("stage_") + std::string(stage_names[k])).value_or(0.0);
}

}  // namespace talus
