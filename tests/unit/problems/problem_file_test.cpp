/// Problem of a step, written to a file and read back.

#include "problems/problem_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/errors.h"
#include "problems/fclib_file.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "solver/local_law.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace talus::problems {
namespace {

const char* const tiny_bed =
    "seed = 5\n[bed]\nlength = 10\ndepth = 2\n[tilt]\nend_angle = 0.02\nstep = 0.01\n[output]\nframe_every = "
    "0.01\n";

/// Writes a run of the bed, complete or only up to its last commit.
std::string tiny_run(const test::TemporaryFolder& folder) {
  const scenario::Scenario scenario = scenario::parse_scenario(tiny_bed, "tiny.toml");
  session::Session session(scenario);
  io::RunHeader header;
  header.statics = session::run_statics(scenario, session.world());
  header.scenario_given = tiny_bed;
  header.scenario_resolved = scenario::resolved_toml(scenario);
  header.seed = scenario.seed;
  io::RunStore store = io::RunStore::create(folder.path("run.h5"), header, false);
  EXPECT_EQ(session::run_to_end(session, store, {}), session::RunEnd::complete);
  return folder.path("run.h5");
}

/// Returns a falling bed, with contacts that open, stick and slide.
StepProblem falling_bed() {
  dynamics::StepSettings settings = test::bed_step(1e-8);
  settings.law.restitution = 0.5;
  const World world = test::fallen_bed(test::bed_plan(true, 24, 6, 1), settings, 100);
  const test::FrozenStep frozen = test::next_problem(world, settings);
  StepProblem step;
  step.problem = frozen.problem;
  step.guess = frozen.guess;
  solver::velocities_from_impulses(step.problem, step.guess);
  step.scales = {settings.h, world.gravity, 0.1, 0.01, test::weight(world)};
  return step;
}

void expect_same_bits(const std::vector<double>& one, const std::vector<double>& other) {
  ASSERT_EQ(one.size(), other.size());
  EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(double)), 0);
}

TEST(ProblemFile, a_step_is_read_back_bit_for_bit) {
  const test::TemporaryFolder folder;
  const StepProblem step = falling_bed();
  ASSERT_GT(step.problem.contact_count(), 10);
  write_problem(folder.path("p.h5"), step, "a falling bed");
  const StoredProblem stored = read_problem(folder.path("p.h5"));
  ASSERT_TRUE(stored.step.has_value());
  const solver::ContactProblem& problem = stored.step->problem;
  for (auto field : {&solver::ContactProblem::vx, &solver::ContactProblem::vy, &solver::ContactProblem::omega,
                     &solver::ContactProblem::inverse_mass, &solver::ContactProblem::inverse_inertia,
                     &solver::ContactProblem::lever, &solver::ContactProblem::nx, &solver::ContactProblem::ny,
                     &solver::ContactProblem::cn, &solver::ContactProblem::ct, &solver::ContactProblem::mu})
    expect_same_bits(problem.*field, step.problem.*field);
  EXPECT_EQ(problem.a, step.problem.a);
  EXPECT_EQ(problem.b, step.problem.b);
  for (auto field : {&solver::ContactSolution::pn, &solver::ContactSolution::pt, &solver::ContactSolution::vx,
                     &solver::ContactSolution::vy, &solver::ContactSolution::omega})
    expect_same_bits(stored.step->guess.*field, step.guess.*field);
  EXPECT_EQ(std::memcmp(&stored.step->scales, &step.scales, sizeof step.scales), 0);
}

TEST(ProblemFile, keeps_the_columns_of_a_large_bed) {
  const test::TemporaryFolder folder;
  StepProblem step = falling_bed();
  write_problem(folder.path("p.h5"), step, "of a small bed");
  EXPECT_TRUE(read_problem(folder.path("p.h5")).step->problem.column.empty());
  for (Index i = 0; i < step.problem.body_count(); ++i) step.problem.column.push_back(i / 3);
  step.problem.columns = step.problem.column.back() + 1;
  write_problem(folder.path("p.h5"), step, "");
  const solver::ContactProblem stored = read_problem(folder.path("p.h5")).step->problem;
  EXPECT_EQ(stored.column, step.problem.column);
  EXPECT_EQ(stored.columns, step.problem.columns);
}

TEST(ProblemFile, holds_the_local_form_of_the_step) {
  const test::TemporaryFolder folder;
  const StepProblem step = falling_bed();
  write_problem(folder.path("p.h5"), step, "a falling bed");
  const solver::LocalProblem found = read_problem(folder.path("p.h5")).local;
  const solver::LocalProblem expected = solver::local_problem(step.problem);
  EXPECT_EQ(found.row_begin, expected.row_begin);
  EXPECT_EQ(found.column, expected.column);
  EXPECT_EQ(found.diagonal, expected.diagonal);
  ASSERT_EQ(found.block.size(), expected.block.size());
  EXPECT_EQ(std::memcmp(found.block.data(), expected.block.data(),
                        found.block.size() * sizeof(solver::DelassusBlock)),
            0);
  EXPECT_EQ(std::memcmp(found.q.data(), expected.q.data(), found.q.size() * sizeof(solver::RelativeVelocity)),
            0);
}

TEST(ProblemFile, keeps_what_the_run_asks_of_the_step) {
  const test::TemporaryFolder folder;
  StepProblem step = falling_bed();
  write_problem(folder.path("p.h5"), step, "of an older Talus");
  EXPECT_FALSE(read_problem(folder.path("p.h5")).step->tolerance.has_value());
  step.tolerance = {0.25, 2.5e-5, 3e-7};
  write_problem(folder.path("p.h5"), step, "");
  const StoredProblem stored = read_problem(folder.path("p.h5"));
  ASSERT_TRUE(stored.step->tolerance.has_value());
  EXPECT_EQ(stored.step->tolerance->velocity, 0.25);
  EXPECT_EQ(stored.step->tolerance->asked, 2.5e-5);
  EXPECT_EQ(stored.step->tolerance->at_rest, 3e-7);
}

TEST(ProblemFile, a_negative_tolerance_is_refused) {
  const test::TemporaryFolder folder;
  StepProblem step = falling_bed();
  step.tolerance = {0.25, -2.5e-5, 3e-7};
  write_problem(folder.path("p.h5"), step, "");
  EXPECT_THROW(read_problem(folder.path("p.h5")), Error);
}

TEST(ProblemFile, bodies_that_solvers_cannot_take_are_refused) {
  const test::TemporaryFolder folder;
  StepProblem step = falling_bed();
  step.problem.inverse_mass[2] = -1.0;
  write_problem(folder.path("p.h5"), step, "");
  EXPECT_THROW(read_problem(folder.path("p.h5")), Error);
  step = falling_bed();
  std::swap(step.problem.a.front(), step.problem.a.back());
  write_problem(folder.path("p.h5"), step, "");
  EXPECT_THROW(read_problem(folder.path("p.h5")), Error);
  step = falling_bed();
  step.problem.b[0] = step.problem.a[0];
  write_problem(folder.path("p.h5"), step, "");
  EXPECT_THROW(read_problem(folder.path("p.h5")), Error);
}

// The last frame is the state of the checkpoint, so its problem is that of the next step.
TEST(StepProblem, of_the_last_frame_is_that_of_the_next_step) {
  const test::TemporaryFolder folder;
  const io::RunFile run = io::RunFile::open(tiny_run(folder));
  ASSERT_EQ(run.frame_count(), 3u);
  const StepProblem step = problem_after_frame(run, 2);
  EXPECT_NEAR(step.scales.tilt, 0.03 * 3.14159265358979 / 180.0, 1e-15);

  const scenario::Scenario scenario = scenario::parse_scenario(tiny_bed, "tiny.toml");
  World world = run.checkpoint().world;
  world.tilt = step.scales.tilt;
  dynamics::StepWorkspace workspace;
  dynamics::begin_step(world, session::step_settings(scenario), workspace);
  EXPECT_EQ(step.problem.a, workspace.problem.a);
  expect_same_bits(step.problem.vx, workspace.problem.vx);
  expect_same_bits(step.problem.cn, workspace.problem.cn);
  expect_same_bits(step.guess.pn, workspace.solution.pn);
}

// The tolerance of a step follows from the velocities before it, as in the run.
TEST(StepProblem, has_the_tolerance_that_the_run_asks) {
  const test::TemporaryFolder folder;
  const io::RunFile run = io::RunFile::open(tiny_run(folder));
  const scenario::Scenario scenario = scenario::parse_scenario(tiny_bed, "tiny.toml");
  for (const std::size_t k : {1u, 2u}) {
    const World world = session::world_at_frame(run, k);
    const StepProblem step = problem_after_frame(run, k);
    ASSERT_TRUE(step.tolerance.has_value());
    EXPECT_EQ(step.tolerance->velocity, rms_velocity(world.grains) / (world.gravity * step.scales.h));
    EXPECT_EQ(step.tolerance->asked, session::step_settings(scenario, world).solver.tolerance);
    EXPECT_EQ(step.tolerance->at_rest, scenario.solver.tolerance);
  }
}

// The run has taken the step after frame 1, so its forces are those of frame 2, up to the error of the
// solver.
TEST(StepProblem, of_a_frame_in_single_precision_is_nearly_solved_by_its_memory) {
  const test::TemporaryFolder folder;
  const io::RunFile run = io::RunFile::open(tiny_run(folder));
  const StepProblem step = problem_after_frame(run, 1);
  EXPECT_GT(step.problem.contact_count(), 20);
  EXPECT_LT(solver::natural_map_residual(step.problem, step.guess).eta, 1e-3) << "the bed is at rest";
  EXPECT_NEAR(carried_weight(step, step.guess), 1.0, 1e-3);
  double mass = 0.0;
  for (Index i = 0; i < run.header().statics.free_count; ++i) mass += run.header().statics.mass[i];
  EXPECT_NEAR(step.scales.weight, 9.81 * mass, 1e-12 * step.scales.weight);
}

TEST(StepProblem, weight_is_carried_by_what_does_not_move) {
  StepProblem step;
  step.scales = {1e-3, 10.0, 0.0, 0.01, 20.0};
  step.problem.vx = step.problem.vy = step.problem.omega = {0.0, 0.0, 0.0};
  step.problem.inverse_mass = {1.0, 1.0, 0.0};
  step.problem.a = {0, 0, 1};
  step.problem.b = {1, 2, 2};
  step.problem.nx = {0.0, 0.0, -0.6};
  step.problem.ny = {1.0, -1.0, -0.8};
  step.problem.mu = {0.5, 0.5, 0.5};
  solver::ContactSolution solution;
  solution.pn = {5.0, 8e-3, 10e-3};  // between the two grains, and thus not carried by the floor
  solution.pt = {0.0, 0.0, 1e-3};
  // The floor pushes grain 0 up with 8 N, and grain 1 with (10 (0.6, 0.8) - 1 (0.8, -0.6)) N, 8.6 N upwards.
  // The weight is 20 N.
  EXPECT_NEAR(carried_weight(step, solution), 16.6 / 20.0, 1e-14);
}

}  // namespace
}  // namespace talus::problems
