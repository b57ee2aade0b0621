/// Guards detect what no sound run does: the run stops in a consistent state, or continues with a warning.

#include "session/guards.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "base/hash.h"
#include "session/session.h"
#include "support/small_bed.h"

namespace talus::session {
namespace {

scenario::Scenario small_bed() { return test::small_tilted_bed(0.2); }

Session run_to_end(const scenario::Scenario& scenario) {
  Session session(scenario);
  while (session.phase() != Phase::done) session.advance();
  return session;
}

/// Returns the message of the guard that stops the run, and the step.
std::pair<std::string, std::int64_t> stopped_by(const scenario::Scenario& scenario) {
  Session session(scenario);
  try {
    while (session.phase() != Phase::done) session.advance();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return {error.what(), session.world().step};
  }
  return {"", session.world().step};
}

TEST(Guards, sound_runs_break_none) {
  const Session session = run_to_end(small_bed());
  for (const std::int64_t steps : session.schedule().warnings.steps) EXPECT_EQ(steps, 0);
}

TEST(Guards, each_stops_the_run_with_its_limit) {
  scenario::Scenario fast = small_bed(), deep = small_bed(), energetic = small_bed(), unsolved = small_bed();
  fast.guards.velocity = 0.5;
  deep.guards.overlap = 1e-9;
  energetic.guards.energy = 1e-3;
  unsolved.guards.unconverged = 2;
  unsolved.solver.max_iterations = 1;
  for (const auto& [scenario, name] : {std::pair{fast, "guards.velocity allows 0.5"},
                                       {deep, "guards.overlap allows 1e-09"},
                                       {energetic, "guards.energy allows 0.001"},
                                       {unsolved, "guards.unconverged allows 2"}}) {
    const auto [message, step] = stopped_by(scenario);
    EXPECT_NE(message.find(name), std::string::npos) << message;
    EXPECT_EQ(message.find("step " + std::to_string(step) + ": "), 0u) << message;
  }
}

TEST(Guards, stop_after_a_whole_step) {
  scenario::Scenario scenario = small_bed();
  scenario.guards.velocity = 0.5;
  Session stopped(scenario), plain(small_bed());
  EXPECT_THROW(while (true) stopped.advance(), Error);
  while (plain.world().step < stopped.world().step) plain.advance();
  EXPECT_EQ(state_hash(stopped.world()), state_hash(plain.world()));
  EXPECT_EQ(stopped.segment().steps, plain.segment().steps);
  EXPECT_THROW(stopped.advance(), Error) << "each time it is asked to continue";
  Session resumed(scenario, stopped.checkpoint(0.0));
  EXPECT_THROW(while (true) resumed.advance(), Error) << "a resumed run is stopped too";
}

TEST(Guards, are_not_passed_by_a_resumed_run_or_a_copy) {
  scenario::Scenario scenario = small_bed();
  scenario.guards.overlap = 1e-9;
  Session session(scenario);
  EXPECT_THROW(while (true) session.advance(), Error);
  Session again(scenario, session.checkpoint(0.0));
  Session copy = session.copy();
  for (Session* stopped : {&session, &again, &copy}) {
    try {
      stopped->advance();
      FAIL() << "a step was taken";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("guards.overlap allows 1e-09"), std::string::npos);
    }
    EXPECT_EQ(stopped->world().step, session.world().step);
  }
}

TEST(Guards, warn_counts_what_they_let_pass) {
  scenario::Scenario scenario = small_bed();
  scenario.guards.action = scenario::GuardAction::warn;
  scenario.guards.velocity = 0.5;
  const Session session = run_to_end(scenario);
  const GuardWarnings& warnings = session.schedule().warnings;
  const auto velocity = static_cast<std::size_t>(Guard::velocity);
  EXPECT_GT(warnings.steps[velocity], 5);
  EXPECT_LT(warnings.steps[velocity], session.world().step);
  scenario::Scenario stop = scenario;
  stop.guards.action = scenario::GuardAction::stop;
  EXPECT_EQ(warnings.first[velocity], stopped_by(stop).second);
  EXPECT_EQ(state_hash(session.world()), state_hash(run_to_end(small_bed()).world()))
      << "monitoring changes nothing";

  const io::Checkpoint checkpoint = session.checkpoint(0.0);
  const Session again(scenario, checkpoint);
  EXPECT_EQ(again.schedule().warnings.steps, warnings.steps);
  EXPECT_EQ(again.schedule().warnings.first, warnings.first);
  double recorded = 0.0;
  for (const auto& [name, value] : checkpoint.results)
    if (name == "warnings_velocity") recorded = value;
  EXPECT_EQ(recorded, static_cast<double>(warnings.steps[velocity]));
}

TEST(Guards, steps_in_a_row_are_counted_over_a_restart) {
  scenario::Scenario scenario = small_bed();
  scenario.guards.unconverged = 10;
  scenario.solver.max_iterations = 1;
  const std::int64_t whole = stopped_by(scenario).second;
  Session before(scenario);
  while (before.world().step < whole - 4) before.advance();
  Session after(scenario, before.checkpoint(0.0));
  EXPECT_THROW(while (true) after.advance(), Error);
  EXPECT_EQ(after.world().step, whole);
}

}  // namespace
}  // namespace talus::session
