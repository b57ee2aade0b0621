/// Pushes on a small bed on its way to failure: far below theta_c they are absorbed, close to theta_c they
/// cause failure.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/trigonometry.h"
#include "session/perturbation_threshold.h"
#include "session/session.h"

namespace talus {
namespace {

scenario::Scenario small_bed() {
  scenario::Scenario scenario;
  scenario.seed = 3;
  scenario.bed.length = 12;
  scenario.bed.depth = 6;
  scenario.deposition.method = scenario::DepositionMethod::collapse;
  return scenario;
}
constexpr session::SurfacePatch patch{4.0, 1.0};

/// Bed tilted until failure, with copies on the way.
struct TiltedBed {
  World far;   ///< bed at 8 deg
  World near;  ///< the last of the copies, taken every 0.2 deg, that comes to rest by itself
  double theta_c = 0.0;
};

const TiltedBed& tilted_bed() {
  static const TiltedBed bed = [] {
    TiltedBed made;
    std::vector<World> copies;
    session::Session session(small_bed());
    while (session.phase() != session::Phase::done) {
      session.advance();
      session.clear_segment();
      const long step = std::lround(degrees(session.world().tilt) / 0.001);
      if (session.phase() == session::Phase::tilt && step == 8000) made.far = session.world();
      if (session.phase() == session::Phase::tilt && step % 200 == 0) copies.push_back(session.world());
    }
    made.theta_c = session.angle_of_repose().value();
    do {
      made.near = copies.back();
      copies.pop_back();
    } while (!copies.empty() && session::follow(made.near, small_bed()).end != session::TrialEnd::rest);
    return made;
  }();
  return bed;
}

// A disk that cannot roll and is pushed with velocity v slides v^2 / (2 mu g), and up to one step further.
// Crossing the periodic edge is no displacement.
TEST(Metastability, a_disk_slides_as_far_as_friction_lets_it) {
  const scenario::Scenario scenario = small_bed();
  World world;
  world.boundary = {true, 0.12, {{.normal = {0.0, 1.0}, .offset = 0.0, .wall = false}}};
  add_disk(world.grains, {0.1199, 0.005}, 0.005, 2500.0, false);
  world.grains.inverse_inertia[0] = 0.0;
  const double velocity = 0.1;
  world.grains.vx[0] = velocity;
  const session::Trial trial = session::follow(world, scenario);
  EXPECT_EQ(trial.end, session::TrialEnd::rest);
  EXPECT_EQ(world.grains.image[0], 1);
  EXPECT_EQ(trial.moved, 0);
  const double slide = velocity * velocity / (2.0 * scenario.contact.friction * world.gravity);
  EXPECT_NEAR(trial.displacement, slide / 0.01, velocity * scenario::time_step(scenario) / 0.01);
}

TEST(Metastability, a_bed_far_from_failure_absorbs_a_push_and_rests_again) {
  const TiltedBed& bed = tilted_bed();
  ASSERT_GT(degrees(bed.theta_c), 12.0);
  const session::Trial trial = session::push_trial(bed.far, small_bed(), patch, 0.3);
  EXPECT_EQ(trial.end, session::TrialEnd::rest);
  EXPECT_EQ(trial.moved, 0);
  EXPECT_GT(trial.displacement, 0.0);
  EXPECT_LT(trial.displacement, 0.1);
  EXPECT_GT(trial.energy, 0.1);
}

TEST(Metastability, a_bed_next_to_failure_fails_by_a_strong_push) {
  const TiltedBed& bed = tilted_bed();
  EXPECT_LT(degrees(bed.theta_c - bed.near.tilt), 1.0);
  const session::Trial trial = session::push_trial(bed.near, small_bed(), patch, 3.0);
  EXPECT_EQ(trial.end, session::TrialEnd::avalanche);
  EXPECT_GT(trial.moved, bed.near.grains.free_count / 4);
  EXPECT_GE(trial.displacement, 5.0);
}

TEST(Metastability, threshold_falls_on_the_way_to_failure) {
  const TiltedBed& bed = tilted_bed();
  const session::Threshold far = session::threshold_of(session::perturb(bed.far, small_bed(), patch));
  const session::Threshold near = session::threshold_of(session::perturb(bed.near, small_bed(), patch));
  EXPECT_TRUE(far.held && near.held);
  EXPECT_GT(far.without, 2.0 * near.with);
}

TEST(Metastability, a_trial_is_given_up_when_it_is_told_to) {
  int asked = 0;
  World world = tilted_bed().far;
  const std::int64_t begin = world.step;
  EXPECT_THROW(session::follow(world, small_bed(),
                               [&] {
                                 if (++asked == 5) throw 0;
                               }),
               int);
  EXPECT_EQ(world.step, begin + 4);
}

TEST(Metastability, the_same_push_has_the_same_answer) {
  const TiltedBed& bed = tilted_bed();
  const session::Trial once = session::push_trial(bed.far, small_bed(), patch, 1.0);
  const session::Trial again = session::push_trial(bed.far, small_bed(), patch, 1.0);
  EXPECT_EQ(once.time, again.time);
  EXPECT_EQ(once.displacement, again.displacement);
}

}  // namespace
}  // namespace talus
