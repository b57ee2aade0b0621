/// Effects of commands on hand-made worlds and on a session, and rejected commands.

#include "session/command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/trigonometry.h"
#include "support/exit_code.h"
#include "support/recorded_run.h"
#include "support/scenes.h"
#include "support/small_bed.h"

namespace talus::session {
namespace {

constexpr double diameter = 0.01;
using Ids = std::vector<Index>;

/// Returns two layers of ten touching disks: ids 0 ... 9 at the floor, 10 ... 19 on top of them, with
/// contacts along each column.
World layers(bool periodic) {
  World world;
  world.boundary.periodic = periodic;
  world.boundary.length = 10 * diameter;
  for (int layer = 0; layer < 2; ++layer)
    for (int k = 0; k < 10; ++k)
      add_disk(world.grains, {(k + 0.5) * diameter, (layer + 0.5) * diameter}, 0.5 * diameter, 2500.0, false);
  Contacts& contacts = world.contacts;
  contacts.resize(10);
  for (Index k = 0; k < 10; ++k) {
    contacts.a[k] = k;
    contacts.b[k] = k + 10;
    contacts.fn[k] = 1.0 + k;
  }
  return world;
}

TEST(Drop, finds_the_grains_that_nothing_covers) {
  World world = layers(true);
  EXPECT_EQ(surface_grains(world), (Ids{10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
  world.grains.x[19] = 0.5 * diameter;  // covers grain 10 and exposes grain 9
  world.grains.y[19] = 5.0 * diameter;
  EXPECT_EQ(surface_grains(world), (Ids{9, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
}

TEST(Drop, takes_the_farthest_around_a_periodic_bed) {
  World world = layers(true);
  drop_grains(world, 3, 2.5 * diameter, 4.0 * diameter);  // at grain 12; grain 17 is opposite
  for (const Index lifted : {16, 17, 18}) EXPECT_GE(world.grains.y[lifted], 6.5 * diameter) << lifted;
  for (Index i = 0; i < 16; ++i) EXPECT_LT(world.grains.y[i], 2.0 * diameter) << i;
}

TEST(Drop, takes_the_farthest_between_walls) {
  World world = layers(false);
  drop_grains(world, 2, 2.5 * diameter, 4.0 * diameter);
  for (const Index lifted : {18, 19}) EXPECT_GE(world.grains.y[lifted], 6.5 * diameter) << lifted;
}

TEST(Drop, leaves_grains_at_rest_above_the_surface_that_touch_nothing) {
  for (const bool periodic : {true, false})
    for (const double x : {0.0, 0.3, 4.2, 9.9}) {
      World world = layers(periodic);
      Grains& grains = world.grains;
      for (Index i = 0; i < grains.count(); ++i) {
        grains.radius[i] *= 1.0 - 0.02 * (i % 7);
        grains.vx[i] = grains.vy[i] = grains.omega[i] = 1.0;
      }
      drop_grains(world, 7, x * diameter, 0.0);
      EXPECT_GT(test::smallest_gap(world), -1e-12) << x;
      int lifted = 0;
      for (Index i = 0; i < grains.count(); ++i) {
        if (grains.vx[i] != 0.0) continue;
        ++lifted;
        EXPECT_EQ(grains.vy[i], 0.0);
        EXPECT_EQ(grains.omega[i], 0.0);
        EXPECT_GE(grains.x[i], periodic ? 0.0 : grains.radius[i]);
        EXPECT_LE(grains.x[i], world.boundary.length - (periodic ? 1e-12 : grains.radius[i]));
      }
      EXPECT_EQ(lifted, 7);
    }
}

TEST(Drop, falls_from_the_height_asked_for) {
  World world = layers(true);
  drop_grains(world, 1, 2.5 * diameter, 4.0 * diameter);
  EXPECT_NEAR(world.grains.x[17], 2.5 * diameter, 1e-15);
  EXPECT_NEAR(world.grains.y[17] - 0.5 * diameter, 6.0 * diameter, 0.011 * diameter) << "2 D of bed, and 4 D";
}

/// Unwrapped, a grain moves the shorter way: less than half the bed.
TEST(Drop, counts_the_turns_of_a_periodic_bed) {
  for (const double x : {-1.0, 0.0, 0.2, 2.5, 9.8, 23.0}) {
    World world = layers(true);
    std::ranges::fill(world.grains.image, 3);
    const Grains before = world.grains;
    drop_grains(world, 6, x * diameter, diameter);
    const Grains& grains = world.grains;
    for (Index i = 0; i < grains.count(); ++i) {
      EXPECT_GE(grains.x[i], 0.0);
      EXPECT_LT(grains.x[i], world.boundary.length);
      const double way = grains.x[i] - before.x[i] + (grains.image[i] - 3) * world.boundary.length;
      EXPECT_LE(std::fabs(way), 0.5 * world.boundary.length + 1e-12) << x << " grain " << i;
    }
  }
}

TEST(Drop, forgets_the_contacts_of_what_was_lifted) {
  World world = layers(true);
  drop_grains(world, 3, 2.5 * diameter, diameter);
  EXPECT_EQ(world.contacts.a, (Ids{0, 1, 2, 3, 4, 5, 9}));
  EXPECT_EQ(world.contacts.fn, (std::vector{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 10.0}));
}

TEST(Drop, of_more_grains_than_the_surface_has_is_refused) {
  World world = layers(true);
  const std::uint64_t before = state_hash(world);
  EXPECT_THROW(drop_grains(world, 11, 0.0, 0.0), Error);
  EXPECT_EQ(state_hash(world), before);
}

scenario::Scenario small_bed() {
  scenario::Scenario scenario = test::small_bed();
  scenario.tilt.end_angle = 30.0;
  return scenario;
}

TEST(Command, that_cannot_be_done_is_refused_and_leaves_no_trace) {
  const double nan = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  const double limit = 100.0 * std::sqrt(9.81 * diameter);
  for (const scenario::BedBoundary boundary :
       {scenario::BedBoundary::periodic, scenario::BedBoundary::walls}) {
    scenario::Scenario scenario = small_bed();
    scenario.bed.boundary = boundary;
    Session session(scenario);
    const std::uint64_t before = state_hash(session.world());
    std::vector<Command> refused = {
        {0, CommandKind::push, -1, 0.1, 0.0},
        {0, CommandKind::push, 30, 0.1, 0.0},  // 30 free grains, so this is a floor grain
        {0, CommandKind::push, 3, nan, 0.0},
        {0, CommandKind::push, 3, 0.0, infinite},
        {0, CommandKind::push, 3, limit, 0.0},
        {0, CommandKind::push, 3, 0.8 * limit, -0.8 * limit},
        {0, CommandKind::drop, 0, 0.05, 0.0},
        {0, CommandKind::drop, 1001, 0.05, 0.0},
        {0, CommandKind::drop, 3, nan, 0.0},
        {0, CommandKind::drop, 3, 0.05, -0.001},
        {0, CommandKind::drop, 3, 0.05, 1.001},
        {0, CommandKind::drop, 29, 0.05, 0.1},
        {0, CommandKind::friction, -1, -0.1, 0.0},
        {0, CommandKind::friction, -1, 10.1, 0.0},
        {0, CommandKind::friction, -1, nan, 0.0},
        {0, CommandKind::tilt_rate, -1, -100.1, 0.0},
        {0, CommandKind::tilt_rate, -1, nan, 0.0},
        {0, CommandKind::tilt_rate, -1, 101.0, 0.0},
        {0, CommandKind::tilt_rate, -1, infinite, 0.0}};
    if (boundary == scenario::BedBoundary::walls) refused.push_back({0, CommandKind::drop, 3, 0.101, 0.0});
    for (const Command& command : refused)
      EXPECT_EQ(test::exit_code_of([&] { session.apply(command); }), ExitCode::usage)
          << command_text(command);
    EXPECT_EQ(state_hash(session.world()), before);
    EXPECT_TRUE(session.segment().commands.empty());
    EXPECT_EQ(session.law().friction, 0.5);
    EXPECT_EQ(session.tilt_rate(), radians(1.0));
  }
}

TEST(Command, after_the_end_is_refused) {
  scenario::Scenario scenario = small_bed();
  scenario.tilt.end_angle = 0.001;
  Session session = test::tilting(scenario);
  session.advance();
  ASSERT_EQ(session.phase(), Phase::done);
  EXPECT_EQ(test::exit_code_of([&] { session.apply({0, CommandKind::push, 3, 0.1, 0.0}); }), ExitCode::usage);
}

TEST(Command, is_recorded_with_its_step) {
  Session session(small_bed());
  for (int k = 0; k < 5; ++k) session.advance();
  session.apply({-7, CommandKind::push, 3, 0.1, -0.2});
  session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  EXPECT_EQ(session.segment().commands, (std::vector<Command>{{5, CommandKind::push, 3, 0.1, -0.2},
                                                              {5, CommandKind::friction, -1, 0.3, 0.0}}));
}

TEST(Push, adds_to_the_velocity) {
  Session session(small_bed());
  session.advance();
  const Grains before = session.world().grains;
  session.apply({0, CommandKind::push, 3, 0.125, -0.25});
  EXPECT_EQ(session.world().grains.vx[3], before.vx[3] + 0.125);
  EXPECT_EQ(session.world().grains.vy[3], before.vy[3] - 0.25);
  EXPECT_EQ(session.world().grains.vx[2], before.vx[2]);
}

/// A column on a plane that suddenly has no friction slides at g sin(theta).
TEST(Friction, holds_from_the_next_step_on) {
  scenario::Scenario scenario = small_bed();
  scenario.bed.floor = scenario::BedFloor::smooth;
  scenario.tilt.rate = 20.0;
  scenario.tilt.step = 0.02;
  Session session = test::tilting(scenario);
  while (session.world().tilt < radians(3.0)) session.advance();
  const auto momentum = [&session] {
    double sum = 0.0, mass = 0.0;
    const Grains& grains = session.world().grains;
    for (Index i = 0; i < grains.free_count; ++i) {
      sum += grains.mass[i] * grains.vx[i];
      mass += grains.mass[i];
    }
    return sum / mass;
  };
  session.apply({0, CommandKind::friction, -1, 0.0, 0.0});
  EXPECT_EQ(session.law().friction, 0.0);
  EXPECT_EQ(session.law().wall_friction, 0.5);
  const double before = momentum();
  session.advance();
  const World& world = session.world();
  EXPECT_NEAR(momentum() - before, 1e-3 * world.gravity * sine(world.tilt), 1e-9);
}

TEST(Friction, holds_in_the_deposition_and_after_it) {
  scenario::Scenario scenario = small_bed();
  scenario.deposition.friction = 0.1;
  scenario.deposition.wall_friction = 0.2;
  Session session(scenario);
  EXPECT_EQ(session.law().friction, 0.1);
  session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
  EXPECT_EQ(session.law().friction, 0.3);
  EXPECT_EQ(session.law().wall_friction, 0.2);
  while (session.phase() == Phase::deposition) session.advance();
  EXPECT_EQ(session.law().friction, 0.3);
  EXPECT_EQ(session.law().wall_friction, 0.5);
}

// The state kept after an error must be the one that a resumed run and a replay reach.
TEST(FailedStep, leaves_the_session_as_it_was) {
  Session session = test::tilting(small_bed());
  for (int k = 0; k < 10; ++k) session.advance();
  const Grains& grains = session.world().grains;
  session.apply({0, CommandKind::drag, 3, grains.x[3] + 0.01, grains.y[3] + 0.05});
  session.advance();
  io::Checkpoint checkpoint = session.checkpoint(0.0);
  checkpoint.world.gravity = std::numeric_limits<double>::infinity();
  Session broken(small_bed(), checkpoint);
  const std::uint64_t state = state_hash(broken.world());
  const std::int64_t tilt_steps = broken.schedule().tilt_steps;
  EXPECT_THROW(broken.advance(), Error);
  EXPECT_EQ(state_hash(broken.world()), state);
  EXPECT_EQ(broken.schedule().tilt_steps, tilt_steps);
}

TEST(TiltRate, is_that_of_the_next_steps_whose_length_stays) {
  Session session = test::tilting(small_bed());
  for (int k = 0; k < 10; ++k) session.advance();
  const double time = session.world().time;
  session.apply({0, CommandKind::tilt_rate, -1, 3.0, 0.0});
  for (int k = 0; k < 10; ++k) session.advance();
  EXPECT_NEAR(degrees(session.world().tilt), 0.010 + 0.030, 1e-12);
  session.apply({0, CommandKind::tilt_rate, -1, 0.0, 0.0});
  for (int k = 0; k < 10; ++k) session.advance();
  EXPECT_NEAR(degrees(session.world().tilt), 0.040, 1e-12) << "held";
  session.apply({0, CommandKind::tilt_rate, -1, 1.0, 0.0});
  session.advance();
  EXPECT_NEAR(degrees(session.world().tilt), 0.041, 1e-12);
  EXPECT_NEAR(session.world().time - time, 0.021, 1e-12);
}

TEST(TiltRate, below_0_leads_down_through_0_by_the_same_law) {
  Session session = test::tilting(small_bed());
  for (int k = 0; k < 10; ++k) session.advance();
  session.apply({0, CommandKind::tilt_rate, -1, -3.0, 0.0});
  EXPECT_NEAR(degrees(session.tilt_rate()), -3.0, 1e-12);
  for (int k = 1; k <= 10; ++k) {
    session.advance();
    EXPECT_NEAR(degrees(session.world().tilt), 0.010 - 0.003 * k, 1e-12);
  }
  session.apply({0, CommandKind::tilt_rate, -1, -0.0, 0.0});
  EXPECT_FALSE(std::signbit(session.tilt_rate()));
  EXPECT_EQ(command_text({0, CommandKind::tilt_rate, -1, -3.0, 0.0}), "tilt rate -3 deg/s");
}

TEST(TiltRate, below_0_ends_at_the_same_angle_on_the_other_side) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  Session session = test::tilting(scenario);
  for (int k = 0; k < 50; ++k) session.advance();
  session.apply({0, CommandKind::tilt_rate, -1, -20.0, 0.0});
  for (int k = 0; k < 149; ++k) session.advance();
  EXPECT_EQ(session.phase(), Phase::tilt) << "at -1.98 deg";
  session.advance();
  EXPECT_EQ(session.phase(), Phase::done);
  EXPECT_NEAR(degrees(session.world().tilt), -2.0, 1e-9);
}

/// A slope with little friction fails on the side to which it is tilted; the flow lowers it from there.
TEST(TiltRate, below_0_fails_the_slope_on_the_other_side) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.contact.friction = 0.05;
  scenario.tilt.end_angle.reset();
  scenario.tilt.after_failure = scenario::AfterFailure::lower;
  scenario.tilt.lowering_rate = 50.0;
  Session session = test::tilting(scenario);
  session.apply({0, CommandKind::tilt_rate, -1, -50.0, 0.0});
  while (session.phase() == Phase::tilt) session.advance();
  ASSERT_EQ(session.phase(), Phase::flow);
  const double failed_at = session.world().tilt;
  ASSERT_TRUE(session.angle_of_repose().has_value());
  EXPECT_LT(failed_at, -*session.angle_of_repose()) << "theta_c is where the flow began";
  EXPECT_GT(*session.angle_of_repose(), 0.0);
  session.advance();
  EXPECT_NEAR(session.world().tilt, failed_at + radians(50.0 * scenario::time_step(scenario)), 1e-12);
}

TEST(TiltRate, of_a_deposition_is_that_with_which_the_tilt_begins) {
  Session session(small_bed());
  session.apply({0, CommandKind::tilt_rate, -1, 5.0, 0.0});
  while (session.phase() == Phase::deposition) session.advance();
  EXPECT_EQ(session.world().tilt, 0.0);
  session.advance();
  EXPECT_NEAR(degrees(session.world().tilt), 0.005, 1e-12);
}

/// Rows are 20 steps apart; commands lie between them, and some of them set the rate.
TEST(TiltBefore, is_that_of_the_bed_when_the_command_was_given_to_the_last_digit) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.output.observable_every = 0.4;
  Session session(scenario);
  std::vector<double> tilts, times;
  const auto give = [&](const Command& command) {
    tilts.push_back(session.phase() == Phase::deposition ? std::nan("") : session.world().tilt);
    times.push_back(session.world().time);
    session.apply(command);
  };
  const auto advance = [&](int steps) {
    for (int k = 0; k < steps; ++k) session.advance();
  };
  const Command push{0, CommandKind::push, 3, 0.01, 0.0};
  const auto rate = [](double value) { return Command{0, CommandKind::tilt_rate, -1, value, 0.0}; };
  session.advance();
  give(push);
  while (session.phase() == Phase::deposition) session.advance();
  give(push);
  for (const int steps : {7, 1, 13, 20}) {
    advance(steps);
    give(push);
  }
  for (const double next : {3.0, 0.0, 40.0, 11.0}) {
    advance(4);
    give(rate(next));
    give(push);
    advance(3);
    give(push);
  }
  advance(3);
  give(push);
  const std::vector<Command>& commands = session.segment().commands;
  const World& world = session.world();
  const std::vector<ObservableRow> rows =
      rows_up_to(session.segment().observables, world.step, world.time, world.tilt);
  ASSERT_GT(rows.size(), 3u);
  EXPECT_GT(degrees(tilts.back()), 1.0);
  EXPECT_TRUE(std::isnan(tilt_before(commands[0], commands, rows)));
  EXPECT_TRUE(std::isnan(time_before(commands[0], rows)));
  for (std::size_t k = 1; k < commands.size(); ++k) {
    EXPECT_NEAR(degrees(tilt_before(commands[k], commands, rows)), degrees(tilts[k]), 1e-12) << k;
    EXPECT_NEAR(time_before(commands[k], rows), times[k], 1e-12) << k;
  }
}

}  // namespace
}  // namespace talus::session
