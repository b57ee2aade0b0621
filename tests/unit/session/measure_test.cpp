/// Quantities of a bed in which contacts keep remains of a force.

#include "session/measure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace talus::session {
namespace {

constexpr double friction = 0.5;

/// Returns three free grains above a floor grain, of which the first two rest on it. The force between these
/// two, and that between the second and the third, are remains: `share` times the mean weight, sliding.
World bed_with_remains(double share) {
  World world;
  for (const double x : {0.1, 0.2, 0.3}) add_disk(world.grains, {x, 0.2}, 0.05, 2500.0, false);
  add_disk(world.grains, {0.15, 0.1}, 0.05, 2500.0, true);
  world.boundary.periodic = true;
  world.boundary.length = 1.0;
  const double weight = world.grains.mass[0] * world.gravity;
  Contacts& contacts = world.contacts;
  contacts.resize(4);
  contacts.a = {0, 0, 1, 1};
  contacts.b = {1, 3, 2, 3};
  contacts.nx = {1.0, 0.6, 1.0, -0.6};
  contacts.ny = {0.0, -0.8, 0.0, -0.8};
  contacts.fn = {share * weight, weight, share * weight, weight};
  contacts.ft = {friction * share * weight, 0.0, friction * share * weight, 0.1 * weight};
  return world;
}

dynamics::ContactLawParameters law() {
  dynamics::ContactLawParameters law;
  law.friction = friction;
  return law;
}

TEST(Measure, takes_a_contact_below_1e_9_of_the_weight_of_a_grain_as_open) {
  for (const double share : {0.99e-9, 1e-40}) {
    const World world = bed_with_remains(share);
    const ObservableRow row = measure(world, {.baseline = {1.0, 1.0}, .law = law()});
    EXPECT_EQ(at(row, Observable::coordination_number), 1.0) << "two grains with one contact each";
    EXPECT_EQ(at(row, Observable::critical_fraction), 0.0);
    const Frame frame = make_frame(world, law());
    EXPECT_EQ(frame.contacts.a, (std::vector<Index>{0, 1}));
    EXPECT_EQ(frame.contacts.b, (std::vector<Index>{3, 3}));
    EXPECT_TRUE(std::isfinite(frame.gamma[0]) && std::isfinite(frame.gamma[1]));
    EXPECT_TRUE(std::isnan(frame.gamma[2])) << "it carries nothing but remains";
    EXPECT_EQ(frame.internal_moment[2].xx, 0.0);
  }
}

TEST(Measure, takes_a_contact_from_1e_9_of_the_weight_of_a_grain_on_as_loaded) {
  const World world = bed_with_remains(1.01e-9);
  const ObservableRow row = measure(world, {.baseline = {1.0, 1.0}, .law = law()});
  EXPECT_DOUBLE_EQ(at(row, Observable::coordination_number), 2.0) << "two, three and one contacts";
  EXPECT_EQ(at(row, Observable::critical_fraction), 0.5);
  EXPECT_EQ(make_frame(world, law()).contacts.count(), 4);
}

}  // namespace
}  // namespace talus::session
