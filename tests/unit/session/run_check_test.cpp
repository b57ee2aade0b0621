/// An intact run passes; impossible values are found and named. Guards detect what no sound run does: the run
/// stops in a consistent state, or continues with a warning.

#include "session/run_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "session/measure.h"
#include "session/session.h"
#include "support/exit_code.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

scenario::Scenario checked_bed() {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.output.observable_every = 0.1;
  return scenario;
}

/// Returns a finished run of the small bed, computed once.
const Session& finished_run() {
  static const Session session = test::finished(checked_bed());
  return session;
}

/// Checks a run file in which something has been changed.
RunCheck check_with(const std::function<void(io::Segment&)>& change,
                    const Session& session = finished_run()) {
  const test::TemporaryFolder folder;
  const io::RunFile run = test::stored(session, folder.path("run.h5"), change);
  std::size_t frames = 0;
  const RunCheck check = check_run(run, [&frames](std::size_t done) { frames = done; });
  EXPECT_EQ(frames, session.segment().frames.size());
  return check;
}

std::string faults_of(const RunCheck& check) {
  std::string all;
  for (const std::string& fault : check.faults) all += fault + "\n";
  return all;
}

TEST(RunCheck, a_run_is_whole) {
  const RunCheck check = check_with([](io::Segment&) {});
  EXPECT_EQ(faults_of(check), "");
  EXPECT_EQ(check.frames, 3u);
  EXPECT_EQ(check.steps, finished_run().segment().steps.size());
  EXPECT_GE(check.frames_at_rest, 1u);
  EXPECT_LT(check.largest_imbalance, imbalance_limit);
  EXPECT_GT(check.largest_mobilisation, 0.1);
  EXPECT_LE(check.largest_mobilisation, mobilisation_limit);
  EXPECT_LT(check.largest_moment_error, 1e-5);
}

struct Damage {
  const char* name;
  std::function<void(io::Segment&)> done;
  const char* fault;  ///< expected in the finding
};

const Damage damages[] = {
    {"a_contact_that_pulls", [](io::Segment& s) { s.frames[1].contacts.fn[3] *= -1.0; },
     "frame 1: 1 contacts pull"},
    {"too_much_friction",
     [](io::Segment& s) { s.frames[1].contacts.ft[3] = 2.0 * s.frames[1].contacts.fn[3]; },
     "Coulomb's law allows 1"},
    {"another_force", [](io::Segment& s) { s.frames[0].contacts.fn[5] *= 1.5; },
     "frame 0: internal_moment does not match the contacts"},
    {"another_moment", [](io::Segment& s) { s.frames[2].internal_moment[4].xy += 0.5; },
     "frame 2: internal_moment"},
    {"another_tilt", [](io::Segment& s) { s.frames[0].tilt = 0.5; }, "forces and weight differ by"},
    {"two_grains_in_one_place",
     [](io::Segment& s) {
       s.frames[1].x[2] = s.frames[1].x[9];
       s.frames[1].y[2] = s.frames[1].y[9];
     },
     "frame 1: "},
    {"a_grain_outside", [](io::Segment& s) { s.frames[1].x[2] = 2.0; }, "outside the period"},
    {"frames_of_one_step", [](io::Segment& s) { s.frames[2].step = s.frames[1].step; },
     "/frames/step: frame 2"},
    {"another_number_of_a_step", [](io::Segment& s) { at(s.steps[7], StepField::step) = 9.0; },
     "/steps/step: row 7"},
    {"a_step_less", [](io::Segment& s) { s.steps.pop_back(); }, "/checkpoint/step"},
    {"no_number",
     [](io::Segment& s) {
       at(s.observables[2], Observable::kinetic_energy) = std::numeric_limits<double>::quiet_NaN();
     },
     "/observables/kinetic_energy: row 2"},
    {"rows_out_of_order", [](io::Segment& s) { std::swap(s.observables[1], s.observables[2]); },
     "/observables/step: row"},
};

class RunCheckFinds : public testing::TestWithParam<Damage> {};

TEST_P(RunCheckFinds, what_cannot_be) {
  const std::string found = faults_of(check_with(GetParam().done));
  EXPECT_NE(found.find(GetParam().fault), std::string::npos)
      << "expected: " << GetParam().fault << "\nfound: " << found;
}

INSTANTIATE_TEST_SUITE_P(all, RunCheckFinds, testing::ValuesIn(damages),
                         [](const auto& damage) { return damage.param.name; });

/// Moves a grain of the first contact between two grains almost onto the other.
void overlap_two_grains(io::Segment& segment) {
  Frame& frame = segment.frames[1];
  const FrameContacts& contacts = frame.contacts;
  std::size_t c = 0;
  while (contacts.b[c] >= frame.grain_count() || contacts.shift[c] != 0) ++c;
  const auto a = static_cast<std::size_t>(contacts.a[c]), b = static_cast<std::size_t>(contacts.b[c]);
  frame.x[b] = frame.x[a];
  frame.y[b] = frame.y[a];
}

TEST(RunCheck, tells_of_overlaps_unless_the_guards_of_the_run_let_it_go_on) {
  const auto is_reported = [](const Session& session) {
    return faults_of(check_with(overlap_two_grains, session)).find("two grains overlap") != std::string::npos;
  };
  EXPECT_TRUE(is_reported(finished_run()));
  scenario::Scenario scenario = checked_bed();
  scenario.guards.overlap = 10.0;
  EXPECT_FALSE(is_reported(test::finished(scenario)));
  scenario.guards = {};
  scenario.guards.action = scenario::GuardAction::warn;
  EXPECT_FALSE(is_reported(test::finished(scenario))) << "the overlap is recorded and is not a damage";
}

TEST(RunCheck, allows_a_bed_at_rest_what_its_rest_velocity_allows) {
  const auto is_reported = [](double rest_velocity, double factor) {
    scenario::Scenario scenario = checked_bed();
    scenario.deposition.rest_velocity = rest_velocity;
    // Scales all forces of the flat bed, which unbalances the weight by 1 - factor.
    const auto scale_forces = [factor](io::Segment& s) {
      Frame& frame = s.frames[0];
      for (std::size_t c = 0; c < frame.contacts.fn.size(); ++c) {
        frame.contacts.fn[c] *= factor;
        frame.contacts.ft[c] *= factor;
      }
    };
    return faults_of(check_with(scale_forces, test::finished(scenario))).find("forces and weight differ") !=
           std::string::npos;
  };
  EXPECT_TRUE(is_reported(0.005, 0.9));
  EXPECT_FALSE(is_reported(0.05, 0.9)) << "0.1 m g, of 4 times 0.05";
  EXPECT_TRUE(is_reported(0.05, 0.7));
}

TEST(RunCheck, judges_the_first_frame_by_the_friction_of_the_deposition) {
  scenario::Scenario scenario = checked_bed();
  scenario.deposition.friction = scenario.deposition.wall_friction = 0.5;
  scenario.contact.friction = scenario.contact.wall_friction = 0.1;
  EXPECT_EQ(faults_of(check_with([](io::Segment&) {}, test::finished(scenario))), "");
}

TEST(RunCheck, does_not_tell_more_than_can_be_read) {
  const RunCheck check = check_with([](io::Segment& s) {
    for (StepRow& row : s.steps) at(row, StepField::residual) = std::numeric_limits<double>::infinity();
  });
  EXPECT_EQ(check.faults.size(), max_faults + 1);
  EXPECT_NE(check.faults.back().find("more"), std::string::npos);
}

scenario::Scenario small_bed() { return test::small_tilted_bed(0.2); }

/// Returns the message of the guard that stops the run, and the step.
std::pair<std::string, std::int64_t> stopped_by(const scenario::Scenario& scenario) {
  Session session(scenario);
  const test::Refusal refusal = test::refusal_of([&] { test::run_session(session); });
  EXPECT_EQ(refusal.code, ExitCode::bad_data);
  return {refusal.message, session.world().step};
}

TEST(Guards, sound_runs_break_none) {
  const Session session = test::finished(small_bed());
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
}

TEST(Guards, are_not_passed_by_a_resumed_run_or_a_copy) {
  scenario::Scenario scenario = small_bed();
  scenario.guards.overlap = 1e-9;
  Session session(scenario);
  EXPECT_THROW(while (true) session.advance(), Error);
  Session again(scenario, session.checkpoint(0.0));
  Session copy = session.copy();
  for (Session* stopped : {&session, &again, &copy}) {
    EXPECT_TRUE(
        test::has(test::refusal_of([&] { stopped->advance(); }).message, "guards.overlap allows 1e-09"));
    EXPECT_EQ(stopped->world().step, session.world().step);
  }
}

TEST(Guards, warn_counts_what_they_let_pass) {
  scenario::Scenario scenario = small_bed();
  scenario.guards.action = scenario::GuardAction::warn;
  scenario.guards.velocity = 0.5;
  const Session session = test::finished(scenario);
  const GuardWarnings& warnings = session.schedule().warnings;
  const auto velocity = std::ranges::find(guard_names, "velocity") - guard_names.begin();
  EXPECT_GT(warnings.steps[velocity], 5);
  EXPECT_LT(warnings.steps[velocity], session.world().step);
  scenario::Scenario stop = scenario;
  stop.guards.action = scenario::GuardAction::stop;
  EXPECT_EQ(warnings.first[velocity], stopped_by(stop).second);
  EXPECT_EQ(state_hash(session.world()), state_hash(test::finished(small_bed()).world()))
      << "monitoring changes nothing";

  const io::Checkpoint checkpoint = session.checkpoint(0.0);
  const Session again(scenario, checkpoint);
  EXPECT_EQ(again.schedule().warnings.steps, warnings.steps);
  EXPECT_EQ(again.schedule().warnings.first, warnings.first);
  EXPECT_EQ(find_value(checkpoint.results, "warnings_velocity"),
            static_cast<double>(warnings.steps[velocity]));
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
