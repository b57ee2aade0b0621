/// Forces of frozen beds: unique and non-unique ones, all of which satisfy balance and contact law.

#include "problems/admissible_forces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "runs/analysis_parameters.h"
#include "session/measure.h"
#include "support/scenes.h"

namespace talus::problems {
namespace {

constexpr double tolerance = 1e-9;
constexpr double mean_diameter = 2.0 * test::radius;

ForceSearch search_for(int solutions) { return {.solutions = solutions, .tolerance = tolerance}; }

RunStatics statics_of(const World& world, double length) {
  RunStatics statics;
  statics.free_count = world.grains.free_count;
  statics.radius = world.grains.radius;
  statics.mass = world.grains.mass;
  statics.periodic = world.boundary.periodic;
  statics.length = statics.depth = length;
  statics.mean_diameter = mean_diameter;
  statics.gravity = world.gravity;
  return statics;
}

/// Returns about 30 grains at rest on a rough floor.
const FrozenBed& small_bed() {
  static const FrozenBed bed = [] {
    const dynamics::StepSettings settings = test::bed_step(tolerance);
    return freeze(test::settled_bed(test::bed_plan(true, 30, 6, 3), settings), settings,
                  dynamics::BedPlan{}.mean_diameter);
  }();
  return bed;
}

/// Returns a grain on two glued ones, each at 30 deg to the vertical; the remembered forces are those without
/// friction.
FrozenBed grain_on_two(double friction) {
  World world;
  world.boundary.length = 20.0 * test::radius;
  const double x = 10.0 * test::radius, r = test::radius;
  add_disk(world.grains, {x, std::sqrt(3.0) * r}, r, test::density, false);
  add_disk(world.grains, {x - r, 0.0}, r, test::density, true);
  add_disk(world.grains, {x + r, 0.0}, r, test::density, true);
  const dynamics::StepSettings settings = test::exact_step(solver::SolverKind::accelerated, friction);
  FrozenBed bed = freeze(std::move(world), settings, mean_diameter);
  const double weight = bed.world.grains.mass[0] * bed.world.gravity;
  bed.step.guess.pn.assign(2, weight * settings.h / std::sqrt(3.0));
  bed.step.guess.pt.assign(2, 0.0);
  return bed;
}

/// Returns the largest residual force, or torque over radius, on a free grain, relative to its weight; summed
/// over the contacts without code of the solver.
double imbalance(const World& world) {
  const Grains& grains = world.grains;
  std::vector<double> x(grains.radius.size() + 8, 0.0), y = x, torque = x;
  const Contacts& c = world.contacts;
  for (std::size_t k = 0; k < c.fn.size(); ++k) {
    const double fx = c.fn[k] * c.nx[k] - c.ft[k] * c.ny[k], fy = c.fn[k] * c.ny[k] + c.ft[k] * c.nx[k];
    const auto a = static_cast<std::size_t>(c.a[k]), b = static_cast<std::size_t>(c.b[k]);
    x[a] -= fx;
    y[a] -= fy;
    x[b] += fx;
    y[b] += fy;
    torque[a] -= c.ft[k];  // divided by the radius
    torque[b] -= c.ft[k];
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(grains.free_count); ++i) {
    const double weight = grains.mass[i] * world.gravity;
    const double down = y[i] - weight * std::cos(world.tilt), along = x[i] + weight * std::sin(world.tilt);
    worst =
        std::max({worst, std::fabs(along) / weight, std::fabs(down) / weight, std::fabs(torque[i]) / weight});
  }
  return worst;
}

void expect_feasible(const Contacts& contacts, double friction) {
  for (std::size_t c = 0; c < contacts.fn.size(); ++c) {
    EXPECT_GE(contacts.fn[c], 0.0);
    EXPECT_LE(std::fabs(contacts.ft[c]), friction * contacts.fn[c] * (1.0 + 1e-6)) << c;
  }
}

TEST(AdmissibleForces, stored_forces_are_found_again) {
  Random random(1);
  const ForceSet set =
      find_forces(small_bed(), {ForceStart::stored, ForceMethod::contact_dynamics}, search_for(1), random);
  EXPECT_TRUE(set.report.converged);
  EXPECT_LT(set.distance, 1e-4);
  EXPECT_LT(set.momentum_left, 1e-3);
  EXPECT_EQ(set.unbalanced, 0);
}

TEST(AdmissibleForces, every_solution_carries_the_bed) {
  const FrozenBed& bed = small_bed();
  const ForceSearch search = search_for(12);
  Random random(search.seed);
  double farthest = 0.0;
  for (const ForceAttempt& attempt : force_attempts(search)) {
    const ForceSet set = find_forces(bed, attempt, search, random);
    EXPECT_TRUE(set.admissible()) << name_of(attempt);
    const World world = loaded_world(bed, set.solution);
    EXPECT_LT(imbalance(world), 1e-4) << name_of(attempt);
    expect_feasible(world.contacts, 0.5);
    farthest = std::max(farthest, set.distance);
  }
  EXPECT_GT(farthest, 0.05) << "a frictional bed has more than one set of forces";
}

TEST(AdmissibleForces, without_friction_there_is_one) {
  const FrozenBed bed = grain_on_two(0.0);
  ASSERT_EQ(bed.step.problem.contact_count(), 2);
  const ForceSearch search = search_for(10);
  Random random(search.seed);
  for (const ForceAttempt& attempt : force_attempts(search)) {
    const ForceSet set = find_forces(bed, attempt, search, random);
    EXPECT_TRUE(set.report.converged);
    EXPECT_LT(set.distance, 1e-7) << name_of(attempt);
  }
}

// By symmetry and balance f_n cos 30 + f_t sin 30 = m g / 2 with equal f_n and |f_t| on both sides: one
// number is free, within |f_t| <= mu f_n.
TEST(AdmissibleForces, with_friction_a_grain_on_two_has_a_line_of_them) {
  const FrozenBed bed = grain_on_two(0.5);
  const double half_weight = 0.5 * bed.world.grains.mass[0] * bed.world.gravity;
  const ForceSearch search = search_for(20);
  Random random(search.seed);
  double least = 1e9, largest = 0.0;
  for (const ForceAttempt& attempt : force_attempts(search)) {
    const Contacts forces = loaded_world(bed, find_forces(bed, attempt, search, random).solution).contacts;
    const double fn = forces.fn[0] / half_weight, ft = std::fabs(forces.ft[0]) / half_weight;
    EXPECT_NEAR(forces.fn[1] / half_weight, fn, 1e-6) << name_of(attempt);
    EXPECT_NEAR(std::fabs(fn * 0.5 * std::sqrt(3.0) - 1.0), 0.5 * ft, 1e-6) << name_of(attempt);
    EXPECT_LE(ft, 0.5 * fn * (1.0 + 1e-6));
    least = std::min(least, fn);
    largest = std::max(largest, fn);
  }
  EXPECT_GE(least, 1.0 / (0.5 * std::sqrt(3.0) + 0.25) - 1e-6);
  EXPECT_LE(largest, 1.0 / (0.5 * std::sqrt(3.0) - 0.25) + 1e-6);
  EXPECT_GT(largest - least, 0.1);
}

TEST(AdmissibleForces, random_starts_are_feasible_and_follow_from_the_seed) {
  const FrozenBed& bed = small_bed();
  double stored = 0.0, carrying = 0.0;
  for (const double pn : bed.step.guess.pn) {
    stored += pn;
    carrying += pn > 0.0 ? 1.0 : 0.0;
  }
  for (const ForceStart start : {ForceStart::exponential, ForceStart::uniform}) {
    Random one(7), same(7), other(8), many(9);
    const solver::ContactSolution guess = first_guess(start, bed, one);
    EXPECT_EQ(guess.pn, first_guess(start, bed, same).pn);
    EXPECT_NE(guess.pn, first_guess(start, bed, other).pn);
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (int draw = 0; draw < 200; ++draw) {
      const solver::ContactSolution drawn = first_guess(start, bed, many);
      for (std::size_t c = 0; c < drawn.pn.size(); ++c) {
        EXPECT_GE(drawn.pn[c], 0.0);
        EXPECT_LE(std::fabs(drawn.pt[c]), bed.step.problem.mu[c] * drawn.pn[c]);
        if (bed.step.problem.cn[c] > 0.0) {
          EXPECT_EQ(drawn.pn[c], 0.0) << "an open contact";
          continue;
        }
        const double over_mean = drawn.pn[c] * carrying / stored;
        sum += over_mean;
        squares += over_mean * over_mean;
        count += 1.0;
      }
    }
    EXPECT_NEAR(sum / count, 1.0, 0.1) << "the mean of the stored forces";
    EXPECT_NEAR(squares / count, start == ForceStart::exponential ? 8.0 / 3.0 : 16.0 / 9.0, 0.4);
  }
}

TEST(AdmissibleForces, starts_from_the_memory_are_shares_of_it) {
  const FrozenBed& bed = small_bed();
  Random random(3);
  const solver::ContactSolution doubled = first_guess(ForceStart::doubled, bed, random);
  const solver::ContactSolution scattered = first_guess(ForceStart::scattered, bed, random);
  double least = 2.0, largest = 0.0;
  for (std::size_t c = 0; c < doubled.pn.size(); ++c) {
    const double pn = bed.step.guess.pn[c], pt = bed.step.guess.pt[c];
    EXPECT_EQ(doubled.pn[c], 2.0 * pn);
    EXPECT_EQ(doubled.pt[c], 2.0 * pt);
    if (pn == 0.0) continue;
    const double factor = scattered.pn[c] / pn;
    EXPECT_NEAR(scattered.pt[c], factor * pt, 1e-12 * pn);
    least = std::min(least, factor);
    largest = std::max(largest, factor);
  }
  EXPECT_GE(least, 0.0);
  EXPECT_LE(largest, 2.0);
  EXPECT_GT(largest - least, 1.5);
}

// An unsupported grain falls by g h in the step.
TEST(AdmissibleForces, a_grain_that_is_let_go_is_told) {
  World world = test::column(2);
  world.grains.y[1] += 0.5 * test::radius;
  const dynamics::StepSettings settings = test::exact_step(solver::SolverKind::accelerated);
  FrozenBed bed = freeze(std::move(world), settings, mean_diameter);
  bed.step.guess.pn.assign(1, 1.0);
  Random random(1);
  const ForceSet set =
      find_forces(bed, {ForceStart::zero, ForceMethod::contact_dynamics}, search_for(1), random);
  EXPECT_EQ(set.unbalanced, 1);
  EXPECT_NEAR(set.momentum_left, std::sqrt(0.5), 1e-6) << "one of two falls";
  EXPECT_TRUE(set.report.converged);
  EXPECT_FALSE(set.admissible());
}

TEST(AdmissibleForces, open_contacts_carry_nothing) {
  World world = test::column(2);
  world.grains.y[1] += 0.001 * test::radius;  // an open candidate contact
  FrozenBed bed = freeze(std::move(world), test::exact_step(solver::SolverKind::accelerated), mean_diameter);
  ASSERT_EQ(bed.step.problem.contact_count(), 2);
  bed.step.guess.pn.assign(2, 1e-3);
  Random random(1);
  for (const ForceStart start : {ForceStart::doubled, ForceStart::uniform}) {
    const ForceSet set = find_forces(bed, {start}, search_for(1), random);
    for (std::size_t c = 0; c < 2; ++c)
      EXPECT_EQ(set.solution.pn[c] > 0.0, bed.step.problem.cn[c] <= 0.0) << "contact " << c;
    EXPECT_EQ(set.unbalanced, 1);
    EXPECT_FALSE(set.admissible());
  }
}

TEST(AdmissibleForces, a_frozen_bed_stands_still) {
  World world = test::disk_on_plane(0.2);
  world.grains.vx[0] = world.grains.vy[0] = world.grains.omega[0] = 1.0;
  const dynamics::StepSettings settings = test::exact_step(solver::SolverKind::accelerated);
  const FrozenBed bed = freeze(world, settings, mean_diameter);
  EXPECT_EQ(bed.world.grains.x, world.grains.x);
  EXPECT_EQ(bed.world.grains.vx[0], 0.0);
  EXPECT_DOUBLE_EQ(bed.step.problem.vx[0], world.gravity * std::sin(0.2) * settings.h);
  EXPECT_DOUBLE_EQ(bed.step.problem.vy[0], -world.gravity * std::cos(0.2) * settings.h);
  EXPECT_EQ(bed.step.problem.omega[0], 0.0);
}

TEST(AdmissibleForces, attempts_begin_with_the_stored_forces) {
  const std::vector<ForceAttempt> attempts = force_attempts(search_for(8));
  ASSERT_EQ(attempts.size(), 9u);
  EXPECT_EQ(name_of(attempts[0]), "stored, contact dynamics");
  EXPECT_EQ(name_of(attempts[1]), "zero");
  EXPECT_EQ(name_of(attempts[3]), "doubled");
  EXPECT_EQ(name_of(attempts[5]), "zero, shuffled sweeps");
  EXPECT_EQ(name_of(attempts[6]), "scattered");
  EXPECT_EQ(name_of(attempts[7]), "exponential");
  EXPECT_EQ(name_of(attempts[8]), "uniform");
  EXPECT_EQ(force_attempts(search_for(2)).size(), 3u);
}

class MeasuredForces : public testing::Test {
 protected:
  static FrameForces forces_of(const FrozenBed& bed, double length, ForceSearch search,
                               const std::vector<std::string>& settings = {"gamma_c=0.3"}) {
    const Frame stored = session::make_frame(loaded_world(bed, bed.step.guess), bed.law);
    return admissible_forces(bed, {stored, statics_of(bed.world, length)},
                             runs::parse_analysis_settings(settings), std::nan(""), search);
  }
};

TEST_F(MeasuredForces, spread_where_forces_do) {
  const FrameForces found = forces_of(small_bed(), small_bed().world.boundary.length, search_for(8));
  ASSERT_EQ(found.quantities.size(), 8u);
  EXPECT_EQ(found.quantities[5].name, "p_o");
  EXPECT_EQ(found.quantities[5].factor, 2.0);
  EXPECT_EQ(found.admissible(), 8);
  for (std::size_t q = 0; q < found.quantities.size(); ++q) {
    const ForceSpread& spread = found.spreads[q];
    if (spread.count == 0) continue;
    EXPECT_LE(spread.least, spread.mean);
    EXPECT_GE(spread.largest, spread.mean);
  }
  EXPECT_NEAR(found.sets[0].values[0], found.stored[0], 1e-4) << "Gamma of the stored forces, solved again";
  EXPECT_GT(found.spreads[0].deviation, 0.0);
  double sum = 0.0;
  for (std::size_t s = 1; s < found.sets.size(); ++s) sum += found.sets[s].values[0];
  EXPECT_NEAR(found.spreads[0].mean, sum / 8.0, 1e-12) << "the stored forces do not count";
}

TEST_F(MeasuredForces, of_one_admissible_set_do_not_spread) {
  const FrameForces found =
      forces_of(grain_on_two(0.0), 20.0 * test::radius, search_for(8), {"gamma_c=0.3", "l_min=0"});
  EXPECT_EQ(found.admissible(), 8);
  EXPECT_NEAR(found.stored[0], 0.5, 1e-6) << "moments sin^2 30 and cos^2 30";
  for (const ForceSpread& spread : found.spreads)
    if (spread.count > 0) {
      EXPECT_LT(spread.deviation, 1e-6);
    }
}

TEST_F(MeasuredForces, that_do_not_converge_do_not_count) {
  ForceSearch search = search_for(3);
  search.max_iterations = 1;
  const FrameForces found = forces_of(small_bed(), 0.06, search);
  EXPECT_EQ(found.sets.size(), 4u);
  EXPECT_EQ(found.admissible(), 0);
  EXPECT_EQ(found.spreads[0].count, 0);
  EXPECT_TRUE(std::isnan(found.spreads[0].mean));
}

TEST_F(MeasuredForces, need_a_threshold_and_one_frame) {
  EXPECT_THROW(forces_of(small_bed(), 0.06, search_for(1), {}), Error);
  EXPECT_THROW(forces_of(small_bed(), 0.06, search_for(1), {"gamma_c=0.3", "averaging=1"}), Error);
}

}  // namespace
}  // namespace talus::problems
