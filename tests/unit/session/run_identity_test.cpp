/// Friction in force in a frame, and departures of a run from its scenario.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/contacts/contact_network.h"
#include "core/snapshot.h"
#include "core/trigonometry.h"
#include "problems/step_problem.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "session/run_check.h"
#include "session/run_header.h"
#include "support/has.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

/// Records a run to its end, with commands at tilts (deg), and returns it.
io::RunFile recorded(const scenario::Scenario& scenario, const std::string& path,
                     std::vector<std::pair<double, Command>> commands = {}) {
  Session session(scenario);
  while (session.phase() != Phase::done) {
    for (auto& [tilt, command] : commands)
      if (session.phase() == Phase::tilt && degrees(session.world().tilt) > tilt - 1e-9) {
        session.apply(command);
        tilt = 1000.0;
      }
    session.advance();
  }
  return test::stored(session, path);
}

/// Returns the origin of a branch from frame k of a run.
io::BranchOrigin origin_at(const io::RunFile& run, const scenario::Scenario& scenario, std::size_t k) {
  return {"run.h5", static_cast<std::int64_t>(k), "0123456789abcdef", checkpoint_at_frame(run, k),
          history_text(departures(run, scenario, run.instant(k).step))};
}

/// Returns the first frame from a tilt (deg) on.
std::size_t frame_from(const io::RunFile& run, double tilt) {
  std::size_t k = 0;
  while (degrees(run.frame_tilts()[k]) < tilt) ++k;
  return k;
}

/// Returns the largest |f_t| / f_n, and the share of contacts at which it reaches mu, counted by hand.
struct Counted {
  double largest = 0.0, sliding = 0.0;
};
Counted counted(const Frame& frame, double mu) {
  Counted found;
  const FrameContacts& contacts = frame.contacts;
  for (std::size_t c = 0; c < contacts.fn.size(); ++c) {
    const double ratio = std::abs(contacts.ft[c]) / contacts.fn[c];
    found.largest = std::max(found.largest, ratio);
    if (ratio > (1.0 - 1e-5) * mu) found.sliding += 1.0 / static_cast<double>(contacts.fn.size());
  }
  return found;
}

TEST(FrictionInForce, is_that_of_the_step_which_gave_the_forces_of_a_frame) {
  const test::TemporaryFolder folder;
  scenario::Scenario scenario = test::small_tilted_bed(3.0);
  scenario.deposition.friction = 2.0;
  const io::RunFile run =
      recorded(scenario, folder.path("run.h5"), {{1.0, {0, CommandKind::friction, -1, 0.1}}});
  ASSERT_GT(run.frame_count(), 4u);
  std::vector<double> largest;
  for (std::size_t k = 0; k < run.frame_count(); ++k) {
    const Frame frame = run.frame(k);
    const double tilt = degrees(frame.tilt), mu = k == 0 ? 2.0 : tilt < 1.0 + 1e-6 ? 0.5 : 0.1;
    EXPECT_EQ(frame.friction, (Friction{mu, 0.5})) << tilt;
    const Counted by_hand = counted(frame, mu);
    EXPECT_LE(by_hand.largest, mu * (1.0 + 1e-5)) << tilt;
    double mobilised = 0.0;
    Index sliding = 0;
    for (Index c = 0; c < frame.contacts.count(); ++c) {
      mobilised = std::max(mobilised, analysis::mobilisation_of({frame, run.header().statics}, c));
      sliding += frame.contacts.status[c] == ContactStatus::sliding ? 1 : 0;
    }
    EXPECT_NEAR(mobilised, std::min(1.0, by_hand.largest / mu), 1e-5) << tilt;
    EXPECT_NEAR(sliding, by_hand.sliding * frame.contacts.count(), 0.5) << tilt;
    largest.push_back(by_hand.largest);
  }
  EXPECT_GT(largest[0], 0.5) << "forces that only the friction of the deposition allows";
  const std::vector<ObservableRow> rows = run.observables();
  EXPECT_NEAR(at(rows[0], Observable::critical_fraction), counted(run.frame(0), 2.0).sliding, 1e-9);
  EXPECT_TRUE(check_run(run, {}).faults.empty());
  const problems::FrozenBed at_rest = problems::frozen_frame(run, 0);
  EXPECT_EQ(at_rest.law.friction, 2.0) << "other forces of this frame, not of the next step";
  EXPECT_EQ(at_rest.law.wall_friction, 0.5);
}

TEST(FrictionInForce, of_a_branch_is_in_its_scenario) {
  const test::TemporaryFolder folder;
  const io::RunFile run = recorded(test::small_tilted_bed(3.0), folder.path("run.h5"),
                                   {{1.0, {0, CommandKind::friction, -1, 0.2}}});
  io::BranchOrigin origin = origin_at(run, test::small_tilted_bed(3.0), frame_from(run, 1.4));
  Session branch(test::small_tilted_bed(3.0), origin.start);
  EXPECT_EQ(branch.law().friction, 0.2);
  EXPECT_TRUE(branch.adopt_friction());
  EXPECT_FALSE(branch.adopt_friction()) << "only once";
  EXPECT_EQ(branch.scenario().contact.friction, 0.2);
  EXPECT_EQ(branch.scenario().deposition.friction, 0.5) << "the bed was deposited with that of the run";
  EXPECT_EQ(branch.law().friction, 0.2);
  // The user sets another one for the branch: its first frame still has the forces of the step before.
  origin.start = start_of(branch.checkpoint(0.0));
  scenario::Scenario other = branch.scenario();
  other.contact.friction = 0.9;
  const io::RunFile read = test::recorded_branch(other, origin, folder.path("b.h5"));
  EXPECT_EQ(read.header().friction.grains, 0.9);
  EXPECT_EQ(read.frame(0).friction.grains, 0.2);
  EXPECT_EQ(read.frame(1).friction.grains, 0.9);
  EXPECT_GT(counted(read.frame(read.frame_count() - 1), 0.9).largest, 0.2);
}

using Departures = test::FolderTest;

TEST_F(Departures, are_none_of_a_run_that_follows_its_scenario) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  EXPECT_TRUE(departures(recorded(scenario, folder.path("plain.h5")), scenario).empty());
  scenario.commands = {{1.05, {}, CommandKind::drop, 4, 0.05, 0.02},
                       {0.0, {}, CommandKind::push, 7, 0.0, 0.5},
                       {{}, 0.0754, CommandKind::friction, -1, 0.3, 0.0},
                       {1.2, {}, CommandKind::drag, 7, 0.05, 0.06},
                       {1.4, {}, CommandKind::release},
                       {1.05, {}, CommandKind::tilt_rate, -1, 10.0, 0.0},
                       {30.0, {}, CommandKind::friction, -1, 0.1, 0.0}};
  EXPECT_TRUE(departures(recorded(scenario, folder.path("scripted.h5")), scenario).empty());
}

TEST_F(Departures, are_commands_that_the_scenario_does_not_have) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  const Command rubs = {0, CommandKind::friction, -1, 0.1};
  const auto found = departures(recorded(scenario, folder.path("a.h5"), {{0.5, rubs}}), scenario);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].find("friction 0.1 at 0.50 deg"), 0u) << found[0];
  // The same command as in the scenario, but given earlier as well, or instead.
  scenario.commands = {{1.0, {}, CommandKind::friction, -1, 0.1, 0.0}};
  const auto twice = departures(recorded(scenario, folder.path("b.h5"), {{0.5, rubs}}), scenario);
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_TRUE(test::has(twice[0], "at 0.50 deg"));
  scenario.commands[0].at = 30.0;
  EXPECT_EQ(departures(recorded(scenario, folder.path("c.h5"), {{0.5, rubs}}), scenario).size(), 1u);
  EXPECT_EQ(departures_text({"one", "two", "three"}), "one and 2 more");
}

TEST_F(Departures, tell_where_a_drag_leads_and_ends) {
  scenario::Scenario scenario = test::small_tilted_bed(2.0);
  scenario.commands = {{0.5, {}, CommandKind::drag, 5, 0.05, 0.04}};
  const Command moves = {0, CommandKind::drag, 5, 0.05, 0.06}, ends = {0, CommandKind::release};
  EXPECT_TRUE(departures(recorded(scenario, folder.path("a.h5")), scenario).empty());
  EXPECT_EQ(departures(recorded(scenario, folder.path("b.h5"), {{1.0, moves}}), scenario).size(), 1u);
  EXPECT_EQ(departures(recorded(scenario, folder.path("c.h5"), {{1.0, ends}}), scenario).size(), 1u);
}

TEST_F(Departures, of_a_branch_tell_the_history_of_its_run) {
  const scenario::Scenario scenario = test::small_tilted_bed(2.0);
  const auto branch_of = [&](const std::string& name, std::vector<std::pair<double, Command>> commands) {
    const io::RunFile run = recorded(scenario, folder.path(name), std::move(commands));
    const io::BranchOrigin origin = origin_at(run, scenario, frame_from(run, 1.4));
    return departures(test::recorded_branch(scenario, origin, folder.path("branch-" + name)), scenario);
  };
  const Command push = {0, CommandKind::push, 3, 0.1, 0.0};
  const auto plain = branch_of("plain.h5", {}), pushed = branch_of("pushed.h5", {{0.5, push}}),
             later = branch_of("later.h5", {{1.8, push}});
  ASSERT_EQ(plain.size(), 1u);
  EXPECT_EQ(plain, later) << "what was done after the frame is not part of it";
  ASSERT_EQ(pushed.size(), 1u);
  EXPECT_TRUE(test::has(pushed[0], "after push grain 3 by (0.1, 0) m/s at 0.50 deg"));
  const std::vector<std::string> many(50, "push");
  EXPECT_LT(history_text(many).size(), 60u);
  EXPECT_NE(history_text(many), history_text(std::vector<std::string>(51, "push")));
}

TEST(FrictionInForce, of_the_deposition_is_stated_as_a_command_set_it) {
  Session session(test::small_tilted_bed(3.0));
  session.advance();
  session.apply({0, CommandKind::friction, -1, 0.3});
  while (session.phase() == Phase::deposition) session.advance();
  EXPECT_TRUE(session.adopt_friction());
  EXPECT_EQ(session.scenario().deposition.friction, 0.3);
  EXPECT_EQ(session.scenario().contact.friction, 0.3);
}

TEST_F(Departures, tell_a_branch) {
  const scenario::Scenario scenario = test::small_tilted_bed(2.0);
  const io::RunFile run =
      recorded(scenario, folder.path("run.h5"), {{0.9, {0, CommandKind::tilt_rate, -1, 5.0}}});
  const auto found = departures(
      test::recorded_branch(scenario, {"run.h5", 2, "0123456789abcdef", checkpoint_at_frame(run, 2)},
                            folder.path("b.h5")),
      scenario);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(test::has(found[0], "branch at 0.93 deg with a tilt rate of 5 deg/s"));
}

}  // namespace
}  // namespace talus::session
