/// Choice between team and single thread, for windows of work with made-up costs.

#include <gtest/gtest.h>

#include "solver/solve.h"
#include "unit/solver/small_problems.h"

namespace talus::solver {
namespace {

constexpr double window = 0.05;  // s, sufficient length of a window

struct Share {
  int team = 0, alone = 0;
};

/// Returns how many windows run each way if a unit of work has these costs, s.
Share work(TeamChoice& choice, int windows, double in_team, double alone) {
  Share share;
  for (int k = 0; k < windows; ++k) {
    ++(choice.in_team() ? share.team : share.alone);
    choice.add(window, window / (choice.in_team() ? in_team : alone));
  }
  return share;
}

TEST(TeamChoice, tries_alone_once_where_the_team_is_faster) {
  TeamChoice choice;
  EXPECT_TRUE(choice.in_team());
  EXPECT_EQ(work(choice, 1000, 1.0, 1.8).alone, 1);
  EXPECT_TRUE(choice.in_team());
}

TEST(TeamChoice, goes_alone_where_members_wait) {
  TeamChoice choice;
  EXPECT_LE(work(choice, 1000, 50.0, 2.0).team, 20);
  EXPECT_FALSE(choice.in_team());
}

TEST(TeamChoice, follows_what_changes) {
  TeamChoice choice;
  work(choice, 100, 1.0, 1.8);
  EXPECT_LE(work(choice, 300, 20.0, 2.5).team, 10) << "the machine becomes busy";
  EXPECT_LE(work(choice, 600, 1.0, 1.8).alone, 257) << "and quiet again";
  EXPECT_TRUE(choice.in_team());
}

/// One window of a single thread is slow by chance, which does not favour the team on trial.
TEST(TeamChoice, one_slow_window_changes_nothing) {
  TeamChoice choice;
  work(choice, 1000, 4.0, 2.0);
  for (int k = 0; k < 300; ++k) {
    const bool in_team = choice.in_team();
    choice.add(window, window / (in_team ? 4.0 : k % 7 == 0 ? 6.0 : 2.0));
    if (in_team) {
      EXPECT_FALSE(choice.in_team()) << "kept the team at " << k;
    }
  }
}

/// Other processes happen to leave a team undisturbed for one window: it stays on trial, and does not pay
/// off.
TEST(TeamChoice, one_lucky_window_of_a_trial_changes_nothing) {
  constexpr double shortest = 0.02;  // s, duration of a window
  TeamChoice choice;
  work(choice, 1000, 20.0, 2.0);
  int trials = 0, windows = 0, of_trial = 0;
  for (int k = 0; k < 2000; ++k) {
    const bool in_team = choice.in_team();
    of_trial = in_team ? of_trial + 1 : 0;
    trials += of_trial == 1 ? 1 : 0;
    windows += in_team ? 1 : 0;
    choice.add(shortest, shortest / (!in_team ? 2.0 : of_trial == 1 ? 1.0 : 20.0));
  }
  EXPECT_GT(trials, 5);
  EXPECT_EQ(windows, 3 * trials) << "the lucky window, and two until it is compensated";
}

/// The team is slower than one thread on a quiet machine, and still the faster choice.
TEST(TeamChoice, seldom_tries_what_did_not_pay) {
  TeamChoice choice;
  work(choice, 100, 1.0, 1.8);
  EXPECT_LE(work(choice, 1000, 3.0, 4.0).alone, 20);
  EXPECT_TRUE(choice.in_team());
}

/// The cost of a single thread in its last trial may be outdated.
TEST(TeamChoice, tries_again_what_was_once_faster) {
  TeamChoice choice;
  work(choice, 100, 1.0, 1.8);
  work(choice, 100, 3.0, 4.0);
  EXPECT_TRUE(choice.in_team());
  EXPECT_LE(work(choice, 300, 3.0, 2.0).team, 75);
}

TEST(TeamChoice, waits_for_a_window_of_work) {
  TeamChoice choice;
  for (int k = 0; k < 19; ++k) choice.add(1e-3, 1.0);
  EXPECT_TRUE(choice.in_team());
  choice.add(1e-3, 1.0);
  choice.add(1e-3, 1.0);
  EXPECT_FALSE(choice.in_team()) << "on trial";
}

TEST(TeamChoice, judges_by_nothing_less_than_time_and_work) {
  TeamChoice without_time, without_work;
  for (int k = 0; k < 100; ++k) {
    without_time.add(0.0, 1.0);
    without_work.add(1.0, 0.0);
    EXPECT_TRUE(without_time.in_team());
    EXPECT_TRUE(without_work.in_team());
  }
}

/// While a bed is poured, the problem size alternates around the threshold for a team.
TEST(TeamOfSolve, and_what_was_learnt_of_it_stay_over_a_problem_that_needs_none) {
  AcceleratedWorkspace workspace;
  const auto solve_with = [&](const ContactProblem& problem, int threads) {
    ContactSolution solution = test::no_guess(problem);
    solve_accelerated(problem, 1e-3, 1, threads, workspace, solution);
  };
  const ContactProblem large = test::random_problem(1, 1500, 2000), small = test::random_problem(2, 50, 60);
  solve_with(small, 2);
  EXPECT_EQ(workspace.team, nullptr);
  solve_with(large, 2);
  const ThreadTeam* const team = workspace.team.get();
  ASSERT_NE(team, nullptr);
  work(workspace.choice, 100, 50.0, 2.0);
  ASSERT_FALSE(workspace.choice.in_team());
  solve_with(small, 2);
  solve_with(large, 1);
  solve_with(large, 2);
  EXPECT_EQ(workspace.team.get(), team);
  EXPECT_FALSE(workspace.choice.in_team());
}

}  // namespace
}  // namespace talus::solver
