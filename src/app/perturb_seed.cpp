#include "app/perturb_seed.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>

#include "app/progress.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "session/perturbation_threshold.h"
#include "session/run_header.h"

namespace talus {
namespace {

void write_table(const std::string& run, const PerturbationTable& table) {
  const std::string path = perturbation_table_path(run);
  const std::string text = perturbation_csv(table);
  write_durably(path, std::as_bytes(std::span(text)), path + ".part");
}

/// The tilt of a session in deg, to the step.
double tilt_of(const Session& session) {
  const double step = session.scenario().tilt.step;
  return static_cast<double>(std::llround(degrees(session.world().tilt) / step)) * step;
}

/// Whether the session stands at a tilt of the plan, on its way to failure.
bool is_due(const Session& session, const PerturbationPlan& plan) {
  if (session.phase() != Phase::tilt || session.angle_of_repose()) return false;
  const auto steps = [&](double angle) { return std::llround(angle / session.scenario().tilt.step); };
  const auto since_first = steps(tilt_of(session)) - steps(plan.first);
  return since_first >= 0 && since_first % std::max(1LL, steps(plan.every)) == 0;
}

/// "[0.32, 0.37] sqrt(g D)": between what started no avalanche and what did.
std::string bracket_text(const Threshold& threshold) {
  if (!threshold.held) return "does not hold by itself";
  char text[96];
  if (std::isinf(threshold.with))
    std::snprintf(text, sizeof text, "no avalanche up to %.3g sqrt(g D)", threshold.without);
  else
    std::snprintf(text, sizeof text, "threshold in [%.3g, %.3g] sqrt(g D)%s", threshold.without,
                  threshold.with, threshold.monotone ? "" : ", erratic");
  return text;
}

/// Steps the run to its end, with the trials of each state that is not in the table yet.
void carry_through(OpenRun& open, PerturbationTable& table, const std::string& output) {
  const volatile std::sig_atomic_t* stop = catch_stop_signals();
  const auto keep_on = [stop] {
    if (*stop != 0) throw Error(ExitCode::stopped, "stopped; the same command goes on with it");
  };
  ProgressLine line(false);
  RunControl control;
  control.stop = stop;
  control.on_step = [&](const RunProgress& progress) {
    line.show(progress);
    const Session& session = progress.session;
    const double tilt = tilt_of(session);
    const bool done = !table.states.empty() && table.states.back().tilt >= tilt;
    if (done || !is_due(session, table.plan)) return;
    table.states.push_back({tilt, perturb(session.world(), session.scenario(), table.plan.patch, keep_on)});
    write_table(output, table);
    line.finish();
    std::fprintf(stderr, "%.3f deg: %s\n", tilt,
                 bracket_text(threshold_of(table.states.back().trials)).c_str());
  };
  const RunEnd end = run_to_end(open.session, open.store, control);
  line.finish();
  if (end == RunEnd::stopped) keep_on();
}

}  // namespace

std::string perturbation_table_path(const std::string& run) {
  return std::filesystem::path(run).replace_extension(".csv").string();
}

PerturbationTable read_perturbation_table(const std::string& run, const PerturbationPlan& plan) {
  const std::string path = perturbation_table_path(run);
  const std::vector<std::byte> bytes = read_file(path);
  return parse_perturbation_csv({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, plan);
}

bool is_perturbed(const RunRequest& request, const PerturbationPlan& plan) {
  const RunPresence presence = run_presence(request.output);
  if (presence == RunPresence::none) return false;
  if (stored_scenario(RunFile::open(request.output).header(), request.output + ":/parameters") !=
      read_scenario(request.scenario, request.settings))
    throw Error(ExitCode::bad_data, request.output + " is a run of another scenario; give another folder");
  if (!std::filesystem::exists(perturbation_table_path(request.output)))
    throw Error(ExitCode::bad_data, request.output + " has no table beside it, expected " +
                                        perturbation_table_path(request.output) +
                                        "; give another folder, or remove the run");
  return read_perturbation_table(request.output, plan).complete;
}

void perturb_seed(const RunRequest& request, const PerturbationPlan& plan) {
  if (is_perturbed(request, plan)) return;
  const RunPresence presence = run_presence(request.output);
  PerturbationTable table{plan, false, {}};
  if (presence == RunPresence::none)
    write_table(request.output, table);
  else
    table = read_perturbation_table(request.output, plan);
  if (presence != RunPresence::packed) {
    OpenRun open = presence == RunPresence::folder ? resume_run(request) : start_run(request);
    open.session.use_threads(request.threads);
    carry_through(open, table, request.output);
  }
  table.complete = true;
  write_table(request.output, table);
}

}  // namespace talus
