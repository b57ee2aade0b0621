#include "reliability/hostile_run.h"

#include "base/hash.h"
#include "core/trigonometry.h"
#include "io/packed_file.h"
#include "problems/local_solvers.h"
#include "problems/step_problem.h"
#include "runs/analysis_run.h"
#include "session/run.h"
#include "session/run_header.h"
#include "solver/solve.h"
#include "support/small_bed.h"

namespace talus::hostile {
namespace {

scenario::Scenario small_bed() {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.bed.boundary = scenario::BedBoundary::walls;
  scenario.bed.depth = 2.0;
  return scenario;
}

void compute(const std::string& path, double tilt, bool complete) {
  session::Session session(small_bed());
  io::RunStore store = io::RunStore::create(path, session::run_header(session, {}), false);
  volatile std::sig_atomic_t stop = 0;
  session::RunControl control;
  control.stop = &stop;
  control.on_step = [&](const session::RunProgress& progress) {
    stop = progress.session.world().tilt >= radians(tilt) ? 1 : 0;
  };
  session.apply({0, CommandKind::push, 4, 0.2, 0.3});
  session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  while (!complete && session.phase() == session::Phase::deposition) session.advance();
  session::run_to_end(session, store, control);
}

}  // namespace

void make_run(const std::string& path) {
  compute(path, 90.0, true);
  const io::RunFile run = io::RunFile::open(path);
  const analysis::Analysis analysis = runs::analyse_run(run, {}, 1, {});
  io::store_analysis(path, analysis, hash_text(state_hash(run.checkpoint().world)));
}

void make_folder_of_run(const std::string& path, double tilt) { compute(path, tilt, false); }

void make_problem(const std::string& run, const std::string& path) {
  problems::write_problem(path, problems::problem_after_frame(io::RunFile::open(run), 1), "to spoil");
}

void use_run(const std::string& path) { use_run(io::RunFile::open(path), path); }

void use_run(const io::RunFile& run, const std::string& path) {
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) run.frame(k);
  run.all_observables();
  run.steps();
  run.commands();
  if (run.complete()) io::read_analysis(path);
  session::Session session(scenario::parse_scenario(run.header().scenario_resolved, path + ":/parameters"),
                           run.checkpoint(), path);
  session.advance();
  if (run.frame_count() == 0) return;
  runs::analyse_run(run, {}, 1, {});
  problems::problem_after_frame(run, 0);
}

void use_problem(const std::string& path) { use_problem(problems::read_problem(path)); }

void use_problem(const problems::StoredProblem& stored) {
  solver::SolverSettings settings;
  settings.max_iterations = 3;
  solver::LocalSolution solution;
  solution.p = stored.guess;
  problems::solve(stored.local, settings, solution);
  if (!stored.step) return;
  solver::SolverWorkspace workspace;
  solver::ContactSolution of_bodies = stored.step->guess;
  solver::solve(stored.step->problem, settings, workspace, of_bodies);
}

}  // namespace talus::hostile
