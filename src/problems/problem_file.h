#pragma once
/// Contact problems to and from problem files (docs/problem_files.md).

#include <optional>
#include <string>

#include "problems/step_problem.h"
#include "solver/local_problem.h"

namespace talus::problems {

struct FclibProblem;

/// What a problem file holds: W, q and mu, and where Talus wrote it, the step they belong to.
struct StoredProblem {
  solver::LocalProblem local;
  std::vector<solver::Impulse> guess;  ///< zero where the file has none
  std::optional<StepProblem> step;     ///< as it was written, bit for bit; velocities of its guess included
};

/// `title` says where the problem comes from.
void write_problem(const std::string& path, const StepProblem& step, const std::string& title);

/// The problem in a file called `path`. Throws Error(bad_data) where its bodies cannot be.
StoredProblem stored_problem(const std::string& path, const FclibProblem& file);
/// Throws as read_fclib and stored_problem do.
StoredProblem read_problem(const std::string& path);

/// A copy of the problem file `from` with the solution in it.
void write_solution(const std::string& from, const std::string& to, const solver::LocalSolution& solution);

}  // namespace talus::problems
