/// Deposition of grains: poured beds that are stepped, interrupted and resumed.

#include "session/deposition.h"

#include <gtest/gtest.h>

#include "support/exit_code.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"

namespace talus::session {
namespace {

/// Returns a scenario with 30 grains that arrive within 0.19 s, tilted to 0.05 deg.
scenario::Scenario poured_bed(scenario::BedBoundary boundary = scenario::BedBoundary::periodic) {
  scenario::Scenario scenario = test::small_tilted_bed(0.5);
  scenario.bed.boundary = boundary;
  scenario.deposition.method = scenario::DepositionMethod::pour;
  scenario.deposition.rate = 0.5;
  return scenario;
}

TEST(AdviceForRest, names_the_key_that_keeps_a_bed_from_rest) {
  const auto advice = [](auto change, double velocity) {
    scenario::Scenario scenario = poured_bed();
    change(scenario);
    return advice_for_rest(scenario, velocity);
  };
  EXPECT_EQ(
      advice([](scenario::Scenario& s) { s.contact.restitution = 1.0; }, 1.0),
      "with contact.restitution = 1, impacts dissipate no energy, so neither more time nor a lower tolerance "
      "helps: set it closer to 0");
  EXPECT_EQ(advice([](scenario::Scenario& s) { s.contact.restitution = 0.97; }, 1.0),
            "with contact.restitution = 0.97, impacts dissipate little energy: set it closer to 0, or allow "
            "more time (deposition.max_time)");
  for (const double e_t : {-1.0, 1.0})
    EXPECT_TRUE(
        advice([e_t](scenario::Scenario& s) { s.contact.tangential_restitution = e_t; }, 1.0)
            .starts_with("with contact.tangential_restitution = " + std::string(e_t < 0 ? "-1" : "1")));
  EXPECT_EQ(advice([](scenario::Scenario& s) { s.deposition.rest_velocity = 1e-9; }, 1e-4),
            "set deposition.rest_velocity higher: beds come to rest with the default of 0.005");
  EXPECT_TRUE(advice([](scenario::Scenario&) {}, 1e-4)
                  .starts_with("it has only just fallen below that, or the solver misses"));
  EXPECT_TRUE(
      advice([](scenario::Scenario&) {}, 1.0).starts_with("allow more time (deposition.max_time), or set"));
}

TEST(AdviceForRest, ends_the_message_about_a_bed_that_is_not_at_rest) {
  scenario::Scenario scenario = poured_bed();
  scenario.contact.restitution = 1.0;
  scenario.deposition.max_time = 0.05;
  EXPECT_TRUE(test::refuses([&] { test::tilting(scenario); }, ExitCode::bad_data,
                            {"g h; with contact.restitution = 1, impacts"}));
}

TEST(PouredRun, begins_with_its_first_grain_and_tilts_all_of_them) {
  for (const scenario::BedBoundary boundary :
       {scenario::BedBoundary::periodic, scenario::BedBoundary::walls}) {
    Session session(poured_bed(boundary));
    EXPECT_EQ(session.world().grains.free_count, 1);
    test::begin_tilt(session);
    EXPECT_EQ(session.world().grains.free_count, 30);
    ASSERT_EQ(session.segment().frames.size(), 1u);
    EXPECT_EQ(session.segment().frames[0].grain_count(), 40);
    EXPECT_GE(session.world().time, end_of_arrivals(session.scenario()));
  }
}

TEST(PouredRun, tilts_when_all_have_arrived_even_if_those_before_are_at_rest) {
  scenario::Scenario scenario = poured_bed();
  scenario.deposition.rate = 0.05;  // 64 steps between grains, and 50 count as rest
  const Session session = test::tilting(scenario);
  EXPECT_EQ(session.world().grains.free_count, 30);
}

TEST(PouredRun, holds_only_what_has_arrived_in_its_problem) {
  Session session(poured_bed());
  Index most = 0;
  for (int k = 0; k < 20; ++k) {
    session.advance();
    most = std::max(most, session.world().grains.free_count);
    EXPECT_EQ(session.world().grains.count(), session.world().grains.free_count + 10);
  }
  EXPECT_EQ(most, dynamics::arrived_by(session.world().time, pour_rule(session.scenario()), 30));
  EXPECT_LT(most, 10);
}

TEST(PouredRun, has_statics_of_all_its_grains_from_the_beginning) {
  Session session(poured_bed());
  const RunStatics before = run_statics(session.scenario(), session.world());
  test::begin_tilt(session);
  const RunStatics after = run_statics(session.scenario(), session.world());
  EXPECT_EQ(before.free_count, 30);
  EXPECT_EQ(before.radius, after.radius);
  EXPECT_EQ(before.mass, after.mass);
  const RunStatics three = arrived_statics(before, 13);
  EXPECT_EQ(three.free_count, 3);
  ASSERT_EQ(three.radius.size(), 13u);
  EXPECT_EQ(three.radius[2], before.radius[2]);
  EXPECT_EQ(three.radius[3], before.radius[30]) << "the floor's";
}

TEST(PouredRun, taken_up_after_any_step_ends_with_the_same_bits) {
  for (const scenario::BedBoundary boundary :
       {scenario::BedBoundary::periodic, scenario::BedBoundary::walls}) {
    const Session whole = test::finished(poured_bed(boundary));
    for (const int stopped_after : {1, 6, 7, 50, 180}) {
      Session first(poured_bed(boundary));
      for (int k = 0; k < stopped_after; ++k) first.advance();
      Session second(first.scenario(), first.checkpoint(0.0));
      test::run_session(second);
      EXPECT_EQ(state_hash(second.world()), state_hash(whole.world())) << stopped_after;
    }
  }
}

TEST(PouredRun, has_its_time_to_come_to_rest_after_the_last_arrival) {
  scenario::Scenario scenario = poured_bed();
  scenario.deposition.max_time = 0.02;  // the arrivals alone take ten times as long
  Session session(scenario);
  EXPECT_THROW(test::begin_tilt(session), Error);
  EXPECT_GE(session.world().time, end_of_arrivals(scenario) + 0.02);
  EXPECT_EQ(session.world().grains.free_count, 30);
}

TEST(PouredRun, of_a_smooth_floor_and_of_still_grains) {
  scenario::Scenario scenario = poured_bed(scenario::BedBoundary::walls);
  scenario.bed.floor = scenario::BedFloor::smooth;
  scenario.deposition.arrival_speed = 0.0;
  const Session session = test::tilting(scenario);
  EXPECT_EQ(session.world().grains.count(), 30);
}

TEST(Deposition, has_the_friction_of_the_run_unless_it_has_its_own) {
  scenario::Scenario scenario = poured_bed();
  scenario.contact.friction = 0.3;
  scenario.contact.wall_friction = 0.2;
  EXPECT_EQ(Session(scenario).law().friction, 0.3);
  EXPECT_EQ(Session(scenario).law().wall_friction, 0.2);
  scenario.deposition.friction = 0.4;
  scenario.deposition.wall_friction = 0.1;
  Session session(scenario);
  EXPECT_EQ(session.law().friction, 0.4);
  EXPECT_EQ(session.law().wall_friction, 0.1);
  test::begin_tilt(session);
  EXPECT_EQ(session.law().friction, 0.3);
  EXPECT_EQ(session.law().wall_friction, 0.2);
}

}  // namespace
}  // namespace talus::session
