#include "app/moving_step.h"

#include <fmt/core.h>

namespace talus::app {

namespace {

/// Uses the criterion of the solvers (solver/solve.cpp).
bool reached(double eta, double tolerance) { return eta <= tolerance * (1.0 + 1e-9); }

}  // namespace

bool is_moving(const problems::StepTolerance& run_tolerance) {
  return run_tolerance.asked > run_tolerance.at_rest;
}

std::string remark_on_moving(const problems::StepTolerance& run_tolerance, double eta) {
  const char* which = reached(eta, run_tolerance.at_rest) ? "both of them"
                      : reached(eta, run_tolerance.asked) ? "only the first"
                                                          : "neither of them";
  return fmt::format(
      "The bed was moving in this step, at {:.2g} g h (rms), so the run required {:.1e} instead of the "
      "{:.1e} of a bed at rest; this solve has reached {}.",
      run_tolerance.velocity, run_tolerance.asked, run_tolerance.at_rest, which);
}

}  // namespace talus::app
