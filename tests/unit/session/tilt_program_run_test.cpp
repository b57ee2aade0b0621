/// Run with a tilt programme: the tilt of every step, recording, resuming, replaying, and its end.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/failure/transition.h"
#include "core/trigonometry.h"
#include "runs/analysis_run.h"
#include "session/estimate.h"
#include "session/run.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

/// Returns a bed tilted by 0.02 deg per step of 1 ms: held, lowered slowly, and tilted to the other side.
scenario::Scenario programmed_bed(std::vector<std::string> program = {"to 1", "hold 0.03", "to 0.2 at 10",
                                                                      "to -0.5", "2 times"}) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.tilt.end_angle.reset();
  scenario.tilt.program = std::move(program);
  return scenario;
}

using TiltProgramRun = test::FolderTest;

TEST_F(TiltProgramRun, has_the_tilt_of_its_programme_in_every_step) {
  const scenario::Scenario scenario = programmed_bed();
  const scenario::TiltProgram program(scenario);
  Session session = test::tilting(scenario);
  EXPECT_EQ(session.world().tilt, 0.0);
  std::vector<double> tilts;
  while (session.phase() == Phase::tilt) {
    session.advance();
    tilts.push_back(session.world().tilt);
  }
  ASSERT_EQ(static_cast<std::int64_t>(tilts.size()), program.steps());
  for (std::size_t k = 0; k < tilts.size(); ++k)
    ASSERT_EQ(tilts[k], program.tilt(static_cast<std::int64_t>(k) + 1)) << k;
  EXPECT_EQ(tilts[49], radians(1.0));
  EXPECT_EQ(tilts[79], radians(1.0)) << "held for 30 steps";
  EXPECT_EQ(tilts[80], radians(1.0) - radians(10.0 * scenario::time_step(scenario))) << "10 deg/s";
  EXPECT_EQ(tilts[159], radians(0.2));
  EXPECT_EQ(tilts.back(), radians(-0.5));
  EXPECT_EQ(session.angle_of_repose(), std::nullopt);
}

TEST_F(TiltProgramRun, to_repose_alone_is_the_run_without_a_programme) {
  scenario::Scenario plain = programmed_bed({});
  plain.tilt.end_angle.reset();
  Session without(plain), with(programmed_bed({"to repose"})),
      parts(programmed_bed({"to 3 at 20", "to repose"}));
  for (Session* session : {&without, &with, &parts})
    for (int k = 0; k < 400; ++k) session->advance();
  EXPECT_EQ(without.phase(), Phase::tilt);
  EXPECT_EQ(state_hash(with.world()), state_hash(without.world()));
  EXPECT_EQ(with.segment().observables, without.segment().observables);
  EXPECT_NEAR(parts.world().tilt, without.world().tilt, 1e-12);
}

TEST_F(TiltProgramRun, is_recorded_at_equal_times_and_where_it_turns) {
  const scenario::Scenario scenario = programmed_bed();
  const io::RunFile run = test::recorded(scenario, folder.path("run.h5"));
  EXPECT_TRUE(run.has_program());
  EXPECT_EQ(run.frame_count(), run.all_frame_tilts().size());
  std::vector<std::int64_t> steps;
  const std::int64_t begin = run.positions(0).step;
  for (std::size_t k = 0; k < run.frame_count(); ++k) steps.push_back(run.positions(k).step - begin);
  // Every 25 steps, which is 0.5 deg, and at the ends of the parts of 50, 30, 80, 35, 75, 30, 80 and 35
  // steps.
  std::vector<std::int64_t> expected;
  for (std::int64_t k = 0; k <= 415; k += 25) expected.push_back(k);
  for (const std::int64_t end : {50, 80, 160, 195, 270, 300, 380, 415}) expected.push_back(end);
  std::ranges::sort(expected);
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(steps, expected);
  const std::vector<ObservableRow> rows = run.observables();
  EXPECT_EQ(rows.size(), run.all_observables().size());
  EXPECT_EQ(at(rows.back(), Observable::tilt), radians(-0.5));
  const Estimate expected_of_it = estimate(scenario);
  EXPECT_EQ(expected_of_it.tilt_steps, 415);
  EXPECT_EQ(expected_of_it.program_parts, 8);
  EXPECT_GE(expected_of_it.frames, static_cast<std::int64_t>(steps.size()));
}

TEST_F(TiltProgramRun, resumed_from_any_step_gives_the_same_bits) {
  const scenario::Scenario scenario = programmed_bed();
  const Session whole = test::finished(scenario);
  // The tilt begins at 0. Its steps are 60 (held), 100 (slowly down), 180 (soon below 0), 193, 194 and 195 (a
  // turn).
  const std::int64_t begin = test::tilting(scenario).world().step;
  for (const std::int64_t stop : {0, 1, 49, 50, 51, 60, 79, 80, 100, 180, 193, 194, 195, 400}) {
    Session first(scenario);
    while (first.world().step < begin + stop) first.advance();
    Session second(scenario, first.checkpoint(0.0));
    EXPECT_EQ(second.tilt_rate(), first.tilt_rate()) << stop;
    test::run_session(second);
    EXPECT_EQ(state_hash(second.world()), state_hash(whole.world())) << stop;
    EXPECT_EQ(test::stored_values(second), test::stored_values(whole)) << stop;
  }
}

TEST_F(TiltProgramRun, is_left_by_a_command_for_the_rate_of_the_tilt) {
  const scenario::Scenario scenario = programmed_bed();
  Session session = test::tilting(scenario);
  EXPECT_NEAR(degrees(session.tilt_rate()), 20.0, 1e-9);
  for (int k = 0; k < 60; ++k) session.advance();
  EXPECT_EQ(session.tilt_rate(), 0.0) << "held";
  EXPECT_TRUE(session.follows_program());
  session.apply({0, CommandKind::push, 3, 0.05, 0.0});
  session.apply({0, CommandKind::friction, -1, 0.4, 0.0});
  EXPECT_TRUE(session.follows_program()) << "these do not change the tilt";
  for (int k = 0; k < 30; ++k) session.advance();
  EXPECT_NEAR(degrees(session.tilt_rate()), -10.0, 1e-9);
  const double before = session.world().tilt;
  session.apply({0, CommandKind::tilt_rate, -1, 5.0, 0.0});
  EXPECT_FALSE(session.follows_program());
  for (int k = 0; k < 400; ++k) session.advance();
  EXPECT_NEAR(degrees(session.world().tilt - before), 400 * 5.0 * scenario::time_step(scenario), 1e-9);
  EXPECT_EQ(session.phase(), Phase::tilt) << "until the slope fails, not only to the end of the programme";

  Session again(scenario);
  replay(again, nullptr, session.segment().commands, session.world().step, {});
  EXPECT_EQ(state_hash(again.world()), state_hash(session.world()));
  Session resumed(scenario, session.checkpoint(0.0));
  resumed.advance();
  session.advance();
  EXPECT_EQ(state_hash(resumed.world()), state_hash(session.world()));
}

/// Returns a bed without friction, which flows as soon as it is tilted.
scenario::Scenario slippery_bed(std::vector<std::string> program) {
  scenario::Scenario scenario = programmed_bed(std::move(program));
  scenario.contact.friction = 0.0;
  scenario.bed.floor = scenario::BedFloor::smooth;
  return scenario;
}

TEST_F(TiltProgramRun, ends_with_failure_on_either_side) {
  for (const double side : {1.0, -1.0}) {
    const io::RunFile run = test::recorded(slippery_bed({side > 0.0 ? "to 30" : "to -30", "hold 100"}),
                                           folder.path(side > 0.0 ? "a.h5" : "b.h5"));
    const double end = run.checkpoint().world.tilt;
    const auto theta_c = find_value(run.checkpoint().results, "theta_c");
    ASSERT_TRUE(theta_c.has_value());
    EXPECT_GT(*theta_c, 0.0) << "a magnitude";
    EXPECT_LT(*theta_c, side * end);
    EXPECT_LT(side * end, radians(30.0) + 1e-12);
    EXPECT_LT(run.checkpoint().world.time, 60.0) << "not after the hold";
  }
}

TEST_F(TiltProgramRun, is_followed_by_the_flow_that_is_asked_for) {
  for (const double side : {1.0, -1.0}) {
    scenario::Scenario scenario = slippery_bed({"to 1", side > 0.0 ? "to 30" : "to -30"});
    scenario.tilt.after_failure = scenario::AfterFailure::lower;
    scenario.tilt.lowering_rate = 100.0;
    const io::RunFile run = test::recorded(scenario, folder.path(side > 0.0 ? "a.h5" : "b.h5"));
    ASSERT_GT(run.all_frame_tilts().size(), run.frame_count()) << "frames of the flow";
    ASSERT_GT(run.all_observables().size(), run.observables().size());
    EXPECT_EQ(side * std::ranges::max(run.all_frame_tilts(), {}, [side](double tilt) { return side * tilt; }),
              side * run.frame_tilts().back());
    EXPECT_EQ(run.all_frame_tilts().back(), 0.0) << "lowered to the level";
    EXPECT_FALSE(std::signbit(run.all_frame_tilts().back()));
    EXPECT_EQ(at(run.observables().back(), Observable::step),
              static_cast<double>(run.positions(run.frame_count() - 1).step));
  }
}

TEST_F(TiltProgramRun, has_an_analysis_of_all_frames_whose_thresholds_are_of_the_last_rise) {
  scenario::Scenario scenario = programmed_bed({"to 3", "to 1", "to 2", "to 0"});
  scenario.output.frame_every = 0.2;
  const io::RunFile run = test::recorded(scenario, folder.path("run.h5"));
  analysis::AnalysisParameters parameters;
  parameters.gamma_c = 0.3;
  const analysis::Analysis analysis = runs::analyse_run(run, parameters, 1, {});
  ASSERT_EQ(analysis.frames.size(), run.frame_count());
  const std::vector<ObservableRow> rows = run.observables();
  for (std::size_t k = 0; k < analysis.frames.size(); ++k) {
    EXPECT_EQ(analysis.frames[k].tilt, run.frame_tilts()[k]);
    const auto row = std::ranges::find(rows, run.all_frame_times()[k], [](const ObservableRow& entry) {
      return at(entry, Observable::time);
    });
    ASSERT_NE(row, rows.end());
    EXPECT_EQ(analysis.frames[k].volume_strain, at(*row, Observable::volume_strain)) << k;
  }
  const analysis::FramesOfRise rise = analysis::last_rise(analysis.frames);
  EXPECT_NEAR(degrees(rise.tilts.front()), 1.0, 1e-9);
  EXPECT_NEAR(degrees(rise.tilts.back()), 2.0, 1e-9);
  for (const double found : {analysis.thresholds.front().lc_jump, analysis.dilation[0], analysis.first_slide})
    EXPECT_TRUE(std::isnan(found) || (found >= radians(1.0) - 1e-9 && found <= radians(2.0) + 1e-9)) << found;
}

}  // namespace
}  // namespace talus::session
