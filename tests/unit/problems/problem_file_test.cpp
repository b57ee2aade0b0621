/// Problem of a step, written to a file and read back. Problem files: reading returns what was written,
/// invalid parts are named, and the page documents the data sets.

#include "problems/problem_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <sstream>

#include "base/errors.h"
#include "problems/fclib_file.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "solver/local_problem.h"
#include "support/exit_code.h"
#include "support/places.h"
#include "support/recorded_run.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "unit/io/example_run.h"

namespace talus::problems {
namespace {

const char* const tiny_bed =
    "seed = 5\n[bed]\nlength = 10\ndepth = 2\n[tilt]\nend_angle = 0.02\nstep = 0.01\n[output]\nframe_every = "
    "0.01\n";

class StepOfRun : public test::FolderTest {
 protected:
  const io::RunFile run =
      test::recorded(scenario::parse_scenario(tiny_bed, "tiny.toml"), folder.path("run.h5"));
};

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

using ProblemFile = test::FolderTest;

TEST_F(ProblemFile, a_step_is_read_back_bit_for_bit) {
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

TEST_F(ProblemFile, keeps_the_columns_of_a_large_bed) {
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

TEST_F(ProblemFile, holds_the_local_form_of_the_step) {
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

TEST_F(ProblemFile, keeps_what_the_run_asks_of_the_step) {
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

TEST_F(ProblemFile, bodies_that_solvers_cannot_take_are_refused) {
  const auto is_refused = [&](const std::function<void(StepProblem&)>& change) {
    StepProblem step = falling_bed();
    change(step);
    write_problem(folder.path("p.h5"), step, "");
    return test::exit_code_of([&] { read_problem(folder.path("p.h5")); }) == ExitCode::bad_data;
  };
  EXPECT_TRUE(is_refused([](StepProblem& step) { step.problem.inverse_mass[2] = -1.0; }));
  EXPECT_TRUE(
      is_refused([](StepProblem& step) { std::swap(step.problem.a.front(), step.problem.a.back()); }));
  EXPECT_TRUE(is_refused([](StepProblem& step) { step.problem.b[0] = step.problem.a[0]; }));
  EXPECT_TRUE(is_refused([](StepProblem& step) { step.tolerance = {0.25, -2.5e-5, 3e-7}; }));
}

// The last frame is the state of the checkpoint, so its problem is that of the next step.
TEST_F(StepOfRun, of_the_last_frame_is_that_of_the_next_step) {
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
TEST_F(StepOfRun, has_the_tolerance_that_the_run_asks) {
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
TEST_F(StepOfRun, of_a_frame_in_single_precision_is_nearly_solved_by_its_memory) {
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

/// Returns two contacts, with W not symmetric, a guess, and without data sets specific to Talus.
FclibProblem example() {
  FclibProblem problem;
  problem.title = "two contacts";
  problem.row = {0, 0, 2, 3};
  problem.column = {0, 3, 2, 3};
  problem.value = {2.0, 6.0, 3.0, 9.0};
  problem.q = {-1.0, 0.5, -0.25, 0.0};
  problem.mu = {0.5, 0.3};
  problem.guess_r = {0.5, -0.125, 0.0625, 0.0};
  return problem;
}

FclibProblem with_bodies() {
  FclibProblem problem = example();
  for (const io::DataSetField& field : fclib_schema())
    if (field.path.starts_with("/talus/")) {
      const std::size_t size = field.shape == "B" ? 3 : field.shape == "C" ? 2 : 1;
      if (field.type == io::ElementType::int32)
        problem.integers[field.path].assign(size, field.path.ends_with("/b") ? 2 : 0);
      else
        problem.reals[field.path].assign(size, 0.1 + static_cast<double>(problem.reals.size()));
    }
  return problem;
}

const std::vector<double> guess_u = {0.0, 1.0, 2.0, 3.0};

/// Expects reading the problem to fail with bad_data and exactly this message after the name of the file.
void expect_refused(const FclibProblem& problem, const std::string& message) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("bad.h5");
  write_fclib(path, problem, guess_u);
  EXPECT_EQ(test::refusal_of([&] { read_fclib(path); }),
            (test::Refusal{ExitCode::bad_data, path + ": data set " + message}));
}

using FclibFile = test::FolderTest;

TEST_F(FclibFile, is_read_back_as_written) {
  const FclibProblem problem = with_bodies();
  write_fclib(folder.path("p.h5"), problem, guess_u);
  const FclibProblem read = read_fclib(folder.path("p.h5"));
  EXPECT_EQ(read.row, problem.row);
  EXPECT_EQ(read.column, problem.column);
  EXPECT_EQ(read.value, problem.value);
  EXPECT_EQ(read.q, problem.q);
  EXPECT_EQ(read.mu, problem.mu);
  EXPECT_EQ(read.guess_r, problem.guess_r);
  EXPECT_EQ(read.reals, problem.reals);
  EXPECT_EQ(read.integers, problem.integers);
  EXPECT_FALSE(std::filesystem::exists(folder.path("p.h5.tmp")));
}

TEST_F(FclibFile, equal_problems_have_equal_bytes) {
  write_fclib(folder.path("one.h5"), with_bodies(), guess_u);
  write_fclib(folder.path("two.h5"), with_bodies(), guess_u);
  EXPECT_EQ(test::text_of(folder.path("one.h5")), test::text_of(folder.path("two.h5")));
}

TEST_F(FclibFile, a_solution_changes_nothing_else) {
  write_fclib(folder.path("p.h5"), with_bodies(), guess_u);
  write_fclib_solution(folder.path("p.h5"), folder.path("s.h5"), {1, 2, 3, 4}, {5, 6, 7, 8});
  write_fclib_solution(folder.path("s.h5"), folder.path("s.h5"), {4, 3, 2, 1},
                       {8, 7, 6, 5});  // replaces the file
  const FclibProblem read = read_fclib(folder.path("s.h5"));
  EXPECT_EQ(read.value, example().value);
  EXPECT_EQ(read.guess_r, example().guess_r);
  EXPECT_EQ(read.reals, with_bodies().reals);
}

TEST_F(FclibFile, of_no_contacts_is_a_problem_too) {
  write_fclib(folder.path("p.h5"), {}, {});
  EXPECT_TRUE(read_fclib(folder.path("p.h5")).mu.empty());
}

TEST_F(FclibFile, values_that_cannot_be_are_refused) {
  FclibProblem problem = example();
  problem.mu[1] = -0.25;
  expect_refused(problem, "/fclib_local/vectors/mu holds the negative value -0.25 at index 1");
  problem = example();
  problem.q[2] = std::numeric_limits<double>::quiet_NaN();
  expect_refused(problem, "/fclib_local/vectors/q holds a value that is not finite, at index 2");
  problem = example();
  problem.value[3] = std::numeric_limits<double>::infinity();
  expect_refused(problem, "/fclib_local/W/x holds a value that is not finite, at index 3");
  problem = example();
  problem.value[2] = -3.0;
  expect_refused(problem, "/fclib_local/W/x has the negative value -3 on the diagonal of W, in row 2");
  problem = example();
  problem.column[1] = 4;
  expect_refused(problem, "/fclib_local/W/i holds 4 at index 1, expected 0 to 3");
  problem = with_bodies();
  problem.integers["/talus/contacts/b"][0] = 3;
  expect_refused(problem, "/talus/contacts/b holds 3 at index 0, expected 0 to 2");
}

TEST_F(FclibFile, sizes_that_do_not_fit_are_refused) {
  FclibProblem problem = example();
  problem.mu.pop_back();
  expect_refused(problem,
                 "/fclib_local/vectors/q has 4 values, expected 2, two for each contact of "
                 "/fclib_local/vectors/mu");
  problem = example();
  problem.column.pop_back();
  expect_refused(problem,
                 "/fclib_local/W/i has 3 values, expected 4, one for each value of /fclib_local/W/x");
  problem = example();
  problem.row.pop_back();
  expect_refused(problem, "/fclib_local/W/p goes from 0 to 3, expected 0 to 4, the entries of W");
  problem = example();
  problem.guess_r.pop_back();
  expect_refused(problem,
                 "/guesses/1/r has 3 values, expected 4, two for each contact of /fclib_local/vectors/mu");
  problem = with_bodies();
  problem.reals["/talus/bodies/lever"].pop_back();
  expect_refused(problem,
                 "/talus/bodies/lever has 2 values, expected 3, one for each body of /talus/bodies/vx");
  problem = with_bodies();
  problem.reals.erase("/talus/contacts/nx");
  expect_refused(problem, "/talus/contacts/nx is missing");
}

TEST_F(FclibFile, may_begin_with_a_user_block) {
  write_fclib(folder.path("p.h5"), with_bodies(), guess_u);
  example::write_text(folder.path("block.h5"), std::string(1024, '#') + test::text_of(folder.path("p.h5")));
  EXPECT_EQ(read_fclib(folder.path("block.h5")).value, example().value);
}

TEST_F(FclibFile, what_is_no_hdf5_is_refused) {
  for (const char* text : {"", "no HDF5", "\x89HDF\r\n\x1a\n and so on"}) {
    example::write_text(folder.path("p.h5"), text);
    EXPECT_THROW(read_fclib(folder.path("p.h5")), Error) << text;
  }
  EXPECT_EQ(test::exit_code_of([&] { read_fclib(folder.path("none.h5")); }), ExitCode::missing_input);
}

TEST_F(FclibFile, is_documented_as_it_is) {
  std::ostringstream expected;
  for (const io::DataSetField& field : fclib_schema())
    expected << "| `" << field.path << "` | " << io::type_name(field.type) << " | "
             << (field.shape.empty() ? "-" : field.shape) << " | " << field.unit << " | " << field.help
             << " |\n";
  std::string found;
  std::istringstream page(test::text_of(test::source_folder() + "/docs/problem_files.md"));
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `/")) found += line + "\n";
  EXPECT_EQ(found, expected.str()) << "the table of docs/problem_files.md must be:\n" << expected.str();
}

}  // namespace
}  // namespace talus::problems
