/// Flow after failure, which stops when the tilt is lowered or when the surface has relaxed.

#include <gtest/gtest.h>

#include <optional>

#include "core/trigonometry.h"
#include "session/session.h"
#include "stress/free_surface.h"
#include "support/recorded_run.h"

namespace talus {
namespace {

/// Returns a small bed that is tilted fast and fails within a second of simulated time.
scenario::Scenario bed(scenario::AfterFailure after_failure,
                       scenario::BedBoundary boundary = scenario::BedBoundary::periodic) {
  scenario::Scenario scenario;
  scenario.bed.length = 20.0;
  scenario.bed.depth = 6.0;
  scenario.bed.boundary = boundary;
  scenario.deposition.rest_velocity = 0.05;
  scenario.tilt.rate = 20.0;
  scenario.tilt.step = 0.02;
  scenario.tilt.after_failure = after_failure;
  scenario.tilt.lowering_rate = 20.0;
  scenario.output.frame_every = 1.0;
  scenario.output.observable_every = 0.2;
  return scenario;
}

session::Session run_to_failure(const scenario::Scenario& scenario) {
  session::Session session = test::tilting(scenario);
  while (session.phase() == session::Phase::tilt) session.advance();
  return session;
}

bool at_rest(const session::Session& session) {
  const scenario::Scenario& scenario = session.scenario();
  return rms_velocity(session.world().grains) <=
         scenario.deposition.rest_velocity * session.world().gravity * scenario::time_step(scenario);
}

TEST(Avalanche, failure_ends_the_run_unless_told) {
  const session::Session session = run_to_failure(bed(scenario::AfterFailure::stop));
  EXPECT_EQ(session.phase(), session::Phase::done);
  EXPECT_TRUE(session.angle_of_repose());
  EXPECT_FALSE(session.angle_at_rest());
}

TEST(Avalanche, stops_when_the_tilt_is_lowered) {
  scenario::Scenario scenario = bed(scenario::AfterFailure::lower);
  scenario.tilt.end_angle = 60.0;  // failure comes first
  session::Session session = run_to_failure(scenario);
  ASSERT_EQ(session.phase(), session::Phase::flow);
  const double highest = session.world().tilt;
  EXPECT_FALSE(at_rest(session));
  EXPECT_FALSE(session.angle_at_rest());
  session.advance();
  EXPECT_NEAR(highest - session.world().tilt, radians(20.0) * 1e-3, 1e-12) << "lowering_rate * h";
  test::run_session(session);
  EXPECT_TRUE(at_rest(session));
  ASSERT_TRUE(session.angle_at_rest());
  EXPECT_EQ(*session.angle_at_rest(), session.world().tilt) << "the only slope of a periodic bed";
  EXPECT_LT(*session.angle_at_rest(), *session.angle_of_repose());
  EXPECT_GT(*session.angle_at_rest(), 0.0);
}

// The same failure with a slower decrease of the tilt, which gives the flow more time to follow.
TEST(Avalanche, lags_behind_a_tilt_that_falls_faster) {
  scenario::Scenario scenario = bed(scenario::AfterFailure::lower);
  session::Session fast = run_to_failure(scenario);
  scenario.tilt.lowering_rate = 5.0;
  session::Session slow = run_to_failure(scenario);
  EXPECT_EQ(state_hash(fast.world()), state_hash(slow.world()));
  test::run_session(fast);
  test::run_session(slow);
  ASSERT_TRUE(fast.angle_at_rest() && slow.angle_at_rest());
  EXPECT_GT(*slow.angle_at_rest(), *fast.angle_at_rest());
}

TEST(Avalanche, that_has_not_stopped_at_0_deg_has_no_angle_at_rest) {
  scenario::Scenario scenario = bed(scenario::AfterFailure::lower);
  scenario.tilt.lowering_rate = 100.0;
  scenario.deposition.rest_velocity = 1e-9;
  session::Session session = run_to_failure(bed(scenario::AfterFailure::lower));
  session::Session impatient(scenario, session.checkpoint(0.0));
  test::run_session(impatient);
  EXPECT_EQ(impatient.world().tilt, 0.0);
  EXPECT_FALSE(impatient.angle_at_rest());
}

TEST(Avalanche, that_is_held_where_nothing_stops_it_ends_after_max_time) {
  scenario::Scenario scenario = bed(scenario::AfterFailure::hold);
  scenario.deposition.max_time = 0.5;
  session::Session before = run_to_failure(bed(scenario::AfterFailure::hold));
  session::Session session(scenario, before.checkpoint(0.0));
  const double failed_at = session.world().time;
  const double tilt = session.world().tilt;
  test::run_session(session);
  EXPECT_EQ(session.world().tilt, tilt);
  EXPECT_NEAR(session.world().time - failed_at, 0.5, 1.5e-3);
  EXPECT_FALSE(session.angle_at_rest());
}

TEST(Avalanche, relaxes_its_surface_between_walls) {
  session::Session session = run_to_failure(bed(scenario::AfterFailure::hold, scenario::BedBoundary::walls));
  ASSERT_EQ(session.phase(), session::Phase::flow);
  const double tilt = session.world().tilt;
  test::run_session(session);
  EXPECT_EQ(session.world().tilt, tilt);
  ASSERT_TRUE(session.angle_at_rest());
  const double inclination = stress::surface_inclination(session.world().grains, session.world().boundary);
  EXPECT_GT(inclination, 0.0) << "the deposit is higher there";
  EXPECT_EQ(*session.angle_at_rest(), tilt - inclination);
}

TEST(Avalanche, records_frames_and_rows_until_it_has_stopped) {
  session::Session session = run_to_failure(bed(scenario::AfterFailure::lower));
  session.clear_segment();
  const double highest = session.world().tilt;
  const std::int64_t failed_at = session.world().step;
  test::run_session(session);
  const auto steps = session.world().step - failed_at;
  const io::Segment& segment = session.segment();
  EXPECT_EQ(segment.steps.size(), static_cast<std::size_t>(steps));
  EXPECT_NEAR(static_cast<double>(segment.observables.size()), static_cast<double>(steps) / 10.0, 2.0);
  EXPECT_NEAR(static_cast<double>(segment.frames.size()), static_cast<double>(steps) / 50.0, 2.0);
  for (const StepRow& row : segment.steps) EXPECT_EQ(at(row, StepField::phase), 3.0);
  for (const Frame& frame : segment.frames) EXPECT_LT(frame.tilt, highest);
  EXPECT_EQ(segment.frames.back().step, session.world().step);
  EXPECT_EQ(at(segment.observables.back(), Observable::step), static_cast<double>(session.world().step));
}

TEST(Avalanche, is_resumed_to_the_same_bits) {
  const scenario::Scenario scenario = bed(scenario::AfterFailure::lower);
  session::Session whole = run_to_failure(scenario);
  std::optional<session::Session> parts;
  parts.emplace(scenario, whole.checkpoint(0.0));
  for (int k = 1; whole.phase() != session::Phase::done; ++k) {
    whole.advance();
    parts->advance();
    if (k % 17 == 0) {
      const io::Checkpoint checkpoint = parts->checkpoint(0.0);
      parts.emplace(scenario, checkpoint);
    }
  }
  EXPECT_EQ(parts->phase(), session::Phase::done);
  EXPECT_EQ(state_hash(parts->world()), state_hash(whole.world()));
  EXPECT_EQ(parts->angle_at_rest(), whole.angle_at_rest());
  EXPECT_EQ(parts->schedule().record.unconverged_flow, whole.schedule().record.unconverged_flow);
  // Also for the end.
  const session::Session again(scenario, whole.checkpoint(0.0));
  EXPECT_EQ(again.angle_at_rest(), whole.angle_at_rest());
}

}  // namespace
}  // namespace talus
