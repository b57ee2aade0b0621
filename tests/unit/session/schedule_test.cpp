/// Schedule of a run, stored in and read from its checkpoint by a table of names; every value matters.
/// Measured quantities and estimates of a run.

#include "session/schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "session/estimate.h"
#include "session/measure.h"
#include "support/exit_code.h"

namespace talus::session {
namespace {

/// Returns a schedule in which every value differs.
Schedule full_schedule() {
  Schedule s;
  s.phase = Phase::flow;
  s.tilt_steps = 2;
  s.flow_steps = 4;
  s.quiet_steps = 5;
  s.unconverged_in_a_row = 6;
  s.baseline = {7.1, 8.1};
  s.flow = {.flowing = true, .onset_tilt = 0.31, .displacement = 0.02, .failed = true};
  s.surface_height = 0.4;
  s.surface_displacement = 0.05;
  s.residual_since_row = 3e-7;
  s.friction = 0.3;
  s.course = TiltCourse{0.17, 0.2, 12};
  s.last_tilt_step = 13;
  s.angle_at_rest = 0.28;
  s.record = {21, 22, 23, 1e-6, 2e-5};
  s.warnings = {{31, 32, 33, 34}, {41, 42, 43, 44}};
  s.broken = {51.5, 52.5, 53.5, 54.5};
  s.seconds.deposition = 1.5;
  s.seconds.tilt = 2.5;
  s.seconds.stages.fill(0.25);
  return s;
}

io::Checkpoint stored(const Schedule& schedule, bool follows = true) {
  io::Checkpoint checkpoint;
  store_schedule(schedule, follows, checkpoint);
  return checkpoint;
}

Schedule read(const io::Checkpoint& checkpoint, bool follows = true) {
  return stored_schedule(checkpoint, follows, "run.h5");
}

/// Returns the names from the given one on, each after a space.
template <typename Named>
std::string names(const Named& values, std::size_t from = 0) {
  std::string found;
  for (; from < values.size(); ++from) found += " " + values[from].first;
  return found;
}

std::string refusal(const io::Checkpoint& checkpoint) {
  const test::Refusal refused = test::refusal_of([&] { read(checkpoint); });
  EXPECT_EQ(refused.code, ExitCode::bad_data);
  return refused.message;
}

TEST(Schedule, comes_back_from_a_checkpoint_as_it_was) {
  const io::Checkpoint checkpoint = stored(full_schedule()), again = stored(read(checkpoint));
  EXPECT_EQ(again.integers, checkpoint.integers);
  EXPECT_EQ(again.reals, checkpoint.reals);
  EXPECT_EQ(again.results, checkpoint.results);
  EXPECT_EQ(again.timing, checkpoint.timing);
}

TEST(Schedule, each_stored_value_counts) {
  const io::Checkpoint checkpoint = stored(full_schedule());
  for (std::size_t k = 0; k < checkpoint.integers.size(); ++k) {
    io::Checkpoint other = checkpoint;
    other.integers[k].second = other.integers[k].second == 1 ? 0 : 1;
    EXPECT_NE(stored(read(other)).integers, checkpoint.integers) << checkpoint.integers[k].first;
  }
  for (std::size_t k = 0; k < checkpoint.reals.size(); ++k) {
    io::Checkpoint other = checkpoint;
    other.reals[k].second = std::nextafter(other.reals[k].second, 100.0);
    EXPECT_NE(stored(read(other)).reals, checkpoint.reals) << checkpoint.reals[k].first;
  }
}

/// No later step depends on the last one's report, so files without it are read.
TEST(Schedule, has_the_last_step_beside_its_state) {
  Schedule schedule = full_schedule();
  schedule.last = {1e-9, 2e-7, 1.0, 0.4, 0.2};
  const io::Checkpoint checkpoint = stored(schedule);
  EXPECT_EQ(stored(read(checkpoint)).reals, checkpoint.reals);
  EXPECT_FALSE(read(stored(full_schedule())).last.residual);
  schedule.last.residual = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(read(stored(schedule)).last.residual) << "a file has no infinite number";
  for (const char* name :
       {"last_largest_overlap", "last_residual", "last_converged", "last_friction", "last_wall_friction"})
    for (const double impossible : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
      io::Checkpoint other = checkpoint;
      for (auto& [known, value] : other.reals)
        if (known == name) value = impossible;
      EXPECT_TRUE(refusal(other).starts_with(std::string("run.h5: data set /checkpoint/reals/") + name))
          << impossible;
    }
}

TEST(Schedule, has_names_of_its_own_in_a_checkpoint) {
  const io::Checkpoint plain = stored({}, false), full = stored(full_schedule());
  EXPECT_EQ(names(plain.integers),
            " phase tilt_steps quiet_steps flowing failed unconverged_deposition unconverged_tilt");
  EXPECT_EQ(names(plain.reals),
            " baseline_volume baseline_centre_of_mass_height onset_tilt flow_displacement surface_height "
            "surface_displacement residual_since_row");
  EXPECT_EQ(names(plain.results),
            " theta_c residual_max residual_max_rest residual_max_moving unconverged_steps_deposition "
            "unconverged_steps");
  EXPECT_EQ(names(plain.timing),
            " deposition tilt stage_move stage_detect stage_recall stage_assemble stage_solve stage_store");
  EXPECT_EQ(names(full.integers, plain.integers.size()),
            " tilt_since last_tilt_step unconverged_in_a_row flow_steps unconverged_flow");
  EXPECT_EQ(names(full.reals, plain.reals.size()),
            " friction tilt_rate tilt_from broken_velocity broken_overlap broken_energy broken_unconverged");
  EXPECT_EQ(names(full.results, plain.results.size()),
            " warnings_velocity warnings_velocity_first_step warnings_overlap warnings_overlap_first_step "
            "warnings_energy warnings_energy_first_step warnings_unconverged warnings_unconverged_first_step "
            "theta_r unconverged_steps_flow");
}

TEST(Schedule, that_lacks_a_value_or_has_an_impossible_one_is_refused) {
  const io::Checkpoint checkpoint = stored(full_schedule());
  io::Checkpoint lacks = checkpoint;
  std::erase_if(lacks.reals, [](const auto& named) { return named.first == "tilt_from"; });
  EXPECT_EQ(refusal(lacks),
            "run.h5: data set /checkpoint/reals/tilt_from is missing; without it the run cannot continue");
  io::Checkpoint phase = checkpoint, steps = checkpoint;
  phase.integers[0].second = 4;
  EXPECT_EQ(refusal(phase), "run.h5: data set /checkpoint/integers/phase is 4, expected 0, 1, 2 or 3");
  steps.integers[1].second = -1;
  EXPECT_EQ(refusal(steps),
            "run.h5: data set /checkpoint/integers/tilt_steps is -1, expected a number of steps");
  for (io::Checkpoint other = checkpoint; auto& [name, value] : other.reals) {
    const double was = std::exchange(value, std::nan(""));
    EXPECT_EQ(refusal(other),
              "run.h5: data set /checkpoint/reals/" + name + " is nan, expected a finite number");
    value = was;
  }
  EXPECT_TRUE(test::has(test::refusal_of([&] { stored_schedule(phase, true, "run.h5", "/branch"); }).message,
                        "/branch/integers/phase"));
  io::Checkpoint untimed = checkpoint;
  untimed.timing.clear();
  EXPECT_EQ(read(untimed).seconds.tilt, 0.0) << "wall times are not part of the state";
}

TEST(Schedule, of_a_slope_at_rest_has_its_angle_and_one_before_has_none) {
  EXPECT_EQ(read(stored(full_schedule())).angle_at_rest, 0.28);
  Schedule flowing = full_schedule();
  flowing.angle_at_rest.reset();
  const io::Checkpoint checkpoint = stored(flowing);
  EXPECT_TRUE(std::isnan(*find_value(checkpoint.results, "theta_r")));
  EXPECT_FALSE(read(checkpoint).angle_at_rest);
}

constexpr double friction = 0.5;

/// Returns three free grains above a floor grain, of which the first two rest on it. The force between these
/// two, and that between the second and the third, are remains: `share` times the mean weight, sliding.
World bed_with_remains(double share) {
  World world;
  for (const double x : {0.1, 0.2, 0.3}) add_disk(world.grains, {x, 0.2}, 0.05, 2500.0, false);
  add_disk(world.grains, {0.15, 0.1}, 0.05, 2500.0, true);
  world.boundary.periodic = true;
  world.boundary.length = 1.0;
  const double weight = world.grains.mass[0] * world.gravity;
  Contacts& contacts = world.contacts;
  contacts.resize(4);
  contacts.a = {0, 0, 1, 1};
  contacts.b = {1, 3, 2, 3};
  contacts.nx = {1.0, 0.6, 1.0, -0.6};
  contacts.ny = {0.0, -0.8, 0.0, -0.8};
  contacts.fn = {share * weight, weight, share * weight, weight};
  contacts.ft = {friction * share * weight, 0.0, friction * share * weight, 0.1 * weight};
  return world;
}

dynamics::ContactLawParameters law() {
  dynamics::ContactLawParameters law;
  law.friction = friction;
  return law;
}

TEST(Measure, takes_a_contact_below_1e_9_of_the_weight_of_a_grain_as_open) {
  for (const double share : {0.99e-9, 1e-40}) {
    const World world = bed_with_remains(share);
    const ObservableRow row = measure(world, {.baseline = {1.0, 1.0}, .law = law()});
    EXPECT_EQ(at(row, Observable::coordination_number), 1.0) << "two grains with one contact each";
    EXPECT_EQ(at(row, Observable::critical_fraction), 0.0);
    const Frame frame = make_frame(world, law());
    EXPECT_EQ(frame.contacts.a, (std::vector<Index>{0, 1}));
    EXPECT_EQ(frame.contacts.b, (std::vector<Index>{3, 3}));
    EXPECT_TRUE(std::isfinite(frame.gamma[0]) && std::isfinite(frame.gamma[1]));
    EXPECT_TRUE(std::isnan(frame.gamma[2])) << "it carries nothing but remains";
    EXPECT_EQ(frame.internal_moment[2].xx, 0.0);
  }
}

TEST(Measure, takes_a_contact_from_1e_9_of_the_weight_of_a_grain_on_as_loaded) {
  const World world = bed_with_remains(1.01e-9);
  const ObservableRow row = measure(world, {.baseline = {1.0, 1.0}, .law = law()});
  EXPECT_DOUBLE_EQ(at(row, Observable::coordination_number), 2.0) << "two, three and one contacts";
  EXPECT_EQ(at(row, Observable::critical_fraction), 0.5);
  EXPECT_EQ(make_frame(world, law()).contacts.count(), 4);
}

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
