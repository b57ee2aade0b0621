/// Siconos's solvers that work on a dense matrix, on the smallest bed: one solver, one row of a Markdown
/// table. Their time is practically unlimited; run.sh ends them.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "beds.h"
#include "frozen_step.h"
#include "program.h"
#include "siconos_peer.h"
#include "solver/problem.h"

namespace talus::bench {
namespace {

struct Peer {
  SiconosSolver solver;
  int max_iterations;
};
const std::map<std::string, Peer> peers = {
    {"nsgs", {SiconosSolver::nsgs, 20000}},
    {"cpg", {SiconosSolver::cpg, 20000}},
    {"lemke", {SiconosSolver::lemke, 1000000}},
    {"enumeration", {SiconosSolver::enumeration, 1000000}},
};

int run(int argc, char** argv) {
  std::string name;
  Index grains = 500;
  double tolerance = 1e-4;
  CLI::App app("One of Siconos's 2D solvers on a dense matrix, cold, on a bed at rest");
  app.add_option("solver", name, "nsgs, cpg, lemke or enumeration")->required()->check(CLI::IsMember(peers));
  app.add_option("--grains", grains, "Size of the bed")->capture_default_str();
  app.add_option("--tolerance", tolerance, "Required error by Siconos's measure")->capture_default_str();
  CLI11_PARSE(app, argc, argv)

  const FrozenStep step =
      dimensionless_next_step(bed(grains, Slope::flat, seconds_of(5e-3)), 5e-3, Candidates::close);
  const solver::LocalProblem local = local_problem(step.problem);
  solver::LocalSolution answer;
  answer.p.resize(local.mu.size());
  SiconosProblem problem(local, Storage::dense);
  const Peer& peer = peers.at(name);
  const SiconosReport report = problem.solve(peer.solver, tolerance, peer.max_iterations, answer.p);
  solver::velocities_from_impulses(local, answer);
  std::printf("| %s | %d | %d | %d | %.3g | %d | %.2e |\n", name.c_str(), grains, local.contact_count(),
              report.info, report.seconds, report.iterations, problem.error(answer.p));
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  return talus::bench::run_program("siconos_dense_bench", talus::bench::run, argc, argv);
}
