#include "app/progress.h"

#include <unistd.h>

#include <cstdio>
#include <optional>

#include "core/trigonometry.h"

namespace talus {
namespace {

/// Where a slope is expected to fail when its scenario does not say where to end, deg.
constexpr double expected_repose = 20.0;

}  // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

RunShown ProgressLine::shown(const RunProgress& progress) {
  const Session& session = progress.session;
  const World& world = session.world();
  const StepReport& report = session.last_report();
  RunShown shown;
  shown.stage = session.phase() == Phase::deposition ? RunShown::Stage::deposition
                : session.phase() == Phase::flow     ? RunShown::Stage::flow
                                                     : RunShown::Stage::tilt;
  shown.time = world.time;
  shown.tilt = degrees(world.tilt);
  shown.residual = report.solver.residual.eta;
  shown.kinetic_energy = kinetic_energy(world.grains);
  shown.velocity = report.rms_velocity / (world.gravity * time_step(session.scenario()));
  shown.contacts = report.contacts;
  shown.seconds = progress.wall_seconds;
  const std::optional<double> asked = session.scenario().tilt.end_angle;
  shown.end_expected = !asked;
  shown.tilt_end = asked.value_or(expected_repose);
  if (shown.stage == RunShown::Stage::tilt) {
    if (tilt_started_at_ < 0.0) {
      tilt_started_at_ = progress.wall_seconds;
      tilt_started_from_ = shown.tilt;
    }
    const double speed =
        (shown.tilt - tilt_started_from_) / (progress.wall_seconds - tilt_started_at_ + 1e-9);
    if (speed > 0.0) shown.remaining = (shown.tilt_end - shown.tilt) / speed;
  }
  return shown;
}

void ProgressLine::show(const RunProgress& progress) {
  const double interval = terminal_ ? 0.2 : 10.0;
  if (quiet_ || progress.wall_seconds - last_shown_ < interval) return;
  last_shown_ = progress.wall_seconds;
  const std::optional<int> width = terminal_ ? std::optional(terminal_columns()) : std::nullopt;
  const std::string text = run_progress_text(shown(progress), width);
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
  open_ = terminal_;
}

void ProgressLine::finish() {
  if (open_) std::fputc('\n', stderr);
  open_ = false;
}

}  // namespace talus
