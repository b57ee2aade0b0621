/// What a child process may send of a problem file that HDF5 has made nonsense of: decoded, checked, solved.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/errors.h"
#include "io/fclib_file.h"
#include "io/foreign_file.h"
#include "session/problem_file.h"
#include "solver/local_solvers.h"
#include "solver/solve.h"

namespace {

using namespace talus;

void solve_a_little(const StoredProblem& stored) {
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ForeignFile file = decode(std::as_bytes(std::span(data, size)), "p.h5");
    solve_a_little(stored_problem("p.h5", checked_problem("p.h5", file)));
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data) std::abort();
  }
  return 0;
}
