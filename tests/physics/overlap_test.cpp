#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "support/scenes.h"

namespace talus {
namespace {

// The residual bounds the overlap of a step: |P'_n - P_n| <= eta ||P||, so U_n >= - W_nn eta ||P||, and a gap
// shrinks by at most h times that, because the distance of two disks is convex. In each step the share alpha
// of the excess over ten allowed overlaps is corrected, d <- (1 - alpha) d + h W_nn eta ||P||, so the overlap
// exceeds ten allowed overlaps by at most h W_nn eta ||P|| / alpha.
double overlap_bound(const World& world, const dynamics::StepSettings& settings, double eta, double impulse) {
  const Grains& g = world.grains;
  const double lightest = *std::max_element(g.inverse_mass.begin(), g.inverse_mass.end());
  return 10.0 * settings.law.allowed_overlap +
         settings.h * 2.0 * lightest * eta * impulse / settings.law.overlap_correction;
}

/// Returns ||P|| of the last step, N s.
double impulse_norm(const World& world, double h) {
  double sum = 0.0;
  for (Index c = 0; c < world.contacts.count(); ++c)
    sum += world.contacts.fn[c] * world.contacts.fn[c] + world.contacts.ft[c] * world.contacts.ft[c];
  return h * std::sqrt(sum);
}

struct LongRun {
  double largest_overlap = 0.0;
  double bound = 0.0;
};

/// Rocks a heap of 14 grains at rest between walls by 3 degrees in both directions for `steps` steps. By
/// then, overlaps left by the unchecked residuals of the fall have disappeared.
LongRun rock_heap(double tolerance, double allowed_overlap, int steps) {
  dynamics::StepSettings settings = test::bed_step(tolerance);
  settings.law.allowed_overlap = allowed_overlap;
  World world = test::settled_bed(test::bed_plan(false, 14, 6, 2), settings);
  dynamics::StepWorkspace workspace;
  for (int k = 0; k < 200; ++k) dynamics::step(world, settings, workspace);
  LongRun run;
  double eta = 0.0, impulse = 0.0;
  for (int k = 0; k < steps; ++k) {
    const int phase = k % 6000;
    world.tilt = radians(1e-3 * (phase < 3000 ? phase : 6000 - phase));
    const dynamics::StepReport report = dynamics::step(world, settings, workspace);
    eta = std::max(eta, report.solver.residual.eta);
    impulse = std::max(impulse, impulse_norm(world, settings.h));
    run.largest_overlap = std::max(run.largest_overlap, report.largest_overlap);
  }
  run.bound = overlap_bound(world, settings, eta, impulse);
  return run;
}

struct Rocked {
  double tolerance, allowed_overlap;
  int steps;
  double limit;  ///< D
};

// The last with a margin for the few steps whose residual exceeds the requested tolerance.
TEST(Overlap, stays_below_what_the_residual_and_the_law_allow) {
  const double diameter = dynamics::BedPlan{}.mean_diameter;
  for (const Rocked& rocked :
       {Rocked{1e-6, 0.0, 100000, 1e-5}, {1e-6, 1e-6 * diameter, 100000, 1e-4}, {1e-12, 0.0, 24000, 1e-9}}) {
    const LongRun run = rock_heap(rocked.tolerance, rocked.allowed_overlap, rocked.steps);
    SCOPED_TRACE(run.largest_overlap / diameter);
    EXPECT_LT(run.largest_overlap, run.bound);
    EXPECT_LT(run.largest_overlap, rocked.limit * diameter);
    EXPECT_TRUE(run.largest_overlap > 0.0 || rocked.allowed_overlap == 0.0);
  }
}

// Ten times the round-off of a position: neither overlap nor creep.
TEST(Overlap, a_column_does_not_sink) {
  World world = test::column(3);
  const Grains start = world.grains;
  dynamics::StepSettings settings = test::exact_step(solver::SolverKind::gauss_seidel);
  settings.solver.tolerance = 1e-13;
  dynamics::StepWorkspace workspace;
  double overlap = 0.0;
  for (int k = 0; k < 100000; ++k)
    overlap = std::max(overlap, dynamics::step(world, settings, workspace).largest_overlap);
  EXPECT_LT(overlap, 1e-14);

  for (Index i = 0; i < 3; ++i) EXPECT_NEAR(world.grains.y[i], start.y[i], 1e-14);
}

}  // namespace
}  // namespace talus
