#include "reliability/hostile_run.h"

#include "base/hash.h"
#include "core/trigonometry.h"
#include "io/analysis_file.h"
#include "problems/local_solvers.h"
#include "problems/step_problem.h"
#include "runs/analysis_run.h"
#include "session/run.h"
#include "session/run_header.h"
#include "solver/solve.h"
#include "support/small_bed.h"

namespace talus::hostile {
namespace {

Scenario small_bed() {
  Scenario scenario = test::small_tilted_bed(1.0);
  scenario.bed.boundary = BedBoundary::walls;
  scenario.bed.depth = 2.0;
  return scenario;
}

void compute(const std::string& path, double tilt, bool complete) {
  Session session(small_bed());
  RunStore store = RunStore::create(path, run_header(session, {}), false);
  volatile std::sig_atomic_t stop = 0;
  RunControl control;
  control.stop = &stop;
  control.on_step = [&](const RunProgress& progress) {
    stop = progress.session.world().tilt >= radians(tilt) ? 1 : 0;
  };
  session.apply({0, CommandKind::push, 4, 0.2, 0.3});
  session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  while (!complete && session.phase() == Phase::deposition) session.advance();
  run_to_end(session, store, control);
}

}  // namespace

void make_run(const std::string& path) {
  compute(path, 90.0, true);
  const RunFile run = RunFile::open(path);
  const Analysis analysis = analyse_run(run, {}, 1, {});
  store_analysis(path, analysis, hash_text(state_hash(run.checkpoint().world)));
}

void make_folder_of_run(const std::string& path, double tilt) { compute(path, tilt, false); }

void make_problem(const std::string& run, const std::string& path) {
  write_problem(path, problem_after_frame(RunFile::open(run), 1), "to spoil");
}

void use_run(const std::string& path) { use_run(RunFile::open(path), path); }

void use_run(const RunFile& run, const std::string& path) {
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) run.frame(k);
  run.all_observables();
  run.steps();
  run.commands();
  if (run.complete()) read_analysis(path);
  Session session(parse_scenario(run.header().scenario_resolved, path + ":/parameters"), run.checkpoint(),
                  path);
  session.advance();
  if (run.frame_count() == 0) return;
  analyse_run(run, {}, 1, {});
  problem_after_frame(run, 0);
}

void use_problem(const std::string& path) { use_problem(read_problem(path)); }

void use_problem(const StoredProblem& stored) {
  SolverSettings settings;
  settings.max_iterations = 3;
  LocalSolution solution;
  solution.p = stored.guess;
  solve(stored.local, settings, solution);
  if (!stored.step) return;
  SolverWorkspace workspace;
  ContactSolution of_bodies = stored.step->guess;
  solve(stored.step->problem, settings, workspace, of_bodies);
}

}  // namespace talus::hostile
