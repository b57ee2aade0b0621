// Several sweeps as a wave, against the same sweeps one after another.

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "solver/accelerated.h"
#include "solver/sweep.h"
#include "unit/solver/small_problems.h"

namespace talus {
namespace {

constexpr std::array<float, 4> beta = {0.9F, 0.2F, 0.5F, 0.7F};

template <typename Value>
void expect_same_bits(const std::vector<Value>& one, const std::vector<Value>& other, const char* what) {
  ASSERT_EQ(one.size(), other.size());
  EXPECT_TRUE(one.empty() || std::memcmp(one.data(), other.data(), one.size() * sizeof(Value)) == 0) << what;
}

/// A solve on its way, and the sums of what is swept.
struct Swept {
  Linearisation at;
  std::vector<SweepSums> sums;

  explicit Swept(const Linearisation& from)
      : at(from), sums(static_cast<std::size_t>(sums_of_part * from.order.part_count())) {}
};

class Wave : public testing::Test {
 protected:
  void begin(Index columns, bool rolls) {
    ContactProblem problem = test::columns_problem(3, columns, 60);
    if (rolls) problem.rolling_friction.assign(problem.a.size(), 0.1);
    ContactSolution solution = test::no_guess(problem);
    solve_accelerated(problem, 1e-300, 5, 1, workspace_, solution);
    ASSERT_TRUE(workspace_.linearisation.order.is_ring());
  }
  Swept swept(int size, bool in_wave, std::size_t sweeps) const {
    Swept swept(workspace_.linearisation);
    ThreadTeam team(size);
    team.run([&](int member) {
      const Sweeper sweeper{swept.at, swept.sums, &team, member, size, sweep_kernels()};
      (in_wave ? sweep_in_wave : sweep_by_phases)(sweeper, std::span(beta).first(sweeps));
    });
    return swept;
  }
  void expect_the_same(const Swept& one, const Swept& other) const {
    expect_same_bits(one.at.increment, other.at.increment, "impulses");
    expect_same_bits(one.at.last_move, other.at.last_move, "moves");
    expect_same_bits(one.at.velocity, other.at.velocity, "velocities");
    expect_same_bits(one.at.before, other.at.before, "velocities before");
    expect_same_bits(one.at.rolling.increment, other.at.rolling.increment, "rolling impulses");
    expect_same_bits(one.sums, other.sums, "sums");
  }

  AcceleratedWorkspace workspace_;
};

// With 20 domains there is room for one wave of four sweeps, two of two, and five of one.
TEST_F(Wave, has_the_bits_of_sweeps_one_after_another) {
  for (const bool rolls : {false, true}) {
    begin(400, rolls);
    ASSERT_EQ(workspace_.linearisation.order.domain_count(), 20);
    for (const auto& [size, sweeps] : {std::pair(1, 4), std::pair(2, 2), std::pair(1, 3), std::pair(5, 1)}) {
      const auto count = static_cast<std::size_t>(sweeps);
      ASSERT_TRUE(fits_wave(workspace_.linearisation.order, sweeps, size));
      expect_the_same(swept(size, true, count), swept(1, false, count));
    }
  }
}

TEST_F(Wave, is_for_beds_that_do_not_stay_in_the_caches) {
  begin(400, false);
  EXPECT_EQ(sweeps_in_a_row(workspace_.linearisation.order), 1);
  SweepOrder order = workspace_.linearisation.order;
  order.phase_begin = {0, 32, 64, 65};
  order.part_begin.assign(66, 0);
  EXPECT_EQ(sweeps_in_a_row(order), most_sweeps_in_a_row);
  EXPECT_TRUE(fits_wave(order, most_sweeps_in_a_row, 4));
  EXPECT_FALSE(fits_wave(order, most_sweeps_in_a_row, 5));
  order.by_columns = false;
  EXPECT_EQ(sweeps_in_a_row(order), 1);
  EXPECT_FALSE(fits_wave(order, 1, 1));
}

// The momentum of a sweep is that which the ones before it leave, where none of them makes it begin anew.
TEST_F(Wave, has_the_momentum_of_sweeps_one_after_another) {
  begin(400, false);
  Swept together(workspace_.linearisation), apart(workspace_.linearisation);
  Momentum one, other;
  one.theta = other.theta = 0.1;
  const SweepKernels kernels = sweep_kernels();
  Sweeper of_together{together.at, together.sums, nullptr, 0, 1, kernels};
  Sweeper of_apart{apart.at, apart.sums, nullptr, 0, 1, kernels};
  const double change = sweep(of_together, 4, one);
  double last = 0.0;
  for (int k = 0; k < 4; ++k) last = sweep(of_apart, 1, other);
  EXPECT_EQ(change, last);
  EXPECT_EQ(one.theta, other.theta);
  EXPECT_EQ(one.beta, other.beta);
  EXPECT_GT(one.beta, 0.0);
  EXPECT_EQ(one.least_change, other.least_change);
  expect_same_bits(together.at.increment, apart.at.increment, "impulses");
}

// 66 domains: room for waves of four sweeps by up to four members; more of them sweep phase by phase.
TEST(Waves, do_not_change_a_bit_of_a_solve) {
  const ContactProblem problem = test::columns_problem(4, 1300, 60);
  const auto solve = [&problem](int threads) {
    AcceleratedWorkspace workspace;
    ContactSolution solution = test::no_guess(problem);
    const AcceleratedOutcome outcome = solve_accelerated(problem, 1e-300, 9, threads, workspace, solution);
    EXPECT_EQ(outcome.iterations, 9);
    EXPECT_EQ(sweeps_in_a_row(workspace.linearisation.order), most_sweeps_in_a_row);
    return solution;
  };
  const ContactSolution alone = solve(1);
  for (const int threads : {3, 5}) {
    const ContactSolution in_team = solve(threads);
    expect_same_bits(in_team.pn, alone.pn, "normal impulses");
    expect_same_bits(in_team.pt, alone.pt, "tangential impulses");
    expect_same_bits(in_team.omega, alone.omega, "spins");
  }
}

}  // namespace
}  // namespace talus
