/// Schedule of a run, stored in and read from its checkpoint by a table of names; every value matters.

#include "session/schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.h"

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

template <typename Named>
std::vector<std::string> names(const Named& values) {
  std::vector<std::string> found;
  for (const auto& [name, value] : values) found.push_back(name);
  return found;
}

std::string refusal(const io::Checkpoint& checkpoint) {
  try {
    read(checkpoint);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return error.what();
  }
  return "";
}

TEST(Schedule, comes_back_from_a_checkpoint_as_it_was) {
  const io::Checkpoint checkpoint = stored(full_schedule()), again = stored(read(checkpoint));
  EXPECT_EQ(schedule_hash(read(checkpoint)), schedule_hash(full_schedule()));
  EXPECT_EQ(again.integers, checkpoint.integers);
  EXPECT_EQ(again.reals, checkpoint.reals);
  EXPECT_EQ(again.results, checkpoint.results);
  EXPECT_EQ(again.timing, checkpoint.timing);
}

TEST(Schedule, each_stored_value_counts) {
  const io::Checkpoint checkpoint = stored(full_schedule());
  const std::uint64_t hash = schedule_hash(full_schedule());
  for (std::size_t k = 0; k < checkpoint.integers.size(); ++k) {
    io::Checkpoint other = checkpoint;
    other.integers[k].second = other.integers[k].second == 1 ? 0 : 1;
    EXPECT_NE(schedule_hash(read(other)), hash) << checkpoint.integers[k].first;
  }
  for (std::size_t k = 0; k < checkpoint.reals.size(); ++k) {
    io::Checkpoint other = checkpoint;
    other.reals[k].second = std::nextafter(other.reals[k].second, 100.0);
    EXPECT_NE(schedule_hash(read(other)), hash) << checkpoint.reals[k].first;
  }
}

/// No later step depends on the last one's report, so it counts for no hash, and files without it are read.
TEST(Schedule, has_the_last_step_beside_its_state) {
  Schedule schedule = full_schedule();
  schedule.last = {1e-9, 2e-7, 1.0, 0.4, 0.2};
  const io::Checkpoint checkpoint = stored(schedule);
  EXPECT_EQ(stored(read(checkpoint)).reals, checkpoint.reals);
  EXPECT_EQ(schedule_hash(schedule), schedule_hash(full_schedule()));
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
  const io::Checkpoint plain = stored({}, false);
  EXPECT_EQ(names(plain.integers),
            (std::vector<std::string>{"phase", "tilt_steps", "quiet_steps", "flowing", "failed",
                                      "unconverged_deposition", "unconverged_tilt"}));
  EXPECT_EQ(names(plain.reals), (std::vector<std::string>{"baseline_volume", "baseline_centre_of_mass_height",
                                                          "onset_tilt", "flow_displacement", "surface_height",
                                                          "surface_displacement", "residual_since_row"}));
  EXPECT_EQ(names(plain.results),
            (std::vector<std::string>{"theta_c", "residual_max", "residual_max_rest", "residual_max_moving",
                                      "unconverged_steps_deposition", "unconverged_steps"}));
  EXPECT_EQ(names(plain.timing),
            (std::vector<std::string>{"deposition", "tilt", "stage_move", "stage_detect", "stage_recall",
                                      "stage_assemble", "stage_solve", "stage_store"}));
  const io::Checkpoint full = stored(full_schedule());
  const auto added = [](const std::vector<std::string>& all, std::size_t from) {
    return std::vector<std::string>(all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
  };
  EXPECT_EQ(added(names(full.integers), plain.integers.size()),
            (std::vector<std::string>{"tilt_since", "last_tilt_step", "unconverged_in_a_row", "flow_steps",
                                      "unconverged_flow"}));
  EXPECT_EQ(added(names(full.reals), plain.reals.size()),
            (std::vector<std::string>{"friction", "tilt_rate", "tilt_from", "broken_velocity",
                                      "broken_overlap", "broken_energy", "broken_unconverged"}));
  EXPECT_EQ(
      added(names(full.results), plain.results.size()),
      (std::vector<std::string>{"warnings_velocity", "warnings_velocity_first_step", "warnings_overlap",
                                "warnings_overlap_first_step", "warnings_energy",
                                "warnings_energy_first_step", "warnings_unconverged",
                                "warnings_unconverged_first_step", "theta_r", "unconverged_steps_flow"}));
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
  try {
    stored_schedule(phase, true, "run.h5", "/branch");
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "run.h5: data set /branch/integers/phase is 4, expected 0, 1, 2 or 3");
  }
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

}  // namespace
}  // namespace talus::session
