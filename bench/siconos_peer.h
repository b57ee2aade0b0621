#pragma once
/// Siconos's solvers for frictional contact in two dimensions, with an interface of plain data.

#include <memory>

#include "solver/local_problem.h"

namespace talus::bench {

/// Identifiers of Siconos's solvers.
enum class SiconosSolver : int {
  nsgs = 400,   ///< nonsmooth Gauss-Seidel, the only one that keeps the matrix sparse
  cpg = 402,    ///< conjugate projected gradient
  lemke = 404,  ///< Lemke's pivoting on a linear complementarity problem
  enumeration = 405,
};

struct SiconosReport {
  int info = 0;          ///< 0 if Siconos reports convergence
  int iterations = 0;    ///< sweeps
  double error = 0.0;    ///< error that Siconos reports
  double seconds = 0.0;  ///< processor time of the calling thread
};

/// Siconos's storage of W.
enum class Storage { sparse_blocks, dense };

/// A problem in Siconos's form, with copies of the data of `local`.
class SiconosProblem {
 public:
  SiconosProblem(const solver::LocalProblem& local, Storage storage);
  ~SiconosProblem();
  SiconosProblem(const SiconosProblem&) = delete;
  SiconosProblem& operator=(const SiconosProblem&) = delete;

  /// Solves from the first guess in `p`; only the call of the solver is timed.
  SiconosReport solve(SiconosSolver solver, double tolerance, int max_iterations,
                      std::vector<solver::Impulse>& p);

  /// Returns fc2d_compute_error, relative to the largest of || P ||, || U || and || q ||.
  double error(std::vector<solver::Impulse> p);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace talus::bench
