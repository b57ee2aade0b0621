// Several sweeps executed as a wave, compared with the same sweeps one after another.

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "solver/solve.h"
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

/// Solve in progress, with the sums over the swept contacts.
struct SolveInProgress {
  solver::Linearisation at;
  std::vector<solver::SweepSums> sums;

  explicit SolveInProgress(const solver::Linearisation& from)
      : at(from), sums(static_cast<std::size_t>(solver::sums_of_part * from.order.part_count())) {}
};

class Wave : public testing::Test {
 protected:
  void begin(Index columns, bool rolls) {
    solver::ContactProblem problem = test::columns_problem(3, columns, 60);
    if (rolls) problem.rolling_friction.assign(problem.a.size(), 0.1);
    solver::ContactSolution solution = test::no_guess(problem);
    solver::solve_accelerated(problem, 1e-300, 5, 1, workspace_, solution);
    ASSERT_TRUE(workspace_.linearisation.order.is_ring());
  }
  SolveInProgress swept(int size, bool in_wave, std::size_t sweeps) const {
    SolveInProgress swept(workspace_.linearisation);
    ThreadTeam team(size);
    team.run([&](int member) {
      const solver::Sweeper sweeper{swept.at, swept.sums, &team, member, size, solver::sweep_kernels()};
      (in_wave ? solver::sweep_in_wave : solver::sweep_by_phases)(sweeper, std::span(beta).first(sweeps));
    });
    return swept;
  }
  void expect_same(const SolveInProgress& one, const SolveInProgress& other) const {
    expect_same_bits(one.at.increment, other.at.increment, "impulses");
    expect_same_bits(one.at.last_move, other.at.last_move, "moves");
    expect_same_bits(one.at.velocity, other.at.velocity, "velocities");
    expect_same_bits(one.at.before, other.at.before, "velocities before");
    expect_same_bits(one.at.rolling.increment, other.at.rolling.increment, "rolling impulses");
    expect_same_bits(one.sums, other.sums, "sums");
  }

  solver::AcceleratedWorkspace workspace_;
};

// 20 domains allow one wave of four sweeps, two of two, and five of one.
TEST_F(Wave, has_the_bits_of_sweeps_one_after_another) {
  for (const bool rolls : {false, true}) {
    begin(400, rolls);
    ASSERT_EQ(workspace_.linearisation.order.domain_count(), 20);
    for (const auto& [size, sweeps] : {std::pair(1, 4), std::pair(2, 2), std::pair(1, 3), std::pair(5, 1)}) {
      const auto count = static_cast<std::size_t>(sweeps);
      ASSERT_TRUE(solver::fits_wave(workspace_.linearisation.order, sweeps, size));
      expect_same(swept(size, true, count), swept(1, false, count));
    }
  }
}

TEST_F(Wave, is_for_beds_that_do_not_stay_in_the_caches) {
  begin(400, false);
  EXPECT_EQ(solver::sweeps_in_a_row(workspace_.linearisation.order), 1);
  solver::SweepOrder order = workspace_.linearisation.order;
  order.phase_begin = {0, 32, 64, 65};
  order.part_begin.assign(66, 0);
  EXPECT_EQ(solver::sweeps_in_a_row(order), solver::max_sweeps_in_a_row);
  EXPECT_TRUE(solver::fits_wave(order, solver::max_sweeps_in_a_row, 4));
  EXPECT_FALSE(solver::fits_wave(order, solver::max_sweeps_in_a_row, 5));
  order.by_columns = false;
  EXPECT_EQ(solver::sweeps_in_a_row(order), 1);
  EXPECT_FALSE(solver::fits_wave(order, 1, 1));
}

// Momentum carries over from one sweep to the next, unless a restart is triggered.
TEST_F(Wave, has_the_momentum_of_sweeps_one_after_another) {
  begin(400, false);
  SolveInProgress together(workspace_.linearisation), apart(workspace_.linearisation);
  solver::Momentum one, other;
  one.theta = other.theta = 0.1;
  const solver::SweepKernels kernels = solver::sweep_kernels();
  solver::Sweeper of_together{together.at, together.sums, nullptr, 0, 1, kernels};
  solver::Sweeper of_apart{apart.at, apart.sums, nullptr, 0, 1, kernels};
  const double change = solver::sweep(of_together, 4, one);
  double last = 0.0;
  for (int k = 0; k < 4; ++k) last = solver::sweep(of_apart, 1, other);
  EXPECT_EQ(change, last);
  EXPECT_EQ(one.theta, other.theta);
  EXPECT_EQ(one.beta, other.beta);
  EXPECT_GT(one.beta, 0.0);
  EXPECT_EQ(one.min_change, other.min_change);
  expect_same_bits(together.at.increment, apart.at.increment, "impulses");
}

// Members begin a sweep while others still evaluate the previous one.
TEST_F(Wave, has_the_bits_of_one_member_when_a_team_sweeps_on_and_on) {
  begin(400, false);
  const auto swept_on = [this](int size) {
    SolveInProgress swept(workspace_.linearisation);
    ThreadTeam team(size);
    team.run([&](int member) {
      solver::Sweeper sweeper{swept.at, swept.sums, &team, member, size, solver::sweep_kernels()};
      solver::Momentum momentum;
      for (const int count : {1, 1, 4, 1, 2, 4, 4, 1, 1, 1}) solver::sweep(sweeper, count, momentum);
    });
    return swept;
  };
  const SolveInProgress alone = swept_on(1);
  for (const int size : {2, 3}) expect_same(swept_on(size), alone);
}

TEST_F(Wave, keeps_the_sums_of_the_sweeps_before) {
  begin(400, false);
  SolveInProgress swept(workspace_.linearisation);
  solver::Sweeper sweeper{swept.at, swept.sums, nullptr, 0, 1, solver::sweep_kernels()};
  solver::Momentum momentum;
  const auto half = static_cast<std::ptrdiff_t>(swept.sums.size() / 2);
  const auto changes = [&swept](std::ptrdiff_t first, std::ptrdiff_t last) {
    double sum = 0.0;
    for (auto k = swept.sums.begin() + first; k < swept.sums.begin() + last; ++k) sum += k->change;
    return sum;
  };
  solver::sweep(sweeper, solver::max_sweeps_in_a_row, momentum);
  const double first = changes(0, half);
  EXPECT_GT(first, 0.0);
  EXPECT_EQ(changes(half, 2 * half), 0.0);
  solver::sweep(sweeper, solver::max_sweeps_in_a_row, momentum);
  EXPECT_EQ(changes(0, half), first);
  EXPECT_GT(changes(half, 2 * half), 0.0);
}

/// Performs sweeps as in T16: all bodies are extrapolated, then all contacts are swept, part by part.
SolveInProgress plainly_swept(const solver::Linearisation& from, std::size_t sweeps) {
  SolveInProgress swept(from);
  const solver::SweepOrder& order = swept.at.order;
  const solver::SweepKernels kernels = solver::sweep_kernels();
  for (std::size_t s = 0; s < sweeps; ++s) {
    kernels.bodies(solver::body_arrays(swept.at), 0, order.row_count, beta[s]);
    for (Index part = 0; part < order.part_count(); ++part)
      kernels.contacts(
          solver::contact_arrays(swept.at), order.part_begin[part], order.part_begin[part + 1], beta[s],
          swept.sums[s * static_cast<std::size_t>(order.part_count()) + static_cast<std::size_t>(part)]);
  }
  return swept;
}

/// Returns contacts between the first and the second half of the bodies: most domains have no internal
/// contacts, so that most contacts belong to the last phase.
solver::ContactProblem problem_of_far_contacts() {
  solver::ContactProblem problem;
  const Index bodies = 2000;
  for (Index i = 0; i < bodies; ++i) test::add_body(problem, 1.0 + 0.001 * i, 0.1, 0.01 * (i % 7), -1.0, 0.1);
  for (Index a = 0; a < bodies; ++a)
    for (const Index far : {bodies / 2, bodies / 2 + 1})
      if (a + far < bodies) test::add_contact(problem, a, a + far, 0.6, 0.8, 0.5);
  return problem;
}

// Each part extrapolates the bodies that it changes, once, before their first contact.
TEST(Phases, have_the_bits_of_sweeps_that_extrapolate_all_bodies_first) {
  solver::ContactProblem of_layers = test::columns_problem(3, 30, 40);
  of_layers.columns = 0;
  of_layers.column.clear();
  const solver::ContactProblem problems[] = {test::columns_problem(3, 10, 6), of_layers,
                                             problem_of_far_contacts(), test::columns_problem(3, 400, 60)};
  std::vector<Index> domains, left;
  for (const solver::ContactProblem& problem : problems) {
    solver::SolverWorkspace workspace;
    solver::SolverSettings settings;
    settings.tolerance = 1e-300;
    settings.max_iterations = 5;
    solver::ContactSolution solution = test::no_guess(problem);
    solver::solve(problem, settings, workspace, solution);
    const solver::Linearisation& from = workspace.accelerated.linearisation;
    domains.push_back(from.order.domain_count());
    left.push_back(from.order.part_begin.back() - *(from.order.part_begin.end() - 2));
    const SolveInProgress plain = plainly_swept(from, beta.size());
    for (const int size : {1, 2, 3}) {
      SolveInProgress swept(from);
      ThreadTeam team(size);
      team.run([&](int member) {
        solver::sweep_by_phases({swept.at, swept.sums, &team, member, size, solver::sweep_kernels()}, beta);
      });
      expect_same_bits(swept.at.increment, plain.at.increment, "impulses");
      expect_same_bits(swept.at.velocity, plain.at.velocity, "velocities");
      expect_same_bits(swept.at.before, plain.at.before, "velocities before");
      expect_same_bits(swept.sums, plain.sums, "sums");
    }
  }
  EXPECT_EQ(domains.front(), 1);
  EXPECT_EQ(domains[1], 4);
  EXPECT_GT(left[2], 10) << "groups of the last phase";
  EXPECT_GT(domains.back(), 4);
}

// 66 domains allow waves of four sweeps with up to four members; more members sweep phase by phase.
TEST(Waves, do_not_change_a_bit_of_a_solve) {
  const solver::ContactProblem problem = test::columns_problem(4, 1300, 60);
  const auto solve = [&problem](int threads) {
    solver::AcceleratedWorkspace workspace;
    solver::ContactSolution solution = test::no_guess(problem);
    const solver::AcceleratedOutcome outcome =
        solver::solve_accelerated(problem, 1e-300, 9, threads, workspace, solution);
    EXPECT_EQ(outcome.iterations, 9);
    EXPECT_EQ(solver::sweeps_in_a_row(workspace.linearisation.order), solver::max_sweeps_in_a_row);
    return solution;
  };
  const solver::ContactSolution alone = solve(1);
  for (const int threads : {3, 5}) {
    const solver::ContactSolution in_team = solve(threads);
    expect_same_bits(in_team.pn, alone.pn, "normal impulses");
    expect_same_bits(in_team.pt, alone.pt, "tangential impulses");
    expect_same_bits(in_team.omega, alone.omega, "spins");
  }
}

}  // namespace
}  // namespace talus
