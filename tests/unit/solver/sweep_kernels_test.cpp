// Fast kernels compared bit for bit with each other and with the same arithmetic in plain form.

#include "solver/sweep_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "core/random.h"
#include "solver/problem.h"

namespace talus::solver {
namespace {

constexpr float beta = 0.7F, friction = 0.5F;

struct Scene {
  std::vector<ContactGroup> contacts;
  std::vector<UnlikeGroup> unlike;
  std::vector<ImpulseGroup> increment, last_move;
  std::vector<Row> velocity, before;
  SweepSums sums;

  Index groups() const { return static_cast<Index>(contacts.size()); }
  Index rows() const { return static_cast<Index>(velocity.size()); }
  /// Arrays of contacts of any kind.
  ContactArrays contact_arrays() {
    return {contacts.data(), increment.data(), last_move.data(), velocity.data(), 0.0F, unlike.data()};
  }
  /// Arrays of contacts that are alike.
  ContactArrays alike_arrays() {
    return {contacts.data(), increment.data(), last_move.data(), velocity.data(), friction};
  }
  BodyArrays body_arrays() { return {velocity.data(), before.data()}; }
};

/// Returns contacts between random disks, none of which occurs twice among groups that are swept together:
/// open, sticking and sliding ones.
Scene random_scene(Index groups, Index bodies) {
  Random random(7);
  const auto uniform = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
  Scene scene;
  scene.contacts.resize(groups);
  scene.unlike.resize(groups);
  scene.increment.resize(groups);
  scene.last_move.resize(groups);
  std::vector<Index> order;
  std::vector<float> mass;
  for (Index i = 0; i < bodies; ++i) {
    order.push_back(i);
    mass.push_back(1.0F + 0.2F * uniform());
    scene.velocity.push_back({uniform(), uniform(), uniform(), 0.0F});
    scene.before.push_back({uniform(), uniform(), uniform(), 0.0F});
  }
  for (Index g = 0; g < groups; ++g) {
    if (g % groups_abreast == 0)
      for (std::size_t i = order.size() - 1; i > 0; --i)
        std::swap(order[i], order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))]);
    ContactGroup& group = scene.contacts[g];
    for (int k = 0; k < lane_count; ++k) {
      const int place = 2 * (g % groups_abreast * lane_count + k);
      const Index a = order[place], b = order[place + 1];
      const float angle = 3.0F * uniform();
      group.nx[k] = std::cos(angle);
      group.ny[k] = std::sin(angle);
      group.un[k] = uniform();
      group.ut[k] = uniform();
      const float pn = std::max(0.0F, uniform());
      group.least[k] = -pn;
      scene.unlike[g].mu[k] = friction;
      const float tangential = 0.5F * pn * uniform();
      group.above[k] = 0.5F * pn - tangential;
      group.below[k] = -0.5F * pn - tangential;
      group.wn[k] = 0.5F;
      group.wt[k] = 0.17F;
      group.mass_a[k] = -mass[a];
      group.mass_b[k] = mass[b];
      scene.unlike[g].spin_a[k] = -2.0F * mass[a];
      scene.unlike[g].spin_b[k] = -2.0F * mass[b];
      group.a[k] = static_cast<std::uint32_t>(a * sizeof(Row));
      group.b[k] = static_cast<std::uint32_t>(b * sizeof(Row));
      scene.increment[g].n[k] = 0.1F * uniform();
      scene.increment[g].t[k] = 0.1F * uniform();
      scene.last_move[g].n[k] = 0.1F * uniform();
      scene.last_move[g].t[k] = 0.1F * uniform();
    }
  }
  return scene;
}

/// Returns the same with a different friction for each contact, and bodies with larger moments of inertia.
Scene scene_of_others(Index groups, Index bodies) {
  Scene scene = random_scene(groups, bodies);
  for (std::size_t g = 0; g < scene.contacts.size(); ++g)
    for (int k = 0; k < lane_count; ++k) {
      scene.unlike[g].mu[k] = 0.3F + 0.05F * static_cast<float>(k);
      scene.unlike[g].spin_a[k] *= 0.8F;
      scene.unlike[g].spin_b[k] *= 0.7F;
    }
  return scene;
}

/// Returns the value within its bounds; the bounds of chance may cross, which std::clamp does not permit.
float within(float value, float low, float high) { return std::min(std::max(value, low), high); }

/// Solves the contact in a lane, with the velocities left by the preceding contacts.
void plain_contact(Scene& scene, Index g, int k, SweepSums& sums) {
  const ContactGroup& group = scene.contacts[g];
  const UnlikeGroup& own = scene.unlike[g];
  const float mu = own.mu[k];
  Row& va = scene.velocity[group.a[k] / sizeof(Row)];
  Row& vb = scene.velocity[group.b[k] / sizeof(Row)];
  const float nx = group.nx[k], ny = group.ny[k];
  const float un = (vb.x - va.x) * nx + (vb.y - va.y) * ny + group.un[k];
  const float ut = (vb.y - va.y) * nx - (vb.x - va.x) * ny - (vb.spin + va.spin) + group.ut[k];
  float &n = scene.increment[g].n[k], &t = scene.increment[g].t[k];
  float &last_n = scene.last_move[g].n[k], &last_t = scene.last_move[g].t[k];
  const float yn = n + beta * last_n, yt = t + beta * last_t;
  const float pn = std::max(yn - un * group.wn[k], group.least[k]);
  const float pt = within(yt - ut * group.wt[k], group.below[k] - mu * pn, group.above[k] + mu * pn);
  const float en = pn - yn, et = pt - yt;
  last_n = pn - n;
  last_t = pt - t;
  n = pn;
  t = pt;
  sums.change += en * en + et * et;
  sums.ascent -= en * last_n + et * last_t;
  const float x = en * nx - et * ny, y = en * ny + et * nx;
  va = {va.x + x * group.mass_a[k], va.spin + et * own.spin_a[k], va.y + y * group.mass_a[k], 0.0F};
  vb = {vb.x + x * group.mass_b[k], vb.spin + et * own.spin_b[k], vb.y + y * group.mass_b[k], 0.0F};
}

template <class T>
bool same_bits(const std::vector<T>& x, const std::vector<T>& y) {
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(T)) == 0;
}

void expect_same(const Scene& one, const Scene& other) {
  EXPECT_TRUE(same_bits(one.increment, other.increment));
  EXPECT_TRUE(same_bits(one.last_move, other.last_move));
  EXPECT_TRUE(same_bits(one.velocity, other.velocity));
  EXPECT_EQ(one.sums.change, other.sums.change);
}

TEST(SweepKernels, give_contacts_that_are_alike_the_same_bits_by_a_shorter_way) {
  const Scene start = random_scene(20, 64);
  Scene plain = start;
  sweep_kernels().contacts(plain.contact_arrays(), 0, plain.groups(), beta, plain.sums);
  for (const SweepKernels& kernels : {sweep_kernels_baseline(), sweep_kernels()}) {
    Scene alike = start;
    kernels.contacts(alike.alike_arrays(), 0, alike.groups(), beta, alike.sums);
    expect_same(plain, alike);
  }
}

// Members of a team begin at any row.
TEST(SweepKernels, extrapolate_bodies_in_parts_of_any_length) {
  for (const SweepKernels& kernels : {sweep_kernels_baseline(), sweep_kernels()}) {
    Scene whole = random_scene(20, 64);
    Scene parts = whole;
    kernels.bodies(whole.body_arrays(), 0, whole.rows(), beta);
    Index first = 0;
    for (const Index count : {1, 2, 5, 0, 7}) {
      kernels.bodies(parts.body_arrays(), first, first + count, beta);
      first += count;
    }
    kernels.bodies(parts.body_arrays(), first, parts.rows(), beta);
    EXPECT_TRUE(same_bits(whole.velocity, parts.velocity));
    EXPECT_TRUE(same_bits(whole.before, parts.before));
  }
}

TEST(SweepKernels, give_the_same_bits_where_they_read_ahead) {
  Scene near = random_scene(20, 64);
  Scene ahead = near;
  ContactArrays arrays = ahead.contact_arrays();
  arrays.reads_ahead = true;
  sweep_kernels().contacts(near.contact_arrays(), 0, near.groups(), beta, near.sums);
  sweep_kernels().contacts(arrays, 0, ahead.groups(), beta, ahead.sums);
  expect_same(near, ahead);
}

/// The same contacts with rolling resistance.
struct RollingScene {
  Scene scene;
  std::vector<RollingGroup> groups;
  std::vector<RollingImpulses> increment, last_move;
  SweepSums sums;

  explicit RollingScene(Scene of_contacts = scene_of_others(20, 64)) : scene(std::move(of_contacts)) {
    Random random(9);
    const auto uniform = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    groups.resize(scene.contacts.size());
    increment.resize(groups.size());
    last_move.resize(groups.size());
    for (Row& row : scene.velocity) row.turn = uniform();
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (int k = 0; k < lane_count; ++k) {
        RollingGroup& group = groups[g];
        group.ur[k] = uniform();
        group.above[k] = 0.1F + 0.1F * uniform();
        group.below[k] = -0.1F + 0.1F * uniform();
        group.mu[k] = 0.2F;
        group.w[k] = 0.2F;
        group.coupling[k] = 0.3F * uniform();
        group.lever_a[k] = 0.7F;
        group.lever_b[k] = 0.9F;
        group.length[k] = 1.6F;
        group.inertia_a[k] = 1.3F;
        group.inertia_b[k] = 1.1F;
        increment[g].r[k] = 0.1F * uniform();
        last_move[g].r[k] = 0.1F * uniform();
      }
  }

  void sweep(const SweepKernels& kernels) { sweep(kernels, scene.contact_arrays()); }
  void sweep(const SweepKernels& kernels, ContactArrays arrays) {
    arrays.rolling = groups.data();
    arrays.rolling_increment = increment.data();
    arrays.rolling_move = last_move.data();
    kernels.rolling_contacts(arrays, 0, scene.groups(), beta, sums);
  }
};

TEST(SweepKernels, rolling_contacts_give_the_same_bits_whatever_the_processor) {
  RollingScene baseline, fastest;
  for (int k = 0; k < 5; ++k) {
    baseline.sweep(sweep_kernels_baseline());
    fastest.sweep(sweep_kernels());
  }
  EXPECT_TRUE(same_bits(baseline.increment, fastest.increment));
  EXPECT_TRUE(same_bits(baseline.last_move, fastest.last_move));
  expect_same(baseline.scene, fastest.scene);
  EXPECT_EQ(baseline.sums.change, fastest.sums.change);
  EXPECT_EQ(baseline.sums.ascent, fastest.sums.ascent);
}

TEST(SweepKernels, give_rolling_contacts_that_are_alike_the_same_bits_by_a_shorter_way) {
  RollingScene plain(random_scene(20, 64)), alike(random_scene(20, 64));
  plain.sweep(sweep_kernels());
  alike.sweep(sweep_kernels(), alike.scene.alike_arrays());
  EXPECT_TRUE(same_bits(plain.increment, alike.increment));
  expect_same(plain.scene, alike.scene);
}

TEST(SweepKernels, rolling_contacts_do_what_the_plain_arithmetic_does_one_by_one) {
  RollingScene rolling, before;
  Scene plain = rolling.scene;
  rolling.sweep(sweep_kernels());
  int held = 0;
  for (Index g = 0; g < plain.groups(); ++g)
    for (int k = 0; k < lane_count; ++k) {
      const ContactGroup& contact = plain.contacts[g];
      const RollingGroup& group = before.groups[g];
      Row& va = plain.velocity[contact.a[k] / sizeof(Row)];
      Row& vb = plain.velocity[contact.b[k] / sizeof(Row)];
      const float turn_a = va.turn, turn_b = vb.turn, spin_a = va.spin, spin_b = vb.spin;
      const float old_t = plain.increment[g].t[k], last_t = plain.last_move[g].t[k];
      SweepSums sums;
      plain_contact(plain, g, k, sums);
      const float et = plain.increment[g].t[k] - (old_t + beta * last_t);
      const float ur = group.length[k] * (turn_b - turn_a) + group.ur[k] + group.coupling[k] * et;
      const float old = before.increment[g].r[k], y = old + beta * before.last_move[g].r[k];
      const float more = group.mu[k] * plain.increment[g].n[k];
      const float p = within(y - ur * group.w[k], group.below[k] - more, group.above[k] + more);
      const float moment = group.length[k] * (p - y);
      const float da = -group.inertia_a[k] * (group.lever_a[k] * et + moment);
      const float db = group.inertia_b[k] * (moment - group.lever_b[k] * et);
      va.turn = turn_a + da;
      vb.turn = turn_b + db;
      va.spin = spin_a + group.lever_a[k] * da;
      vb.spin = spin_b + group.lever_b[k] * db;
      EXPECT_NEAR(rolling.increment[g].r[k], p, 1e-6F);
      EXPECT_NEAR(rolling.last_move[g].r[k], p - old, 1e-6F);
      held += p > group.below[k] - more && p < group.above[k] + more ? 1 : 0;
    }
  EXPECT_GT(held, 5);
  for (Index i = 0; i < plain.rows(); ++i) {
    EXPECT_NEAR(rolling.scene.velocity[i].turn, plain.velocity[i].turn, 1e-5F);
    EXPECT_NEAR(rolling.scene.velocity[i].spin, plain.velocity[i].spin, 1e-5F);
    EXPECT_NEAR(rolling.scene.velocity[i].x, plain.velocity[i].x, 1e-5F);
  }
}

TEST(SweepKernels, contacts_do_what_the_plain_arithmetic_does_one_by_one) {
  const Scene start = scene_of_others(20, 64);
  Scene plain = start;
  SweepSums sums, parts[2][2];
  for (Index g = 0; g < plain.groups(); ++g)
    for (int k = 0; k < lane_count; ++k) plain_contact(plain, g, k, sums);
  for (int processor = 0; processor < 2; ++processor) {
    const SweepKernels& kernels = processor == 0 ? sweep_kernels_baseline() : sweep_kernels();
    Scene scene = start;
    const Index half = scene.groups() / 2;
    kernels.contacts(scene.contact_arrays(), 0, half, beta, parts[processor][0]);
    kernels.contacts(scene.contact_arrays(), half, scene.groups(), beta, parts[processor][1]);
    int open = 0, sliding = 0;
    for (Index g = 0; g < scene.groups(); ++g)
      for (int k = 0; k < lane_count; ++k) {
        const ImpulseGroup &got = scene.increment[g], &expected = plain.increment[g];
        EXPECT_EQ(got.n[k], expected.n[k]);
        EXPECT_EQ(got.t[k], expected.t[k]);
        EXPECT_EQ(scene.last_move[g].n[k], plain.last_move[g].n[k]);
        EXPECT_EQ(scene.last_move[g].t[k], plain.last_move[g].t[k]);
        const ContactGroup& contact = scene.contacts[g];
        open += got.n[k] == contact.least[k] ? 1 : 0;
        sliding += got.t[k] == contact.above[k] + plain.unlike[g].mu[k] * got.n[k] ? 1 : 0;
      }
    EXPECT_GT(open, 10);
    EXPECT_GT(sliding, 10);
    for (Index i = 0; i < scene.rows(); ++i) {
      EXPECT_EQ(scene.velocity[i].x, plain.velocity[i].x);
      EXPECT_EQ(scene.velocity[i].y, plain.velocity[i].y);
      EXPECT_EQ(scene.velocity[i].spin, plain.velocity[i].spin);
    }
    const auto& [first, second] = parts[processor];
    EXPECT_NEAR(first.change + second.change, sums.change, 1e-5 * sums.change);
    EXPECT_NEAR(first.ascent + second.ascent, sums.ascent, 1e-5 * sums.change);
  }
  for (const int part : {0, 1}) {
    EXPECT_EQ(parts[0][part].change, parts[1][part].change) << "whatever the processor";
    EXPECT_EQ(parts[0][part].ascent, parts[1][part].ascent) << "whatever the processor";
  }
}

TEST(SweepKernels, bodies_go_on_as_they_went) {
  const Scene old = random_scene(2, 64);
  for (const SweepKernels& kernels : {sweep_kernels_baseline(), sweep_kernels()}) {
    Scene scene = old;
    kernels.bodies(scene.body_arrays(), 0, scene.rows(), beta);
    for (Index i = 0; i < scene.rows(); ++i) {
      const Row &now = scene.velocity[i], &was = old.velocity[i], &earlier = old.before[i];
      EXPECT_EQ(now.x, was.x + beta * (was.x - earlier.x));
      EXPECT_EQ(now.y, was.y + beta * (was.y - earlier.y));
      EXPECT_EQ(now.spin, was.spin + beta * (was.spin - earlier.spin));
      EXPECT_EQ(scene.before[i].x, was.x);
      EXPECT_EQ(scene.before[i].y, was.y);
      EXPECT_EQ(scene.before[i].spin, was.spin);
    }
  }
}

/// Contacts of random bodies in double precision.
struct Contacts {
  std::vector<Index> a, b;
  std::vector<double> nx, ny, cn, ct, mu, pn, pt, wn, wt, un, ut;
  std::vector<ExactRow> velocity;

  ResidualArrays arrays() {
    return {a.data(),  b.data(),  nx.data(), ny.data(), cn.data(),       ct.data(), mu.data(),
            pn.data(), pt.data(), wn.data(), wt.data(), velocity.data(), un.data(), ut.data()};
  }
};

Contacts random_contacts(Index count, Index bodies) {
  Random random(3);
  const auto uniform = [&] { return 2.0 * random.uniform() - 1.0; };
  Contacts contacts;
  for (Index i = 0; i < bodies; ++i) contacts.velocity.push_back({uniform(), uniform(), uniform()});
  for (Index c = 0; c < count; ++c) {
    contacts.a.push_back(static_cast<Index>(random.uniform() * bodies));
    contacts.b.push_back(static_cast<Index>(random.uniform() * bodies));
    const double angle = 3.0 * uniform();
    contacts.nx.push_back(std::cos(angle));
    contacts.ny.push_back(std::sin(angle));
    contacts.cn.push_back(uniform());
    contacts.ct.push_back(0.1 * uniform());
    contacts.mu.push_back(0.5);
    contacts.pn.push_back(std::max(0.0, uniform()));
    contacts.pt.push_back(0.5 * contacts.pn.back() * uniform());
    contacts.wn.push_back(0.5);
    contacts.wt.push_back(0.17);
  }
  contacts.un.assign(contacts.a.size(), 0.0);
  contacts.ut = contacts.un;
  return contacts;
}

TEST(SweepKernels, look_with_the_same_bits_whatever_the_processor) {
  Contacts baseline = random_contacts(203, 40);
  Contacts fastest = baseline;
  ContactResidualSums sums[2];
  sweep_kernels_baseline().residual(baseline.arrays(), 0, 203, sums[0]);
  sweep_kernels().residual(fastest.arrays(), 0, 203, sums[1]);
  EXPECT_EQ(baseline.un, fastest.un);
  EXPECT_EQ(baseline.ut, fastest.ut);
  EXPECT_EQ(std::memcmp(&sums[0], &sums[1], sizeof(ContactResidualSums)), 0);
}

TEST(SweepKernels, look_at_contacts_as_the_contact_law_does) {
  for (const Index first : {0, 5})
    for (const Index last : {5, 6, 7, 8, 200}) {
      Contacts contacts = random_contacts(200, 40);
      ContactResidualSums sums;
      sweep_kernels().residual(contacts.arrays(), first, last, sums);
      ResidualSums plain;
      for (Index c = 0; c < 200; ++c) {
        const ExactRow &va = contacts.velocity[contacts.a[c]], &vb = contacts.velocity[contacts.b[c]];
        const double nx = contacts.nx[c], ny = contacts.ny[c];
        const double un = (vb.x - va.x) * nx + (vb.y - va.y) * ny + contacts.cn[c];
        const double ut = (vb.y - va.y) * nx - (vb.x - va.x) * ny - (va.spin + vb.spin) + contacts.ct[c];
        const bool seen = c >= first && c < last;
        EXPECT_DOUBLE_EQ(contacts.un[c], seen ? un : 0.0);
        EXPECT_DOUBLE_EQ(contacts.ut[c], seen ? ut : 0.0);
        if (seen)
          plain.add({contacts.pn[c], contacts.pt[c]},
                    solve_contact(contacts.pn[c], contacts.pt[c], un, ut, contacts.wn[c], contacts.wt[c],
                                  contacts.mu[c]));
      }
      EXPECT_NEAR(sums.change, plain.change, 1e-14 * plain.change);
      EXPECT_NEAR(sums.impulse, plain.impulse, 1e-14 * plain.impulse);
      EXPECT_NEAR(sums.impulse_after, plain.impulse_after, 1e-14 * plain.impulse_after);
      EXPECT_DOUBLE_EQ(sums.largest, plain.largest);
    }
}

}  // namespace
}  // namespace talus::solver
