/// Estimates of `talus check` for a run.

#include "session/estimate.h"

#include <gtest/gtest.h>

namespace talus::session {
namespace {

TEST(Estimate, counts_what_the_scenario_says) {
  scenario::Scenario scenario;
  scenario.bed.length = 50.5;
  scenario.bed.depth = 20.0;
  scenario.tilt.rate = 2.0;
  scenario.tilt.step = 0.004;
  scenario.tilt.end_angle = 10.0;
  scenario.output.frame_every = 0.5;
  scenario.output.observable_every = 0.1;
  const Estimate expected = estimate(scenario);
  EXPECT_EQ(expected.grains, 1010);
  EXPECT_EQ(expected.floor_grains, 50);
  EXPECT_DOUBLE_EQ(expected.time_step, 0.002);
  EXPECT_EQ(expected.tilt_steps, 2500);
  EXPECT_EQ(expected.frames, 21);
  EXPECT_EQ(expected.observable_rows, 101);
}

TEST(Estimate, counts_the_flow_after_failure_as_what_it_may_be) {
  scenario::Scenario scenario;
  scenario.tilt.after_failure = scenario::AfterFailure::lower;
  const Estimate expected = estimate(scenario), without = estimate({});
  EXPECT_GT(expected.flow_steps, 0);
  EXPECT_NEAR(static_cast<double>(expected.frames - without.frames),
              static_cast<double>(expected.flow_steps) * scenario.tilt.step / scenario.output.frame_every,
              1.0);
  EXPECT_GT(expected.disk, without.disk);
}

TEST(Estimate, a_long_flow_that_may_end_soon_needs_no_memory) {
  scenario::Scenario scenario;
  scenario.tilt.after_failure = scenario::AfterFailure::lower;
  scenario.tilt.lowering_rate = 1e-4;
  EXPECT_GT(estimate(scenario).memory, 1e11);
  EXPECT_NO_THROW(require_memory(scenario));
}

TEST(Estimate, a_smooth_floor_has_no_grains) {
  scenario::Scenario scenario;
  scenario.bed.floor = scenario::BedFloor::smooth;
  EXPECT_EQ(estimate(scenario).floor_grains, 0);
}

TEST(Estimate, a_bed_of_the_paper_is_a_matter_of_minutes_and_megabytes) {
  const Estimate expected = estimate({});
  EXPECT_EQ(expected.grains, 8000);
  EXPECT_EQ(expected.tilt_steps, 20000);
  EXPECT_GT(expected.seconds, 60.0);
  EXPECT_LT(expected.seconds, 7200.0);
  EXPECT_GT(expected.memory, 5e7);
  EXPECT_LT(expected.memory, 1e9);
  EXPECT_GT(expected.disk, 1e7);
  EXPECT_LT(expected.disk, 2e8);
}

TEST(Estimate, grows_with_all_that_costs) {
  const Estimate usual = estimate({});
  scenario::Scenario longer;
  longer.bed.length *= 2.0;
  EXPECT_GT(estimate(longer).seconds, 1.9 * usual.seconds);
  EXPECT_GT(estimate(longer).memory, 1.5 * usual.memory);
  scenario::Scenario more_frames;
  more_frames.output.frame_every /= 10.0;
  EXPECT_GT(estimate(more_frames).disk, 8.0 * usual.disk);
  EXPECT_GT(estimate(more_frames).memory, usual.memory);
  scenario::Scenario exact;
  exact.solver.tolerance = 1e-10;
  EXPECT_GT(estimate(exact).seconds, usual.seconds);
  scenario::Scenario reference;
  reference.solver.method = scenario::SolverMethod::gauss_seidel;
  EXPECT_GT(estimate(reference).seconds, 2.0 * usual.seconds);
  scenario::Scenario hurried;
  hurried.solver.max_iterations = 10;
  EXPECT_LT(estimate(hurried).seconds, 0.15 * usual.seconds);
}

}  // namespace
}  // namespace talus::session
