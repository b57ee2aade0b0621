#include "app/progress.h"

#include "core/trigonometry.h"
#include "session/estimate.h"

namespace talus {
namespace {

constexpr double seconds_in_log = 10.0;

/// Steps until the bed is at rest; 0 where they cannot be estimated without the file that the bed came from.
double expected_deposition(const Scenario& scenario) {
  if (scenario.deposition.method == DepositionMethod::file) return 0.0;
  return static_cast<double>(estimate(scenario).deposition_steps);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet) : line_(quiet, seconds_in_log) {}

std::optional<double> ProgressLine::share(const Session& session, RunShown& shown) {
  switch (shown.phase) {
    case Phase::deposition:
      if (!deposition_steps_) deposition_steps_ = expected_deposition(session.scenario());
      if (*deposition_steps_ == 0.0) return std::nullopt;
      return static_cast<double>(session.world().step) / *deposition_steps_;
    case Phase::tilt: {
      const std::optional<double> end = session.scenario().tilt.end_angle;
      const TiltProgram& program = session.program();
      if (session.follows_program()) {
        if (program.ends_at_repose()) shown.repose_assumed = assumed_repose;
        if (!program_steps_) program_steps_ = static_cast<double>(expected_tilt_steps(session.scenario()));
        return static_cast<double>(session.schedule().tilt_steps) / *program_steps_;
      }
      if (!end) shown.repose_assumed = assumed_repose;
      return shown.tilt / end.value_or(assumed_repose);
    }
    case Phase::flow:
    case Phase::done:
      break;
  }
  return std::nullopt;
}

RunShown ProgressLine::shown(const RunProgress& progress) {
  const Session& session = progress.session;
  const World& world = session.world();
  const StepReport& report = session.last_report();
  RunShown shown;
  shown.phase = session.phase() == Phase::done ? Phase::tilt : session.phase();
  shown.time = world.time;
  shown.tilt = degrees(world.tilt);
  shown.residual = report.solver.residual.eta;
  shown.kinetic_energy = report.motion.kinetic_energy;
  shown.velocity = report.motion.rms_velocity / (world.gravity * time_step(session.scenario()));
  shown.contacts = report.contacts;
  shown.seconds = progress.wall_seconds;
  shown.share = share(session, shown);
  if (!shown.share) return shown;
  if (phase_ != shown.phase) {
    phase_ = shown.phase;
    phase_began_ = progress.wall_seconds;
    phase_began_with_ = *shown.share;
  }
  const double pace = (*shown.share - phase_began_with_) / (progress.wall_seconds - phase_began_ + 1e-9);
  if (pace > 0.0) shown.remaining = (1.0 - *shown.share) / pace;
  return shown;
}

void ProgressLine::show(const RunProgress& progress) {
  if (line_.is_due()) line_.show(run_progress_text(shown(progress), line_.width()));
}

}  // namespace talus
