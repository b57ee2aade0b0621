#include "app/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <optional>

#include "core/trigonometry.h"

namespace talus {
namespace {

/// Where a slope is expected to fail when its scenario does not say where to end, deg.
constexpr double expected_repose = 20.0;

}  // namespace

std::string duration_text(double seconds) {
  char text[32];
  const long whole = std::lround(seconds);
  if (whole >= 3600)
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  else if (whole >= 60)
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%ld s", whole);
  return text;
}

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const RunProgress& progress) {
  const double interval = terminal_ ? 0.2 : 10.0;
  if (quiet_ || progress.wall_seconds - last_shown_ < interval) return;
  last_shown_ = progress.wall_seconds;
  const Session& session = progress.session;
  const World& world = session.world();
  const StepReport& report = session.last_report();
  const double gh = world.gravity * time_step(session.scenario());
  char text[256];
  if (session.phase() == Phase::deposition) {
    std::snprintf(text, sizeof text, "deposition  t = %.3f s  v = %.2e g h  residual %.1e  contacts %d  (%s)",
                  world.time, report.rms_velocity / gh, report.solver.residual.eta, report.contacts,
                  duration_text(progress.wall_seconds).c_str());
  } else if (session.phase() == Phase::flow) {
    std::snprintf(text, sizeof text,
                  "flow  theta = %.3f deg  residual %.1e  E_kin %.1e J  v = %.2e g h  (%s)",
                  degrees(world.tilt), report.solver.residual.eta, kinetic_energy(world.grains),
                  report.rms_velocity / gh, duration_text(progress.wall_seconds).c_str());
  } else {
    const double tilt = degrees(world.tilt);
    if (tilt_started_at_ < 0.0) {
      tilt_started_at_ = progress.wall_seconds;
      tilt_started_from_ = tilt;
    }
    const std::optional<double> asked = session.scenario().tilt.end_angle;
    const double end = asked.value_or(expected_repose);
    const double speed = (tilt - tilt_started_from_) / (progress.wall_seconds - tilt_started_at_ + 1e-9);
    std::string remaining;
    if (speed > 0.0 && tilt < end)
      remaining = "  ETA " + duration_text((end - tilt) / speed) + (asked ? "" : " (if it fails at 20 deg)");
    std::snprintf(text, sizeof text,
                  "tilt  theta = %.3f deg  residual %.1e  E_kin %.1e J  v = %.2e g h%s  (%s)", tilt,
                  report.solver.residual.eta, kinetic_energy(world.grains), report.rms_velocity / gh,
                  remaining.c_str(), duration_text(progress.wall_seconds).c_str());
  }
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", text);
  open_ = terminal_;
}

void ProgressLine::finish() {
  if (open_) std::fputc('\n', stderr);
  open_ = false;
}

}  // namespace talus
