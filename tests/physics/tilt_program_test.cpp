/// Poured bed that is tilted, held, and lowered again, well below its angle of repose.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "session/session.h"

namespace talus {
namespace {

scenario::Scenario lowered_bed(std::vector<std::string> program) {
  scenario::Scenario scenario;
  scenario.bed.length = 20.0;
  scenario.bed.depth = 8.0;
  scenario.deposition.rate = 1.0;
  scenario.tilt.rate = 4.0;
  scenario.tilt.step = 0.004;
  scenario.tilt.program = std::move(program);
  scenario.output.observable_every = 0.1;
  return scenario;
}

/// Returns the violation of the contact law in a world, tension or excess over Coulomb's limit, relative to
/// the largest force.
double violation(const World& world, double friction) {
  const Contacts& contacts = world.contacts;
  double largest = 0.0, worst = 0.0;
  for (Index c = 0; c < contacts.count(); ++c) {
    largest = std::max(largest, contacts.fn[c]);
    worst = std::max({worst, -contacts.fn[c], std::abs(contacts.ft[c]) - friction * contacts.fn[c]});
  }
  return worst / largest;
}

TEST(TiltProgram, a_bed_that_is_lowered_keeps_the_contact_law_and_its_stress_follows_the_tilt) {
  const scenario::Scenario scenario = lowered_bed({"to 8", "to -8", "to 0"});
  session::Session session(scenario);
  while (session.phase() != session::Phase::done) {
    session.advance();
    if (session.phase() != session::Phase::tilt) continue;
    ASSERT_LT(violation(session.world(), scenario.contact.friction), 1e-9) << degrees(session.world().tilt);
  }
  EXPECT_EQ(session.angle_of_repose(), std::nullopt);
  EXPECT_EQ(session.world().tilt, 0.0);
  // In a periodic bed at rest, force balance alone fixes sigma_T/sigma_N, for rising and falling tilts on
  // either side; Gamma is its sine except for the normal stress difference.
  int rising = 0, falling = 0, mirrored_slope = 0;
  double before = -1.0;
  for (const ObservableRow& row : session.segment().observables) {
    const double tilt = at(row, Observable::tilt);
    if (std::abs(tilt) > radians(2.0) && at(row, Observable::at_rest) == 1.0) {
      EXPECT_NEAR(at(row, Observable::sigma_t_over_n) / (sine(tilt) / cosine(tilt)), 1.0, 0.05)
          << degrees(tilt);
      ++(tilt < 0.0 ? mirrored_slope : tilt > before ? rising : falling);
    }
    before = tilt;
  }
  EXPECT_GT(rising, 5);
  EXPECT_GT(falling, 5);
  EXPECT_GT(mirrored_slope, 5);
}

TEST(TiltProgram, a_bed_that_is_held_comes_to_rest) {
  const scenario::Scenario scenario = lowered_bed({"to 6", "hold 2", "to 2", "hold 2"});
  session::Session session(scenario);
  double energy = 0.0;
  while (session.phase() != session::Phase::done) {
    session.advance();
    const std::int64_t steps = session.schedule().tilt_steps;
    if (session.phase() == session::Phase::deposition || steps == 0) continue;
    if (!session.program().turns_at(steps) || session.program().segment_of(steps).step != 0.0) continue;
    energy = kinetic_energy(session.world().grains);
    EXPECT_EQ(at(session.segment().observables.back(), Observable::at_rest), 1.0)
        << "at the end of the hold at " << degrees(session.world().tilt);
    EXPECT_LT(rms_velocity(session.world().grains),
              scenario.deposition.rest_velocity * session.world().gravity * scenario::time_step(scenario));
  }
  EXPECT_GT(energy, 0.0);
}

}  // namespace
}  // namespace talus
