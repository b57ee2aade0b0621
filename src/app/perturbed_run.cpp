#include "app/perturbed_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <utility>

#include "app/terminal.h"
#include "base/errors.h"
#include "core/trigonometry.h"
#include "session/perturbation_threshold.h"

namespace talus::app {
namespace {

/// Returns the tilt of a session in deg, rounded to the step.
double tilt_of(const session::Session& session) {
  const double step = session.scenario().tilt.step;
  return static_cast<double>(std::llround(degrees(session.world().tilt) / step)) * step;
}

/// Whether the session is at a tilt of the plan, before failure.
bool is_due(const session::Session& session, const session::PerturbationPlan& plan) {
  if (session.phase() != session::Phase::tilt || session.angle_of_repose()) return false;
  const auto steps = [&](double angle) { return std::llround(angle / session.scenario().tilt.step); };
  const auto since_first = steps(tilt_of(session)) - steps(plan.first);
  return since_first >= 0 && since_first % std::max(1LL, steps(plan.every)) == 0;
}

/// Returns "[0.32, 0.37] sqrt(g D)": the strongest push without an avalanche and the weakest with one.
std::string bracket_text(const session::Threshold& threshold) {
  if (!threshold.held) return "does not hold without a push";
  if (std::isinf(threshold.with))
    return fmt::format("no avalanche up to {:.3g} sqrt(g D)", threshold.without);
  return fmt::format("threshold in [{:.3g}, {:.3g}] sqrt(g D){}", threshold.without, threshold.with,
                     threshold.monotone ? "" : ", erratic");
}

}  // namespace

std::function<std::vector<TrialRow>(const session::Session&)> intermediate_trials(
    session::PerturbationTable known, const volatile std::sig_atomic_t* stop) {
  const auto should_continue = [stop] {
    if (*stop != 0)
      throw Error(ExitCode::stopped, "the trials were stopped; those of this state will be repeated");
  };
  return [should_continue, table = std::move(known)](const session::Session& session) mutable {
    const double tilt = tilt_of(session);
    const bool done = !table.states.empty() && table.states.back().tilt >= tilt;
    if (done || !is_due(session, table.plan)) return std::vector<TrialRow>();
    table.states.push_back(
        {tilt, session::perturb(session.world(), session.scenario(), table.plan.patch, should_continue)});
    print_error("%.3f deg: %s\n", tilt,
                bracket_text(session::threshold_of(table.states.back().trials)).c_str());
    return session::rows_of(table.states.back(), session.world().step);
  };
}

}  // namespace talus::app
