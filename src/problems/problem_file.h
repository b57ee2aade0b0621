#pragma once
/// Reading and writing of contact problems in problem files (docs/problem_files.md).

#include <optional>
#include <string>

#include "problems/step_problem.h"
#include "solver/local_problem.h"

namespace talus::problems {

struct FclibProblem;

/// Contents of a problem file: W, q and mu, and, if Talus wrote it, the step to which they belong.
struct StoredProblem {
  solver::LocalProblem local;
  std::vector<solver::Impulse> guess;  ///< zero if the file has none
  std::optional<StepProblem> step;     ///< step as written, bit for bit, with the velocities of its guess
};

/// Writes the problem of a step; `title` states its origin.
void write_problem(const std::string& path, const StepProblem& step, const std::string& title);

/// Converts the contents of a file called `path`. Throws Error(bad_data) if its bodies are invalid.
StoredProblem stored_problem(const std::string& path, const FclibProblem& file);
/// Reads a problem file. Throws the errors of read_fclib and stored_problem.
StoredProblem read_problem(const std::string& path);

/// Writes a copy of the problem file `from` with the solution to `to`.
void write_solution(const std::string& from, const std::string& to, const solver::LocalSolution& solution);

}  // namespace talus::problems
