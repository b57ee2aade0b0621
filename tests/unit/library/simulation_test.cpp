/// A run driven step by step is bit-identical to an uninterrupted one, and can be inspected at any time.

#include "library/simulation.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "base/hash.h"
#include "core/random.h"
#include "io/run_file.h"
#include "session/run.h"
#include "session/run_check.h"
#include "session/run_header.h"
#include "support/exit_code.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t to_the_end = 1'000'000;

/// Returns a scenario with pouring, so that grains arrive during inspection.
scenario::Scenario poured_bed() {
  scenario::Scenario scenario = test::small_tilted_bed(3.0);
  scenario.deposition.method = scenario::DepositionMethod::pour;
  return scenario;
}

/// Returns the state at the end of an uninterrupted run.
std::string end_of(const scenario::Scenario& scenario) {
  session::Session session(scenario);
  session::replay(session, nullptr, {}, to_the_end, {});
  return hash_text(state_hash(session.world()));
}

/// Returns the state that results from the start and the commands of a file.
std::string replayed(const io::RunFile& run) {
  session::Session session = session::session_at_start(run.header(), "run");
  session::replay(session, nullptr, run.commands(), to_the_end, {});
  return hash_text(state_hash(session.world()));
}

class SimulationOfChance : public testing::TestWithParam<int> {};

TEST_P(SimulationOfChance, has_the_same_bits) {
  const scenario::Scenario scenario = poured_bed();
  const test::TemporaryFolder folder;
  Random random(static_cast<std::uint64_t>(GetParam()));
  Simulation sim(scenario);
  sim.use_threads(1 + GetParam() % 2);
  const bool recorded = GetParam() % 3 == 0;
  if (recorded) sim.record(folder.path("run.h5"));
  while (!sim.done()) {
    const double choice = random.uniform(0.0, 6.0);
    if (choice < 1.0)
      sim.step(1 + static_cast<std::int64_t>(random.uniform(0.0, 40.0)));
    else if (choice < 2.0)
      sim.run(random.uniform(0.0005, 0.02));
    else if (choice < 3.0)
      sim.tilt_by(random.uniform(0.0, 0.3));
    else if (choice < 4.0)
      sim.grain_values("gamma_neighbourhood");
    else if (choice < 5.0)
      sim.quantity("lc/mean");
    else if (!recorded)
      sim = Simulation(sim);
    else
      sim.commit();
  }
  static const std::string expected = end_of(scenario);
  EXPECT_EQ(sim.state_hash(), expected);
  EXPECT_TRUE(!recorded || io::RunFile::open(folder.path("run.h5")).complete());
}

INSTANTIATE_TEST_SUITE_P(Chunks, SimulationOfChance, testing::Range(0, 30));

using SimulationTest = test::FolderTest;

TEST_F(SimulationTest, is_repeated_from_its_file_with_its_commands) {
  Simulation sim(poured_bed());
  sim.record(folder.path("run.h5"));
  sim.deposit();
  sim.push(3, {0.1, 0.2});
  sim.step(5);
  sim.set_friction(0.3);
  sim.drag(4, {0.02, 0.03});
  sim.step(3);
  sim.release();
  sim.drop(2, 0.01, 0.01);
  sim.finish();
  EXPECT_NE(sim.state_hash(), end_of(poured_bed()));
  EXPECT_EQ(replayed(io::RunFile::open(folder.path("run.h5"))), sim.state_hash());
}

TEST_F(SimulationTest, of_a_grain_that_passes_several_periods_in_a_step_is_stored) {
  scenario::Scenario scenario = test::small_tilted_bed(10.0);
  scenario.tilt.rate = 100.0;
  scenario.tilt.step = scenario.output.frame_every = scenario.output.observable_every = 1.0;  // 10 ms
  scenario.guards.action = scenario::GuardAction::warn;
  {
    Simulation sim(scenario);
    sim.record(folder.path("run.h5"));
    sim.deposit();
    sim.push(22, {31.0, 0.0});  // 0.31 m, or 3.1 periods, in a step
    sim.step(1);
    std::vector<int> shifts{0};
    for (const std::int8_t shift : sim.world().contacts.shift) shifts.push_back(std::abs(shift));
    EXPECT_GE(std::ranges::max(shifts), 2);
  }
  Simulation sim = Simulation::resume(folder.path("run.h5"));
  sim.step(2);
  sim.commit();
  const io::RunFile run = io::RunFile::open(folder.path("run.h5"));
  std::vector<int> shifts;
  for (std::size_t k = 0; k < run.frame_count(); ++k)
    for (const std::int8_t shift : run.frame(k).contacts.shift) shifts.push_back(std::abs(shift));
  EXPECT_GE(std::ranges::max(shifts), 2);
  EXPECT_EQ(session::check_run(run, {}).faults, std::vector<std::string>());
  session::Session again = session::session_at_start(run.header(), "run");
  session::replay(again, nullptr, run.commands(), sim.world().step, {});
  EXPECT_EQ(hash_text(state_hash(again.world())), sim.state_hash());
}

TEST_F(SimulationTest, is_recorded_by_several_threads_side_by_side) {
  std::vector<std::thread> threads;
  std::atomic<int> failed = 0;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      try {
        Simulation sim(test::small_tilted_bed(1.0));
        sim.record(folder.path(std::to_string(k) + ".h5"));
        for (int step = 0; step < 12; ++step) {
          sim.step(2);
          sim.commit();
        }
      } catch (const Error&) {
        ++failed;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(failed, 0);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(io::RunFile::open(folder.path(std::to_string(k) + ".h5")).checkpoint().world.step, 24);
}

TEST_F(SimulationTest, that_is_resumed_measures_motion_from_the_first_frame_of_its_file) {
  Simulation sim(test::small_tilted_bed(3.0));
  EXPECT_TRUE(std::isnan(sim.grain_values("rotation").front())) << "the tilt has not begun";
  sim.record(folder.path("run.h5"));
  sim.tilt_to(1.5);
  const std::vector<double> before = sim.grain_values("rotation");
  const auto free_count = static_cast<std::size_t>(sim.world().grains.free_count);
  EXPECT_TRUE(std::ranges::any_of(before, [](double angle) { return angle > 0.0; }));
  sim.commit();
  { const Simulation gone = std::move(sim); }
  Simulation resumed = Simulation::resume(folder.path("run.h5"));
  const std::vector<double> after = resumed.grain_values("rotation");
  for (std::size_t i = 0; i < free_count; ++i) EXPECT_NEAR(after[i], before[i], 1e-6) << i;
}

TEST_F(SimulationTest, that_is_a_copy_says_what_the_original_says) {
  Simulation sim(test::small_tilted_bed(3.0));
  sim.tilt_to(0.5);
  const Simulation copy = sim;
  EXPECT_EQ(sim.converged(), true);
  EXPECT_EQ(copy.converged(), sim.converged());
  EXPECT_EQ(copy.residual(), sim.residual());
}

/// The overlap is that of the contacts of the state, computed here from their gaps.
TEST_F(SimulationTest, that_is_resumed_or_branched_off_knows_its_last_step) {
  Simulation sim(test::small_tilted_bed(3.0));
  EXPECT_FALSE(sim.residual());
  EXPECT_FALSE(sim.converged());
  EXPECT_TRUE(std::isnan(sim.quantity("largest_overlap")));
  sim.record(folder.path("run.h5"));
  sim.tilt_to(1.0);
  sim.commit();
  sim.save(folder.path("branch.h5"));
  const double overlap = -std::ranges::min(sim.world().contacts.gap);
  const std::optional<double> residual = sim.residual();
  EXPECT_GT(overlap, 0.0);
  EXPECT_EQ(sim.quantity("largest_overlap"), overlap);
  { const Simulation gone = std::move(sim); }
  const auto first_row = [](const std::string& path) { return io::RunFile::open(path).all_observables()[0]; };
  for (const char* name : {"run.h5", "branch.h5"}) {
    Simulation later = Simulation::resume(folder.path(name));
    EXPECT_EQ(later.quantity("largest_overlap"), overlap) << name;
    EXPECT_EQ(later.residual(), residual) << name;
    EXPECT_EQ(later.quantity("residual"), residual) << name << ": a row has just been recorded";
    EXPECT_EQ(later.converged(), true) << name;
    later.save(folder.path("again"), true);
    EXPECT_EQ(at(first_row(folder.path("again")), Observable::largest_overlap), overlap) << name;
  }
  EXPECT_EQ(at(first_row(folder.path("branch.h5")), Observable::largest_overlap), overlap);
}

/// Paths are those of the folder in which a recording began, whatever the folder of the process is later.
TEST_F(SimulationTest, goes_on_in_its_file_when_the_process_changes_its_folder) {
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path(""));
  std::filesystem::create_directory("other");
  Simulation sim(test::small_tilted_bed(1.0));
  sim.record("deep/down/run.h5");
  sim.deposit();
  sim.save("deep/saved.h5");
  Simulation saved = Simulation::resume("deep/saved.h5");
  std::filesystem::current_path("other");
  EXPECT_NO_THROW(sim.finish());
  EXPECT_NO_THROW(saved.finish());
  std::filesystem::current_path(before);
  EXPECT_TRUE(io::RunFile::open(folder.path("deep/down/run.h5")).complete());
  EXPECT_TRUE(io::RunFile::open(folder.path("deep/saved.h5")).complete());
  EXPECT_TRUE(test::refuses([&] { Simulation::resume(folder.path("deep/saved.h5")); }, ExitCode::usage,
                            {"is complete"}));
}

TEST_F(SimulationTest, of_a_replay_that_was_stopped_is_not_resumed) {
  const scenario::Scenario scenario = test::small_tilted_bed(3.0);
  {
    session::Session session(scenario);
    io::RunHeader header = session::run_header(session, {});
    header.provenance.emplace_back("replay_of", "run.h5");
    header.provenance.emplace_back("replay_steps", "100000");
    io::RunStore store = io::RunStore::create(folder.path("replay.h5"), header, false);
    session::Recorder recorder(session, store);
    recorder.advance();
    recorder.commit();
  }
  EXPECT_EQ(test::exit_code_of([&] { Simulation::resume(folder.path("replay.h5")); }), ExitCode::bad_data);
}

TEST_F(SimulationTest, that_is_saved_goes_on_from_there_as_often_as_it_is_resumed) {
  Simulation sim(test::small_tilted_bed(3.0));
  sim.deposit();
  sim.set_friction(0.3);
  sim.save(folder.path("saved.h5"));
  const std::string state = sim.state_hash();
  EXPECT_FALSE(sim.recorded());
  EXPECT_EQ(test::exit_code_of([&] { sim.save(folder.path("saved.h5")); }), ExitCode::cannot_create);
  sim.finish();
  Simulation later = Simulation::resume(folder.path("saved.h5"));
  EXPECT_EQ(later.state_hash(), state);
  EXPECT_EQ(later.friction(), 0.3);
  later.finish();
  EXPECT_EQ(later.state_hash(), sim.state_hash());
  EXPECT_EQ(later.theta_c(), sim.theta_c());
}

TEST_F(SimulationTest, that_is_recorded_later_is_a_branch_which_can_be_repeated) {
  Simulation sim(poured_bed());
  sim.step(5);
  EXPECT_EQ(test::exit_code_of([&] { sim.record(folder.path("run.h5")); }), ExitCode::usage)
      << "the bed is poured";
  sim.tilt_to(1.0);
  sim.push(2, {0.05, 0.0});
  sim.record(folder.path("run.h5"));
  sim.set_friction(0.4);
  sim.finish();
  const io::RunFile run = io::RunFile::open(folder.path("run.h5"));
  EXPECT_TRUE(run.header().branch.has_value());
  EXPECT_EQ(replayed(run), sim.state_hash());
}

TEST_F(SimulationTest, has_its_grains_where_they_were_while_more_arrive) {
  Simulation sim(poured_bed());
  const double* x = sim.world().grains.x.data();
  const Index first = sim.world().grains.count();
  sim.deposit();
  EXPECT_GT(sim.world().grains.count(), first);
  sim.finish();
  EXPECT_EQ(sim.world().grains.x.data(), x);
  Simulation copy = Simulation(poured_bed());
  copy.step(3);
  copy = Simulation(copy);
  x = copy.world().grains.x.data();
  copy.finish();
  EXPECT_EQ(copy.world().grains.x.data(), x);
}

TEST_F(SimulationTest, is_interrupted_between_two_steps) {
  scenario::Scenario slow = test::small_tilted_bed(3.0);
  slow.bed.length = 40.0;
  slow.bed.depth = 10.0;
  slow.tilt.rate = 0.5;
  slow.tilt.step = 0.0005;
  Simulation sim(slow);
  sim.deposit();
  sim.interrupt_if([] { return true; });
  EXPECT_FALSE(sim.finish());
  EXPECT_FALSE(sim.done());
  const std::int64_t step = sim.world().step;
  sim.interrupt_if([]() -> bool { throw std::runtime_error("enough"); });
  EXPECT_THROW(sim.finish(), std::runtime_error);
  EXPECT_GT(sim.world().step, step);
  sim.interrupt_if({});
  EXPECT_TRUE(sim.finish());
  EXPECT_EQ(sim.state_hash(), end_of(slow));
}

/// Returns the exit status of a forked child that executes the work.
template <typename Work>
int code_of_child(const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work() ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST_F(SimulationTest, is_looked_at_and_copied_in_a_child_of_fork_and_goes_on_in_the_parent) {
  std::optional<Simulation> sim(poured_bed());
  sim->record(folder.path("run.h5"));
  sim->tilt_to(1.0);
  EXPECT_EQ(code_of_child([&] {
              const auto refused = [](const auto& call) {
                return test::exit_code_of(call) == ExitCode::usage;
              };
              bool ok = refused([&] { sim->step(); }) && refused([&] { sim->set_friction(0.1); }) &&
                        refused([&] { sim->commit(); }) && refused([&] { sim->use_threads(2); });
              Simulation copy = *sim;
              ok = ok && copy.state_hash() == sim->state_hash();
              copy.finish();
              sim.reset();
              return ok && copy.state_hash() == end_of(poured_bed());
            }),
            0);
  sim->interrupt_if([] { return false; });
  sim->finish();
  EXPECT_EQ(sim->state_hash(), end_of(poured_bed()));
  EXPECT_EQ(replayed(io::RunFile::open(folder.path("run.h5"))), sim->state_hash());
}

TEST_F(SimulationTest, that_is_left_is_free_though_a_child_of_fork_has_its_files) {
  std::optional<Simulation> sim(poured_bed());
  sim->record(folder.path("run.h5"));
  sim->step(3);
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe[1]);
    char end = 0;
    ::_exit(static_cast<int>(::read(pipe[0], &end, 1)));  // waits until the parent closes its end
  }
  sim.reset();
  EXPECT_NO_THROW(Simulation::resume(folder.path("run.h5")).step(3));
  ::close(pipe[1]);
  ::close(pipe[0]);
  ::waitpid(child, nullptr, 0);
}

TEST_F(SimulationTest, pushes_all_grains_or_none) {
  Simulation sim(test::small_tilted_bed(1.0));
  const std::string before = sim.state_hash();
  const std::vector<Vec2> velocities = {{0.1, 0.0}, {0.1, 0.0}};
  EXPECT_EQ(test::exit_code_of([&] { sim.push({1, 1000}, velocities); }), ExitCode::usage);
  EXPECT_EQ(sim.state_hash(), before);
  sim.push({1, 2}, velocities);
  EXPECT_NE(sim.state_hash(), before);
}

TEST_F(SimulationTest, refuses_what_cannot_be) {
  Simulation sim(test::small_tilted_bed(1.0));
  const auto refused = [](const auto& call) { return test::exit_code_of(call); };
  EXPECT_EQ(refused([&] { sim.step(-1); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.tilt_to(not_a_number); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.run(not_a_number); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.use_threads(0); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.push(1000, {0.0, 0.0}); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.quantity("overload/fraction"); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.quantity("lc/mean[7]"); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.quantity("lc/mean[x]"); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.grain_values(""); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.contact_values("gamma"); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.draw("gama"); }), ExitCode::usage);
  sim.deposit();
  sim.set_tilt_rate(0.0);
  for (const double angle : {1.0, -1.0})
    EXPECT_EQ(refused([&] { sim.tilt_by(angle); }), ExitCode::usage) << "it never reaches that tilt";
  EXPECT_EQ(refused([&] { sim.finish(); }), ExitCode::usage) << "a held tilt has no end";
  sim.set_tilt_rate(20.0);
  sim.record(folder.path("run.h5"));
  EXPECT_EQ(refused([&] { sim.record(folder.path("other.h5")); }), ExitCode::usage);
  sim.step(std::numeric_limits<std::int64_t>::max());
  EXPECT_TRUE(sim.done()) << "all steps are present";
  EXPECT_EQ(refused([&] { sim.step(); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { sim.set_friction(0.2); }), ExitCode::usage);
  EXPECT_EQ(refused([&] { Simulation::resume(folder.path("none.h5")); }), ExitCode::missing_input);
}

}  // namespace
}  // namespace talus
