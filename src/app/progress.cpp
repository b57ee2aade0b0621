#include "app/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <memory>

#include "app/terminal.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "session/estimate.h"

namespace talus::app {
namespace {

constexpr double seconds_on_terminal = 0.1;
constexpr int usual_columns = 80;  ///< used if the terminal does not report its width

std::string progress_bar(double share) {
  constexpr int cells = 14;
  const auto full = static_cast<std::size_t>(cells * share);
  return fmt::format("[{:#<{}}{:-<{}}]", "", full, "", cells - full);
}

/// Returns the usable columns: one less than the width, because some terminals wrap at the last column.
int columns_of_terminal() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return (known ? size.ws_col : usual_columns) - 1;
}

/// Expected length of a run, and its state when this process began the phase.
struct RunPace {
  explicit RunPace(bool quiet) : line(quiet, seconds_on_terminal, 10.0) {}

  StatusLine line;
  std::optional<double> deposition_steps;  ///< 0: unknown
  std::optional<double> program_steps;
  std::optional<session::Phase> phase;
  double began = 0.0;       ///< wall seconds
  double began_with = 0.0;  ///< fraction of the phase done at that time
};

/// Returns the steps until the bed is at rest; 0 if its estimate would need the file of the bed.
double expected_deposition(const scenario::Scenario& scenario) {
  if (scenario.deposition.method == scenario::DepositionMethod::file) return 0.0;
  return static_cast<double>(session::estimate(scenario).deposition_steps);
}

/// Returns the fraction of the phase done; above 1 if it takes longer than expected, empty if unknown.
std::optional<double> share_of(const session::Session& session, RunPace& pace) {
  const scenario::Scenario& scenario = session.scenario();
  if (session.phase() == session::Phase::deposition) {
    if (!pace.deposition_steps) pace.deposition_steps = expected_deposition(scenario);
    if (*pace.deposition_steps == 0.0) return std::nullopt;
    return static_cast<double>(session.world().step) / *pace.deposition_steps;
  }
  if (session.phase() == session::Phase::flow) return std::nullopt;
  if (!session.follows_program() && session.tilt_rate() < 0.0) return std::nullopt;
  if (!session.follows_program())
    return degrees(session.world().tilt) / scenario.tilt.end_angle.value_or(session::assumed_repose);
  if (!pace.program_steps) pace.program_steps = static_cast<double>(session::expected_tilt_steps(scenario));
  return static_cast<double>(session.schedule().tilt_steps) / *pace.program_steps;
}

RunDisplay display_of(const session::Session& session, RunPace& pace) {
  const World& world = session.world();
  const dynamics::StepReport& report = session.last_report();
  const bool until_failure =
      session.follows_program() ? session.program().ends_at_repose() : !session.scenario().tilt.end_angle;
  RunDisplay shown{
      .phase = session.phase() == session::Phase::done ? session::Phase::tilt : session.phase(),
      .time = world.time,
      .tilt = degrees(world.tilt),
      .share = share_of(session, pace),
      .repose_assumed = {},
      .residual = report.solver.residual.eta,
      .kinetic_energy = report.motion.kinetic_energy,
      .velocity = report.motion.rms_velocity / (world.gravity * scenario::time_step(session.scenario())),
      .contacts = report.contacts};
  if (shown.phase == session::Phase::tilt && until_failure) shown.repose_assumed = session::assumed_repose;
  return shown;
}

/// Returns the seconds until the end of the phase, at the pace since this process began it.
std::optional<double> remaining(const RunDisplay& shown, double elapsed, RunPace& pace) {
  if (!shown.share) return std::nullopt;
  if (pace.phase != shown.phase) {
    pace.phase = shown.phase;
    pace.began = elapsed;
    pace.began_with = *shown.share;
  }
  const double speed = (*shown.share - pace.began_with) / (elapsed - pace.began + 1e-9);
  return speed > 0.0 ? std::optional((1.0 - *shown.share) / speed) : std::nullopt;
}

}  // namespace

std::string progress_text(const Progress& progress, std::optional<int> width) {
  const std::optional<double>& share = progress.share;
  std::vector<std::pair<std::string, int>> fields = {{progress.what, 0}};
  const bool known = share && *share >= 0.0 && *share <= 1.0;
  if (known && width) fields.emplace_back(progress_bar(*share), 4);
  if (known) fields.emplace_back(fmt::format("{:.0f} %", std::floor(100.0 * *share)), 3);
  fields.emplace_back("elapsed " + session::duration_text(progress.elapsed), 2);
  if (known && progress.remaining)
    fields.emplace_back("ETA " + session::duration_text(*progress.remaining), 1);
  fields.insert(fields.end(), progress.more.begin(), progress.more.end());
  const auto columns = static_cast<std::size_t>(std::max(0, width.value_or(1 << 20)));
  for (int highest = 9;; --highest) {
    std::string line;
    for (const auto& [text, rank] : fields)
      if (rank <= highest) line.append(line.empty() ? "" : "  ").append(text);
    if (line.size() <= columns || highest == 0) return line.substr(0, columns);
  }
}

Progress count_progress(const std::string& label, std::size_t done, std::size_t count, double elapsed) {
  Progress progress{fmt::format("{} {}/{}", label, done, count), {}, elapsed, {}};
  if (count > 0) progress.share = static_cast<double>(done) / static_cast<double>(count);
  if (done > 0 && done < count)
    progress.remaining = elapsed / static_cast<double>(done) * static_cast<double>(count - done);
  return progress;
}

Progress run_progress(const RunDisplay& shown, double elapsed, std::optional<double> remaining) {
  const bool deposition = shown.phase == session::Phase::deposition;
  Progress progress{deposition ? fmt::format("deposition {:.3f} s", shown.time)
                    : shown.phase == session::Phase::flow
                        ? fmt::format("flow at {} deg", fixed_text(shown.tilt, 3))
                        : fmt::format("tilt {} deg", fixed_text(shown.tilt, 3)),
                    shown.share, elapsed, remaining};
  if (shown.repose_assumed && shown.share && *shown.share <= 1.0)
    progress.more.emplace_back(fmt::format("if it fails at {:.0f} deg", *shown.repose_assumed), 6);
  progress.more.emplace_back(fmt::format("residual {:.1e}", shown.residual), 5);
  if (deposition)
    progress.more.emplace_back(fmt::format("contacts {}", shown.contacts), 7);
  else
    progress.more.emplace_back(fmt::format("E_kin {:.1e} J", shown.kinetic_energy), 8);
  progress.more.emplace_back(fmt::format("v = {:.2e} g h", shown.velocity), 7);
  return progress;
}

StatusLine::StatusLine(bool quiet, double on_terminal, double in_log)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), interval_(terminal_ ? on_terminal : in_log) {}

bool StatusLine::is_due(bool at_end) const {
  return !quiet_ && ((at_end && terminal_) || Clock::now() - shown_ >= interval_);
}

void StatusLine::show(const Progress& progress) {
  if (quiet_) return;
  shown_ = Clock::now();
  print_status(progress_text(progress, terminal_ ? std::optional(columns_of_terminal()) : std::nullopt),
               terminal_);
  open_ = terminal_;
}

void StatusLine::finish() {
  if (open_) print_error("\n");
  open_ = false;
}

CountDone count_shown(std::string label, bool quiet) {
  return [label = std::move(label), quiet, line = std::shared_ptr<StatusLine>()](std::size_t done,
                                                                                 std::size_t count) mutable {
    if (!line) line = std::make_shared<StatusLine>(quiet, seconds_on_terminal, 5.0);
    const bool last = done > 0 && done == count;
    if (!line->is_due(last)) return;
    line->show(count_progress(label, done, count, line->elapsed()));
    if (last) line.reset();  // a new count starts another line
  };
}

std::function<void(const session::RunProgress&)> run_shown(bool quiet) {
  return [pace = std::make_shared<RunPace>(quiet)](const session::RunProgress& progress) {
    if (!pace->line.is_due()) return;
    const RunDisplay shown = display_of(progress.session, *pace);
    const double elapsed = progress.wall_seconds;
    pace->line.show(run_progress(shown, elapsed, remaining(shown, elapsed, *pace)));
  };
}

StepRemark remark_on(const session::SolverRecord& record, std::int64_t steps) {
  const std::int64_t missed = record.unconverged();
  if (missed == 0) return {};
  const double share = static_cast<double>(missed) / static_cast<double>(std::max<std::int64_t>(1, steps));
  const bool usual = share <= session::usual_unconverged_share;
  const std::string text = fmt::format(
      "{:.2g} % of the steps did not reach their tolerance (largest residual in the tilt {:.2g} at rest, "
      "{:.2g} while moving)",
      100.0 * share, record.residual_max_rest, record.residual_max_moving);
  if (usual) return {true, fmt::format("{}; this is usual (docs/solver.md).", text)};
  return {false, fmt::format("{}: {} in the deposition, {} in the tilt, {} after failure; up to {:g} % is "
                             "usual (docs/solver.md); raise solver.max_iterations",
                             text, record.unconverged_deposition, record.unconverged_tilt,
                             record.unconverged_flow, 100.0 * session::usual_unconverged_share)};
}

}  // namespace talus::app
