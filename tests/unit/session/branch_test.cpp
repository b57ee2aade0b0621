/// Runs that begin with a frame of another run, and grains that are dragged.

#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "core/trigonometry.h"
#include "problems/step_problem.h"
#include "scenario/tilt_program.h"
#include "session/command.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "session/run_check.h"
#include "support/exit_code.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

io::BranchOrigin origin_at(const io::RunFile& run, const std::string& path, std::size_t k) {
  return {path, static_cast<std::int64_t>(k), hash_text(state_hash(run.checkpoint().world)),
          checkpoint_at_frame(run, k)};
}

Session begun(const io::BranchOrigin& branch) {
  Session session(test::small_tilted_bed(3.0), branch.start);
  session.record_start();
  return session;
}

/// Records a branch of a run at frame k to its end.
io::RunFile recorded_branch(const io::RunFile& run, const std::string& path, std::size_t k) {
  const io::BranchOrigin origin = origin_at(run, "run.h5", k);
  return test::recorded_branch(runs::stored_scenario(run.header(), "run.h5"), origin, path);
}

void expect_whole(const io::RunFile& run) {
  const RunCheck check = check_run(run, {});
  EXPECT_TRUE(check.faults.empty()) << check.faults.front();
}

std::vector<Command> some_commands(std::int64_t step) {
  return {{step, CommandKind::push, 3, 0.2, 0.1},       {step + 2, CommandKind::drag, 7, 0.05, 0.06},
          {step + 5, CommandKind::drag, 7, 0.06, 0.06}, {step + 9, CommandKind::release},
          {step + 10, CommandKind::friction, -1, 0.3},  {step + 11, CommandKind::tilt_rate, -1, 10.0}};
}

using Branch = test::FolderTest;

TEST_F(Branch, is_replayed_from_its_own_file_with_any_number_of_threads) {
  const std::string parent = folder.path("run.h5"), path = folder.path("branch.h5");
  const io::RunFile run = test::recorded(test::small_tilted_bed(3.0), parent);
  const io::BranchOrigin origin = origin_at(run, parent, 2);
  Session session = begun(origin);
  const std::vector<Command> commands = some_commands(origin.start.world.step);
  const io::RunFile branch = test::recorded(session, path, commands, {"", "", "", 1, origin});
  ASSERT_TRUE(branch.header().branch);
  EXPECT_EQ(branch.header().branch->run, parent);
  EXPECT_EQ(branch.header().branch->frame, 2);
  EXPECT_EQ(branch.header().branch->run_hash, origin.run_hash);
  EXPECT_EQ(state_hash(branch.header().branch->start.world), state_hash(origin.start.world));
  EXPECT_EQ(branch.commands().size(), 6u);
  for (const int threads : {1, 3}) {
    Session again = session_at_start(branch.header(), path);
    again.use_threads(threads);
    replay(again, nullptr, branch.commands(), branch.checkpoint().world.step, {});
    EXPECT_EQ(state_hash(again.world()), state_hash(branch.checkpoint().world)) << threads;
    EXPECT_EQ(test::stored_values(again), test::stored_values(session));
  }
  expect_whole(branch);
}

TEST_F(Branch, begins_with_the_frame_and_goes_on_as_the_run_did) {
  const std::string parent = folder.path("run.h5");
  const io::RunFile run = test::recorded(test::small_tilted_bed(3.0), parent);
  Session session = begun(origin_at(run, parent, 2));
  const Frame first = session.segment().frames.front(), left = run.frame(2);
  EXPECT_EQ(first.step, left.step);
  EXPECT_EQ(first.tilt, left.tilt);
  EXPECT_EQ(first.contacts.fn, left.contacts.fn);
  for (std::size_t i = 0; i < first.x.size(); ++i) EXPECT_NEAR(first.x[i], left.x[i], 1e-8) << i;
  test::run_session(session);
  EXPECT_EQ(session.world().step, run.checkpoint().world.step) << "the steps of the tilt continue to count";
  EXPECT_EQ(session.world().tilt, run.checkpoint().world.tilt);
  const World& end = run.checkpoint().world;
  for (Index i = 0; i < end.grains.free_count; ++i)
    EXPECT_NEAR(session.world().grains.y[i], end.grains.y[i], 1e-4) << "a hundredth of D";
  const ObservableRow& row = session.segment().observables.back();
  EXPECT_NEAR(at(row, Observable::volume_strain), at(run.all_observables().back(), Observable::volume_strain),
              1e-3)
      << "strains refer to the same reference as in the parent run";
}

/// The schedule at each frame is that of a session at this point.
TEST_F(Branch, knows_how_the_run_stood_at_each_frame) {
  const std::int64_t step = test::tilting(test::small_tilted_bed(3.0)).world().step;
  const std::vector<Command> commands = {{step + 5, CommandKind::friction, -1, 0.4},
                                         {step + 12, CommandKind::tilt_rate, -1, 25.0},
                                         {step + 30, CommandKind::drag, 5, 0.04, 0.05},
                                         {step + 60, CommandKind::tilt_rate, -1, 12.0},
                                         {step + 70, CommandKind::release}};
  const io::RunFile run = test::recorded(test::small_tilted_bed(3.0), folder.path("run.h5"), commands);
  Session again(test::small_tilted_bed(3.0));
  std::size_t compared = 0;
  auto next = commands.begin();
  for (std::size_t k = 0; k + 1 < run.all_frame_tilts().size(); ++k) {
    const std::int64_t at = run.frame(k).step;
    while (again.world().step < at) {
      for (; next != commands.end() && next->step == again.world().step; ++next) again.apply(*next);
      again.advance();
    }
    const Schedule expected = again.schedule();
    const Schedule found = stored_schedule(checkpoint_at_frame(run, k), false, "the frame");
    EXPECT_EQ(found.phase, expected.phase) << k;
    EXPECT_EQ(found.tilt_steps, expected.tilt_steps) << k;
    EXPECT_EQ(found.quiet_steps, expected.quiet_steps) << k;
    EXPECT_EQ(found.friction, expected.friction) << k;
    EXPECT_EQ(found.course.has_value(), expected.course.has_value()) << k;
    if (found.course && expected.course) {
      EXPECT_EQ(found.course->from, expected.course->from) << k;
      EXPECT_EQ(found.course->since, expected.course->since) << k;
    }
    EXPECT_EQ(found.drag.has_value(), expected.drag.has_value()) << k;
    EXPECT_EQ(found.baseline.volume, expected.baseline.volume) << k;
    EXPECT_EQ(found.last.residual, expected.last.residual) << k;
    EXPECT_EQ(found.last.converged, expected.last.converged) << k;
    EXPECT_EQ(found.last.largest_overlap.has_value(), k % 2 == 0) << "rows: every 0.2 deg, frames: every 0.5";
    if (found.last.largest_overlap) {
      EXPECT_EQ(found.last.largest_overlap, expected.last.largest_overlap) << k;
    }
    ++compared;
  }
  EXPECT_GE(compared, 4u);
}

TEST_F(Branch, of_a_branch_goes_on) {
  const std::string parent = folder.path("run.h5"), path = folder.path("branch.h5");
  const io::RunFile run = test::recorded(test::small_tilted_bed(3.0), parent);
  const io::BranchOrigin origin = origin_at(run, parent, 1);
  Session session = begun(origin);
  const std::vector<Command> commands = {{origin.start.world.step, CommandKind::friction, -1, 0.9}};
  const io::RunFile branch = test::recorded(session, path, commands, {"", "", "", 1, origin});
  const Schedule schedule = stored_schedule(checkpoint_at_frame(branch, 2), false, "the branch");
  EXPECT_EQ(schedule.friction, 0.9);
  EXPECT_EQ(schedule.tilt_steps,
            static_cast<std::int64_t>(std::lround(degrees(branch.frame(2).tilt) / 0.02)));
}

TEST_F(Branch, goes_on_with_the_programme_of_the_tilt) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.tilt.end_angle.reset();
  scenario.tilt.program = {"to 1", "hold 0.03", "to 0.5", "2 times"};
  const scenario::TiltProgram program(scenario);
  const io::RunFile run = test::recorded(scenario, folder.path("run.h5"));
  const std::int64_t first = run.frame(0).step;
  for (const std::size_t k : {std::size_t{0}, run.frame_count() / 2}) {
    SCOPED_TRACE(k);
    const io::RunFile branch = recorded_branch(run, folder.path("branch" + std::to_string(k) + ".h5"), k);
    expect_whole(branch);
    EXPECT_EQ(branch.checkpoint().world.step, run.checkpoint().world.step);
    EXPECT_EQ(find_value(branch.checkpoint().integers, io::last_tilt_step_name),
              find_value(run.checkpoint().integers, io::last_tilt_step_name));
    ASSERT_EQ(branch.all_frame_tilts().size(), run.all_frame_tilts().size() - k);
    for (std::size_t j = 0; j < branch.all_frame_tilts().size(); ++j) {
      EXPECT_EQ(branch.all_frame_tilts()[j], run.all_frame_tilts()[j + k]);
      EXPECT_EQ(problems::problem_after_frame(branch, j).scales.tilt,
                program.tilt(branch.frame(j).step - first + 1));
    }
  }
}

TEST_F(Branch, is_judged_by_the_friction_that_was_set_before_it_began) {
  const std::vector<Command> commands = {{0, CommandKind::friction, -1, 0.9}};
  const io::RunFile run = test::recorded(test::small_tilted_bed(3.0), folder.path("run.h5"), commands);
  const io::RunFile branch = recorded_branch(run, folder.path("branch.h5"), 2);
  EXPECT_TRUE(branch.commands().empty());
  expect_whole(branch);
  EXPECT_GT(check_run(branch, {}).largest_mobilisation * 0.9, test::small_bed().contact.friction)
      << "otherwise any friction would pass";
}

/// Also if the branch has no command.
TEST_F(Branch, of_a_branch_has_what_was_set_before_the_first) {
  const Session session = test::tilting(test::small_tilted_bed(3.0));
  const std::int64_t step = session.world().step;
  const Grains& grains = session.world().grains;
  const std::vector<Command> commands = {{step + 1, CommandKind::friction, -1, 0.9},
                                         {step + 2, CommandKind::tilt_rate, -1, 12.0},
                                         {step + 3, CommandKind::drag, 5, grains.x[5], grains.y[5]}};
  const io::RunFile run = test::recorded(test::small_tilted_bed(3.0), folder.path("run.h5"), commands);
  const io::RunFile branch = recorded_branch(run, folder.path("branch.h5"), 2);
  const Schedule first = stored_schedule(checkpoint_at_frame(run, 3), false, "the run"),
                 second = stored_schedule(checkpoint_at_frame(branch, 1), false, "the branch");
  ASSERT_EQ(branch.frame(1).step, run.frame(3).step);
  EXPECT_EQ(second.friction, std::optional(0.9));
  ASSERT_TRUE(second.course && first.course && second.drag);
  EXPECT_EQ(second.course->rate, radians(12.0));
  EXPECT_EQ(second.course->from, first.course->from);
  EXPECT_EQ(second.course->since, first.course->since);
  EXPECT_EQ(second.drag->grain, 5);
  EXPECT_EQ(second.drag->y, grains.y[5]);
  EXPECT_EQ(second.tilt_steps, first.tilt_steps);
  EXPECT_EQ(second.baseline.volume, first.baseline.volume);
}

TEST_F(Branch, goes_on_in_the_flow_after_failure) {
  scenario::Scenario scenario = test::small_tilted_bed(3.0);
  scenario.contact.friction = 0.02;
  scenario.tilt.end_angle.reset();
  scenario.tilt.after_failure = scenario::AfterFailure::lower;
  scenario.tilt.lowering_rate = 100.0;
  const io::RunFile run = test::recorded(scenario, folder.path("run.h5"));
  const std::size_t k = run.frame_count();
  ASSERT_LT(k + 1, run.all_frame_tilts().size()) << "a frame of the flow";
  for (std::size_t j = k; j + 1 < run.all_frame_tilts().size(); ++j) {
    const Schedule schedule = stored_schedule(checkpoint_at_frame(run, j), true, "the frame");
    EXPECT_EQ(schedule.phase, Phase::flow);
    EXPECT_TRUE(schedule.flow.failed)
        << "also where it was lowered below theta_c, at " << run.all_frame_tilts()[j];
  }
  const io::RunFile branch = recorded_branch(run, folder.path("branch.h5"), k);
  expect_whole(branch);
  EXPECT_EQ(find_value(branch.checkpoint().results, "theta_c"),
            find_value(run.checkpoint().results, "theta_c"));
  Session again = session_at_start(branch.header(), "branch.h5");
  replay(again, nullptr, {}, test::to_the_end, {});
  EXPECT_EQ(state_hash(again.world()), state_hash(branch.checkpoint().world));
}

/// The tilt is turned back while the flow that fails the slope has begun.
TEST_F(Branch, has_the_flow_in_progress_whatever_the_course_of_the_tilt) {
  scenario::Scenario scenario = test::small_tilted_bed(3.0);
  scenario.contact.friction = 0.02;
  scenario.tilt.end_angle.reset();
  scenario.output.frame_every = scenario.output.observable_every = 0.1;
  Session steep(scenario);
  while (steep.phase() != Phase::done && !(steep.schedule().flow.displacement > 0.005)) steep.advance();
  ASSERT_EQ(steep.phase(), Phase::tilt);
  const std::vector<Command> commands = {{steep.world().step, CommandKind::tilt_rate, -1, -5.0}};
  const io::RunFile run = test::recorded(scenario, folder.path("run.h5"), commands);
  ASSERT_TRUE(std::isfinite(find_value(run.checkpoint().results, "theta_c").value_or(not_known)));
  Session session(scenario);
  int flowing = 0;
  for (std::size_t k = 0; k + 1 < run.frame_count(); ++k) {
    while (session.world().step < run.frame(k).step) {
      if (session.world().step == commands[0].step) session.apply(commands[0]);
      session.advance();
    }
    const dynamics::SurfaceFlow found = stored_schedule(checkpoint_at_frame(run, k), false, "the frame").flow;
    const dynamics::SurfaceFlow expected = session.schedule().flow;
    if (expected.onset_tilt != *session::angle_of_repose(stored_schedule(run.checkpoint(), false, "the run")))
      continue;  // a burst that stops
    ++flowing;
    EXPECT_TRUE(found.flowing);
    EXPECT_EQ(found.onset_tilt, expected.onset_tilt);
    EXPECT_NEAR(found.displacement, expected.displacement, 1e-12);
  }
  EXPECT_GT(flowing, 3);
}

constexpr double diameter = 0.01, step_length = 1e-3;

World one_grain() {
  World world;
  world.boundary.periodic = true;
  world.boundary.length = 20 * diameter;
  add_disk(world.grains, {diameter, 5 * diameter}, 0.5 * diameter, 2500.0, false);
  return world;
}

/// A free grain reaches the balance of gravity and spring, a tenth of D below, without overshoot.
TEST(Drag, brings_a_grain_to_where_it_is_held) {
  World world = one_grain();
  const Drag drag{0, 19 * diameter, 8 * diameter};  // two D to the left, across the edge
  double lowest = world.grains.x[0], highest = world.grains.y[0];
  for (int k = 0; k < 400; ++k) {
    pull(drag, diameter, step_length, world);
    world.grains.vy[0] -= world.gravity * step_length;
    world.grains.x[0] += step_length * world.grains.vx[0];
    world.grains.y[0] += step_length * world.grains.vy[0];
    lowest = std::min(lowest, world.grains.x[0]);
    highest = std::max(highest, world.grains.y[0]);
  }
  EXPECT_NEAR(world.grains.x[0], -diameter, 1e-6);
  EXPECT_NEAR(world.grains.y[0], 7.9 * diameter, 1e-6);
  EXPECT_GT(lowest, -1.01 * diameter) << "critically damped";
  EXPECT_LT(highest, 7.93 * diameter);
}

TEST(Drag, pulls_with_ten_weights_for_each_diameter) {
  const World world = one_grain();
  const Vec2 pulled = drag_acceleration({0, 3 * diameter, 5 * diameter}, diameter, step_length, world);
  EXPECT_NEAR(pulled.x, 2 * 10 * world.gravity, 1e-9);
  EXPECT_EQ(pulled.y, 0.0);
}

TEST(Drag, stays_stable_in_long_steps) {
  World world = one_grain();
  const double h = 0.1;
  for (int k = 0; k < 200; ++k) {
    pull({0, 3 * diameter, 8 * diameter}, diameter, h, world);
    world.grains.x[0] += h * world.grains.vx[0];
    world.grains.y[0] += h * world.grains.vy[0];
  }
  EXPECT_NEAR(world.grains.x[0], 3 * diameter, 1e-6);
}

TEST(Drag, goes_on_until_it_is_ended_also_in_a_session_that_is_resumed) {
  Session session(test::small_bed());
  for (int k = 0; k < 5; ++k) session.advance();
  const Grains& grains = session.world().grains;
  session.apply({0, CommandKind::drag, 4, grains.x[4], grains.y[4] + 5 * diameter});
  session.advance();
  Session resumed(test::small_bed(), session.checkpoint(0.0));
  for (int k = 0; k < 30; ++k) {
    session.advance();
    resumed.advance();
  }
  EXPECT_EQ(state_hash(resumed.world()), state_hash(session.world()));
  session.apply({0, CommandKind::release});
  EXPECT_FALSE(session.schedule().drag);
  session.advance();
  resumed.advance();
  EXPECT_NE(state_hash(resumed.world()), state_hash(session.world()));
}

TEST(Drag, refuses_what_cannot_be_done) {
  Session session(test::small_bed());
  const auto refused = [&](const Command& command) {
    return test::exit_code_of([&] { session.apply(command); }) == ExitCode::usage;
  };
  EXPECT_TRUE(refused({0, CommandKind::release}));
  EXPECT_TRUE(refused({0, CommandKind::drag, -1, 0.0, 0.0}));
  EXPECT_TRUE(refused({0, CommandKind::drag, 1000, 0.0, 0.0}));
  EXPECT_TRUE(refused({0, CommandKind::drag, 0, std::nan(""), 0.0}));
  EXPECT_TRUE(refused({0, CommandKind::drag, 0, 0.05, 51 * diameter + session.world().grains.y[0]}));
  EXPECT_TRUE(session.segment().commands.empty());
  EXPECT_FALSE(session.schedule().drag);
}

TEST(Drag, is_told_once_however_often_it_was_moved) {
  const std::vector<Command> commands = some_commands(10);
  const std::vector<Command> given = given_commands(commands);
  ASSERT_EQ(given.size(), 4u);
  EXPECT_EQ(command_text(given[1]), "drag grain 7 to (0.05, 0.06) m");
}

}  // namespace
}  // namespace talus::session
