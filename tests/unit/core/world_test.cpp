#include "core/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "core/snapshot.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

/// Returns two free grains in contact, a floor grain and a plane, with a different value in every field.
World small_world() {
  World world;
  add_disk(world.grains, {0.1, 0.2}, 0.05, 2500.0, false);
  add_disk(world.grains, {0.2, 0.2}, 0.05, 2500.0, false);
  add_disk(world.grains, {0.1, 0.1}, 0.05, 2500.0, true);
  world.boundary.periodic = true;
  world.boundary.length = 1.0;
  world.boundary.planes.push_back({{0.0, 1.0}, 0.01});
  Contacts& c = world.contacts;
  c.resize(1);
  c.a = {0};
  c.b = {1};
  c.nx = {1.0};
  c.fn = {3.0};
  c.ft = {-0.5};
  world.tilt = 0.1;
  world.time = 2.0;
  world.step = 17;
  return world;
}

using Change = std::pair<std::string, std::function<void(World&)>>;

/// Returns the smallest change of each field on which the next step depends.
std::vector<Change> changes_of_state() {
  std::vector<Change> changes;
  auto nudge = [](double& value) { value = std::nextafter(value, 1e300); };
  const std::vector<std::pair<std::string, std::vector<double> Grains::*>> grain_fields = {
      {"x", &Grains::x},
      {"y", &Grains::y},
      {"vx", &Grains::vx},
      {"vy", &Grains::vy},
      {"omega", &Grains::omega},
      {"radius", &Grains::radius},
      {"mass", &Grains::mass},
      {"inverse_mass", &Grains::inverse_mass},
      {"angle", &Grains::angle},
      {"inverse_inertia", &Grains::inverse_inertia},
      {"inertia", &Grains::inertia}};
  for (const auto& [name, field] : grain_fields)
    changes.push_back({"grains." + name, [=, member = field](World& w) { nudge((w.grains.*member)[1]); }});
  changes.push_back({"grains.image", [](World& w) { ++w.grains.image[1]; }});
  changes.push_back({"grains.free_count", [](World& w) { --w.grains.free_count; }});
  changes.push_back({"boundary.periodic", [](World& w) { w.boundary.periodic = false; }});
  changes.push_back({"boundary.length", [=](World& w) { nudge(w.boundary.length); }});
  changes.push_back({"plane.normal.x", [=](World& w) { nudge(w.boundary.planes[0].normal.x); }});
  changes.push_back({"plane.normal.y", [=](World& w) { nudge(w.boundary.planes[0].normal.y); }});
  changes.push_back({"plane.offset", [=](World& w) { nudge(w.boundary.planes[0].offset); }});
  changes.push_back({"plane.wall", [](World& w) { w.boundary.planes[0].wall = false; }});
  changes.push_back({"planes", [](World& w) { w.boundary.planes.push_back({}); }});
  changes.push_back({"contacts.a", [](World& w) { w.contacts.a[0] = 2; }});
  changes.push_back({"contacts.b", [](World& w) { w.contacts.b[0] = 2; }});
  changes.push_back({"contacts.shift", [](World& w) { w.contacts.shift[0] = 1; }});
  changes.push_back({"contacts.fn", [=](World& w) { nudge(w.contacts.fn[0]); }});
  changes.push_back({"contacts.ft", [=](World& w) { nudge(w.contacts.ft[0]); }});
  changes.push_back({"gravity", [=](World& w) { nudge(w.gravity); }});
  changes.push_back({"tilt", [=](World& w) { nudge(w.tilt); }});
  changes.push_back({"time", [=](World& w) { nudge(w.time); }});
  changes.push_back({"step", [](World& w) { ++w.step; }});
  return changes;
}

TEST(StateHash, sees_the_last_bit_of_every_field) {
  const std::uint64_t before = state_hash(small_world());
  for (const auto& [name, change] : changes_of_state()) {
    World world = small_world();
    change(world);
    EXPECT_NE(state_hash(world), before) << name;
  }
}

// Normal, tangent and gap of a contact follow from the positions; the next detection recomputes them.
TEST(StateHash, leaves_out_what_follows_from_the_rest) {
  World world = small_world();
  world.contacts.nx[0] = 0.5;
  world.contacts.ny[0] = 0.5;
  world.contacts.gap[0] = 1e-6;
  EXPECT_EQ(state_hash(world), state_hash(small_world()));
}

TEST(StateHash, is_that_of_the_value_not_of_the_object) {
  const World world = small_world();
  const World copy = world;
  EXPECT_EQ(state_hash(copy), state_hash(world));
  EXPECT_EQ(hash_text(state_hash(world)), "054ce27bd5493ab8");
}

TEST(Hash, agrees_with_xxh3_and_with_itself_in_pieces) {
  EXPECT_EQ(hash_text(hash_bytes({})),
            "2d06800538d394c2");  // XXH3_64bits of empty input, xxHash specification
  EXPECT_EQ(parse_hash("2d06800538d394c2"), 0x2d06800538d394c2u);
  for (const char* bad : {"", "2d06800538d394c", "2d06800538d394cx", "2d06800538d394c20"})
    EXPECT_EQ(parse_hash(bad), 0u);
  const std::string text = "granular slope";
  Hasher pieces;
  pieces.add_bytes(text.data(), 8);
  pieces.add_bytes(text.data() + 8, text.size() - 8);
  EXPECT_EQ(pieces.value(), hash_bytes(std::as_bytes(std::span(text))));
}

TEST(Hash, arrays_cannot_trade_elements) {
  Hasher one, other;
  one.add_array(std::vector<int>{1, 2});
  one.add_array(std::vector<int>{3});
  other.add_array(std::vector<int>{1});
  other.add_array(std::vector<int>{2, 3});
  EXPECT_NE(one.value(), other.value());
}

TEST(World, gravity_turns_with_the_tilt) {
  World world;
  world.gravity = 10.0;
  EXPECT_DOUBLE_EQ(gravity_vector(world).y, -10.0);
  world.tilt = radians(30.0);
  EXPECT_DOUBLE_EQ(gravity_vector(world).x, 5.0);  // along +x, downslope
  EXPECT_DOUBLE_EQ(gravity_vector(world).y, -10.0 * std::sqrt(0.75));
}

TEST(World, disks_have_the_mass_and_inertia_of_disks) {
  const World world = small_world();
  const Grains& g = world.grains;
  EXPECT_EQ(g.free_count, 2);
  EXPECT_EQ(g.count(), 3);
  EXPECT_DOUBLE_EQ(g.mass[0], 2500.0 * pi * 0.05 * 0.05);
  EXPECT_DOUBLE_EQ(g.inertia[0], 0.5 * g.mass[0] * 0.05 * 0.05);
  EXPECT_DOUBLE_EQ(g.inverse_inertia[0] * g.inertia[0], 1.0);
  EXPECT_EQ(g.inverse_mass[2], 0.0);
  EXPECT_EQ(g.inverse_inertia[2], 0.0);
}

TEST(World, energy_and_rms_velocity_count_rotation_and_leave_out_the_floor) {
  World world = small_world();
  Grains& g = world.grains;
  g.vx[0] = 3.0;
  g.vy[0] = 4.0;
  g.omega[1] = 2.0;
  g.vx[2] = 100.0;
  EXPECT_DOUBLE_EQ(kinetic_energy(g), 0.5 * g.mass[0] * 25.0 + 0.5 * g.inertia[1] * 4.0);
  EXPECT_DOUBLE_EQ(rms_velocity(g), std::sqrt((25.0 + 0.1 * 0.1) / 2.0));
  EXPECT_EQ(rms_velocity(Grains{}), 0.0);
}

TEST(Frame, loses_the_values_of_a_script_with_the_contact_that_they_belong_to) {
  Frame frame;
  FrameContacts& contacts = frame.contacts;
  contacts.fn = {1.0, 0.0, 2.0};
  for (auto* numbers :
       {&contacts.nx, &contacts.ny, &contacts.px, &contacts.py, &contacts.ft, &contacts.moment})
    numbers->resize(3);
  contacts.a = {0, 0, 1};
  contacts.b = {1, 2, 2};
  contacts.shift.resize(3);
  contacts.status.resize(3);
  frame.own = {{.values = {4.0, 5.0, 6.0}, .of_grains = false}, {.values = {7.0, 8.0, 9.0}}};
  remove_open_contacts(frame, 0.5);
  EXPECT_EQ(frame.own[0].values, (std::vector{4.0, 6.0}));
  EXPECT_EQ(frame.own[1].values.size(), 3U) << "of grains";
}

}  // namespace
}  // namespace talus
