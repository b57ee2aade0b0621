/// A separate program, because it counts every operator new of the process.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <initializer_list>
#include <new>

#include "base/thread_team.h"
#include "contact/detection.h"
#include "core/trigonometry.h"
#include "support/scenes.h"

namespace {

std::atomic<long> allocations = 0;
std::atomic<long> until_one_fails = 0;  ///< 1: the next allocation fails; 0: none does

bool fails() { return until_one_fails > 0 && --until_one_fails == 0; }

void* counted(std::size_t size) {
  ++allocations;
  if (fails()) throw std::bad_alloc();
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

void* counted(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  if (fails()) throw std::bad_alloc();
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return counted(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return counted(size, alignment); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace talus {
namespace {

/// Returns whether an action succeeds while its k-th allocation fails, which it does if it makes fewer.
template <typename Do>
bool ends_without(long k, const Do& what) {
  until_one_fails = k;
  bool ended = true;
  try {
    what();
  } catch (const std::bad_alloc&) {
    ended = false;
  }
  until_one_fails = 0;
  return ended;
}

/// Lets each allocation of an action fail in turn until it succeeds, and returns how often it did not. `what`
/// takes the number of the allocation.
template <typename Do>
int count_failures(const Do& what) {
  for (int k = 1; k < 1000; ++k) {
    SCOPED_TRACE(k);
    if (what(k)) return k - 1;
  }
  return 1000;
}

/// Takes steps of a slow tilt, every fifth with a new neighbour list, and returns the number of allocations.
long allocations_of_steps(World& world, const dynamics::StepSettings& settings,
                          dynamics::StepWorkspace& workspace, int steps) {
  const long before = allocations;
  for (int k = 0; k < steps; ++k) {
    if (k % 5 == 0) workspace.neighbours.reach = -1.0;
    world.tilt += radians(1e-3);
    dynamics::step(world, settings, workspace);
  }
  return allocations - before;
}

/// Steps, up to a limit, until each thread has built its part of a neighbour list and so has the memory for
/// it. On a busy machine one thread may do all of the first steps.
void warm_up_threads(World& world, const dynamics::StepSettings& settings,
                     dynamics::StepWorkspace& workspace) {
  const auto threads = static_cast<std::size_t>(settings.solver.threads);
  for (int k = 0; k < 500 && workspace.neighbours.found.size() < threads; ++k) {
    workspace.neighbours.reach = -1.0;
    dynamics::step(world, settings, workspace);
  }
}

class Allocation : public testing::TestWithParam<solver::SolverKind> {};

INSTANTIATE_TEST_SUITE_P(Solvers, Allocation, testing::ValuesIn(test::both_solvers),
                         [](const auto& parameter) { return test::name_of(parameter.param); });

// Large enough that two threads have work, because a solver may leave threads idle on small problems. The
// first steps have more contacts than the others, so that all arrays are large enough.
TEST_P(Allocation, a_steady_step_allocates_nothing) {
  dynamics::StepSettings settings = test::bed_step(1e-3);
  const World settled = test::fallen_bed(test::bed_plan(true, 1600, 100, 5), settings, 400);
  settings.solver.kind = GetParam();
  settings.solver.max_iterations = 50;
  dynamics::StepSettings wider = settings;
  wider.margin *= 3.0;
  for (int threads : {1, 2}) {
    SCOPED_TRACE(threads);
    settings.solver.threads = wider.solver.threads = threads;
    World world = settled;
    dynamics::StepWorkspace workspace;
    EXPECT_GT(allocations_of_steps(world, wider, workspace, 6), 0) << "nothing was counted";
    if (settings.solver.kind == solver::SolverKind::accelerated) warm_up_threads(world, wider, workspace);
    allocations_of_steps(world, settings, workspace, 6);  // with more cells than the wider steps
    ASSERT_GT(world.contacts.count(), 2500);
    const std::int64_t rebuilds = workspace.neighbours.rebuilds;
    // On a busy machine an idle team may resume in one of these rounds and allocate missing memory.
    long fewest = allocations_of_steps(world, settings, workspace, 50);
    for (int round = 1; round < 4 && fewest > 0; ++round)
      fewest = std::min(fewest, allocations_of_steps(world, settings, workspace, 50));
    EXPECT_EQ(fewest, 0);
    EXPECT_GE(workspace.neighbours.rebuilds, rebuilds + 10);
  }
}

// When other processes run, a solve may continue with or without its team, depending on the timing; here the
// two alternate.
TEST(DetectionAllocation, of_a_team_that_comes_and_goes_is_that_of_its_first_turn) {
  const dynamics::StepSettings settings = test::bed_step(1e-3);
  const World world = test::fallen_bed(test::bed_plan(true, 1600, 100, 5), settings, 400);
  ThreadTeam two(2);
  contact::NeighbourList list;
  Contacts contacts;
  const auto detect = [&](ThreadTeam* team) {
    const long before = allocations;
    list.reach = -1.0;
    contact::detect_contacts(list, world.grains, world.boundary, settings.margin, contacts, team);
    return allocations - before;
  };
  EXPECT_GT(detect(&two), 0) << "nothing was counted";
  detect(&two);  // with room for everything listed
  for (ThreadTeam* const team : std::initializer_list<ThreadTeam*>{nullptr, &two, nullptr, &two})
    EXPECT_EQ(detect(team), 0) << (team ? "two threads" : "one");
  EXPECT_EQ(list.rebuilds, 6);
  ASSERT_GT(contacts.count(), 2500);
}

/// Moves every fortieth grain back and forth by more than half the skin of a list.
void shake(World& world, const contact::NeighbourList& list, int round) {
  for (Index i = 0; i < world.grains.free_count; i += 40)
    world.grains.y[i] += (round % 2 == 0 ? 0.6 : -0.6) * list.skin;
}

TEST(DetectionAllocation, of_the_pairs_of_a_few_grains_is_none) {
  const dynamics::StepSettings settings = test::bed_step(1e-3);
  World world = test::fallen_bed(test::bed_plan(true, 1600, 100, 5), settings, 400);
  contact::NeighbourList list;
  Contacts contacts;
  contact::detect_contacts(list, world.grains, world.boundary, settings.margin, contacts);
  contacts.resize(2 * list.pairs.count());  // room for more candidates than exist
  const long before = allocations;
  for (int round = 0; round < 20; ++round) {
    shake(world, list, round);
    contact::detect_contacts(list, world.grains, world.boundary, settings.margin, contacts);
  }
  EXPECT_EQ(allocations - before, 0);
  EXPECT_EQ(list.renewals, 20);
  EXPECT_EQ(list.rebuilds, 1);
}

/// List of a bed in which some grains have moved and three have arrived since; its allocations are those of a
/// renewal.
struct OldList {
  World world;
  contact::NeighbourList list;

  explicit OldList(const World& bed) : world(bed) {
    Contacts contacts;
    Grains& grains = world.grains;
    const double reach = 0.01 * test::radius;
    contact::detect_contacts(list, grains, world.boundary, reach, contacts);
    for (auto* field : {&list.x, &list.y}) field->shrink_to_fit();
    shake(world, list, 0);
    const auto insert = [&grains](auto& to) {
      const auto first = to[0];
      to.insert(to.begin() + grains.free_count, 3, first);
    };
    for (std::vector<double> Grains::*field :
         {&Grains::x, &Grains::y, &Grains::vx, &Grains::vy, &Grains::omega, &Grains::radius,
          &Grains::inverse_mass, &Grains::inverse_inertia, &Grains::mass, &Grains::inertia, &Grains::angle})
      insert(grains.*field);
    insert(grains.image);
    grains.free_count += 3;
  }
};

// Whichever allocation of a renewal fails, the list is correct the next time.
TEST(FailingAllocation, of_a_renewal_leaves_the_list_usable) {
  const dynamics::StepSettings settings = test::bed_step(1e-3);
  const OldList old(test::fallen_bed(test::bed_plan(true, 400, 40, 5), settings, 200));
  const double reach = 0.01 * test::radius;
  Contacts expected;
  contact::NeighbourList fresh;
  contact::detect_contacts(fresh, old.world.grains, old.world.boundary, reach, expected);
  const int failed = count_failures([&](long k) {
    contact::NeighbourList list = old.list;
    const bool ended = ends_without(
        k, [&] { contact::update_neighbour_list(list, old.world.grains, old.world.boundary, reach); });
    Contacts found;
    contact::detect_contacts(list, old.world.grains, old.world.boundary, reach, found);
    EXPECT_EQ(list.rebuilds, 1) << "renewed";
    EXPECT_EQ(found.a, expected.a);
    EXPECT_EQ(found.b, expected.b);
    EXPECT_EQ(found.gap, expected.gap);
    return ended;
  });
  EXPECT_GT(failed, 5);
}

// Whichever allocation of a solve fails, both threads return and the workspace remains usable.
TEST(FailingAllocation, of_two_threads_ends_the_solve_and_leaves_the_workspace_usable) {
  const dynamics::StepSettings settings = test::bed_step(1e-3);
  const World world = test::fallen_bed(test::bed_plan(true, 1600, 100, 5), settings, 400);
  const test::FrozenStep frozen = test::next_problem(world, settings);
  const solver::ContactProblem& problem = frozen.problem;
  ASSERT_GT(problem.contact_count(), 2500);
  solver::SolverSettings solver;
  solver.threads = 2;
  solver.tolerance = 1e-9;
  solver.max_iterations = 20;
  solver::SolverWorkspace fresh;
  solver::ContactSolution expected = frozen.guess;
  solver::solve(problem, solver, fresh, expected);
  const int failed = count_failures([&](long k) {
    solver::SolverWorkspace workspace;
    solver::ContactSolution solution = frozen.guess;
    const bool ended = ends_without(k, [&] { solver::solve(problem, solver, workspace, solution); });
    solver::ContactSolution again = frozen.guess;
    solver::solve(problem, solver, workspace, again);
    EXPECT_EQ(again.pn, expected.pn);
    return ended;
  });
  EXPECT_GT(failed, 30);
}

// Arrays may have the sizes of a problem whose solve then failed: values of the previous problem must not be
// used.
TEST(FailingAllocation, of_a_smaller_problem_leaves_nothing_to_the_one_before) {
  const dynamics::StepSettings settings = test::bed_step(1e-3);
  const World world = test::fallen_bed(test::bed_plan(true, 400, 40, 5), settings, 200);
  const test::FrozenStep frozen = test::next_problem(world, settings);
  const solver::ContactProblem& problem = frozen.problem;
  const solver::ContactSolution& guess = frozen.guess;
  solver::ContactProblem smaller = problem;
  const std::size_t count = problem.a.size() / 2;
  for (auto* field : {&smaller.a, &smaller.b}) field->resize(count);
  for (auto* field : {&smaller.nx, &smaller.ny, &smaller.cn, &smaller.ct, &smaller.mu}) field->resize(count);
  smaller.rolling_friction.assign(count, 0.1);
  solver::ContactSolution guess_of_smaller = guess;
  for (auto* field : {&guess_of_smaller.pn, &guess_of_smaller.pt, &guess_of_smaller.pr}) field->resize(count);
  solver::SolverSettings solver;
  solver.tolerance = 1e-9;
  solver.max_iterations = 20;
  const int failed = count_failures([&](long k) {
    solver::SolverWorkspace workspace;
    solver::ContactSolution expected = guess, of_smaller = guess_of_smaller, again = guess;
    const double eta = solver::solve(problem, solver, workspace, expected).residual.eta;
    const bool ended = ends_without(k, [&] { solver::solve(smaller, solver, workspace, of_smaller); });
    EXPECT_EQ(solver::solve(problem, solver, workspace, again).residual.eta, eta);
    EXPECT_EQ(again.pn, expected.pn);
    return ended;
  });
  EXPECT_GT(failed, 5);
}

}  // namespace
}  // namespace talus
