// The fast kernels against each other, bit for bit, and against the same arithmetic written plainly.

#include "solver/gradient_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/random.h"

namespace talus {
namespace {

struct Scene {
  std::vector<ContactGroup> contacts;
  std::vector<ImpulseGroup> increment, ahead;
  std::vector<ForceGroup> force;
  std::vector<Row> velocity, mobility;
  std::vector<Index> first_a, first_b;
  std::vector<std::uint32_t> b_force;
  IterationSums sums;

  Row& force_of(Index c) { return force[c / lane_count].rows[c % lane_count]; }
  Index groups() const { return static_cast<Index>(contacts.size()); }
  Index bodies() const { return static_cast<Index>(velocity.size()); }
  ContactArrays contact_arrays() {
    return {contacts.data(), increment.data(), ahead.data(), velocity.data(), force.data()};
  }
  BodyArrays body_arrays() {
    return {mobility.data(), force.data(), first_a.data(), first_b.data(), b_force.data(), velocity.data()};
  }
};

constexpr float step = 0.44F;
constexpr float beta = 0.7F;

/// Contacts between random bodies, sorted by the first one: open, sticking and sliding ones.
Scene random_scene(Index groups, Index bodies) {
  Random random(7);
  const auto uniform = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
  Scene scene;
  scene.contacts.resize(groups);
  scene.increment.resize(groups);
  scene.ahead.resize(groups);
  scene.force.resize(groups);
  for (Index i = 0; i < bodies; ++i) {
    scene.velocity.push_back({uniform(), uniform(), uniform(), 0.0F});
    scene.mobility.push_back({1.0F + 0.2F * uniform(), -2.0F, 1.0F, 0.0F});
  }
  const Index count = groups * lane_count;
  std::vector<Index> a(count), b(count);
  for (Index c = 0; c < count; ++c) a[c] = static_cast<Index>(static_cast<long long>(c) * bodies / count);
  scene.first_a.assign(bodies + 1, 0);
  scene.first_b.assign(bodies + 1, 0);
  for (Index c = 0; c < count; ++c) {
    b[c] = static_cast<Index>(random.uniform() * bodies);
    ++scene.first_a[a[c] + 1];
    ++scene.first_b[b[c] + 1];
    ContactGroup& group = scene.contacts[c / lane_count];
    const int k = lane_of(c);
    const float angle = 3.0F * uniform();
    group.nx[k] = std::cos(angle);
    group.ny[k] = std::sin(angle);
    group.un[k] = uniform();
    group.ut[k] = uniform();
    group.pn[k] = std::max(0.0F, uniform());
    group.mu[k] = 0.5F;
    const float tangential = 0.5F * group.pn[k] * uniform();
    group.above[k] = 0.5F * group.pn[k] - tangential;
    group.below[k] = 0.5F * group.pn[k] + tangential;
    group.wn[k] = 0.5F;
    group.wt[k] = 0.17F;
    group.a[k] = static_cast<std::uint32_t>(a[c] * sizeof(Row));
    group.b[k] = static_cast<std::uint32_t>(b[c] * sizeof(Row));
    scene.increment[c / lane_count].n[k] = 0.1F * uniform();
    scene.increment[c / lane_count].t[k] = 0.1F * uniform();
    scene.ahead[c / lane_count].n[k] = 0.1F * uniform();
    scene.ahead[c / lane_count].t[k] = 0.1F * uniform();
  }
  for (Index i = 0; i < bodies; ++i) {
    scene.first_a[i + 1] += scene.first_a[i];
    scene.first_b[i + 1] += scene.first_b[i];
  }
  scene.b_force.resize(count);
  std::vector<Index> next(scene.first_b.begin(), scene.first_b.end() - 1);
  for (Index c = 0; c < count; ++c) scene.b_force[next[b[c]]++] = static_cast<std::uint32_t>(c * sizeof(Row));
  return scene;
}

/// Contacts, then bodies, some iterations long, in two shares each.
void run(Scene& scene, const GradientKernels& kernels) {
  for (int k = 0; k < 5; ++k) {
    const Index half = scene.groups() / 2;
    IterationSums first, second;
    kernels.contacts(scene.contact_arrays(), 0, half, step, beta, first);
    kernels.contacts(scene.contact_arrays(), half, scene.groups(), step, beta, second);
    scene.sums = {first.change + second.change, first.ascent + second.ascent};
    kernels.bodies(scene.body_arrays(), 0, scene.bodies() / 3);
    kernels.bodies(scene.body_arrays(), scene.bodies() / 3, scene.bodies());
  }
}

void plain_contact(const Scene& from, Scene& to, Index c, IterationSums& sums) {
  const ContactGroup& group = from.contacts[c / lane_count];
  const int k = lane_of(c);
  const Row& va = from.velocity[group.a[k] / sizeof(Row)];
  const Row& vb = from.velocity[group.b[k] / sizeof(Row)];
  const float nx = group.nx[k], ny = group.ny[k];
  const float un = (vb.x - va.x) * nx + (vb.y - va.y) * ny + group.un[k];
  const float ut = (vb.y - va.y) * nx - (vb.x - va.x) * ny - (vb.spin + va.spin) + group.ut[k];
  const float yn = from.ahead[c / lane_count].n[k], yt = from.ahead[c / lane_count].t[k];
  const float pn = std::max(yn - step * (un * group.wn[k]), -group.pn[k]);
  const float pt = std::clamp(yt - step * (ut * group.wt[k]), -(group.below[k] + group.mu[k] * pn),
                              group.above[k] + group.mu[k] * pn);
  ImpulseGroup& increment = to.increment[c / lane_count];
  const float dn = pn - increment.n[k], dt = pt - increment.t[k];
  sums.change += (yn - pn) * (yn - pn) + (yt - pt) * (yt - pt);
  sums.ascent += (yn - pn) * dn + (yt - pt) * dt;
  increment.n[k] = pn;
  increment.t[k] = pt;
  const float next_n = pn + beta * dn, next_t = pt + beta * dt;
  to.ahead[c / lane_count].n[k] = next_n;
  to.ahead[c / lane_count].t[k] = next_t;
  to.force_of(c) = {next_n * nx - next_t * ny, next_t, next_n * ny + next_t * nx, 0.0F};
}

template <class T>
bool same_bits(const std::vector<T>& x, const std::vector<T>& y) {
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(T)) == 0;
}

TEST(GradientKernels, give_the_same_bits_whatever_the_processor) {
  Scene baseline = random_scene(20, 40);
  Scene fastest = baseline;
  run(baseline, gradient_kernels_baseline());
  run(fastest, gradient_kernels());
  EXPECT_TRUE(same_bits(baseline.increment, fastest.increment));
  EXPECT_TRUE(same_bits(baseline.ahead, fastest.ahead));
  EXPECT_TRUE(same_bits(baseline.velocity, fastest.velocity));
  EXPECT_EQ(baseline.sums.change, fastest.sums.change);
  EXPECT_EQ(baseline.sums.ascent, fastest.sums.ascent);
}

TEST(GradientKernels, contacts_do_what_the_plain_arithmetic_does) {
  const Scene before = random_scene(20, 40);
  Scene scene = before;
  Scene plain = before;
  IterationSums sums;
  gradient_kernels().contacts(scene.contact_arrays(), 0, scene.groups(), step, beta, scene.sums);
  for (Index c = 0; c < scene.groups() * lane_count; ++c) plain_contact(before, plain, c, sums);
  int open = 0, sliding = 0;
  for (Index g = 0; g < scene.groups(); ++g)
    for (int k = 0; k < lane_count; ++k) {
      const ImpulseGroup &got = scene.increment[g], &expected = plain.increment[g];
      EXPECT_EQ(got.n[k], expected.n[k]);
      EXPECT_EQ(got.t[k], expected.t[k]);
      EXPECT_EQ(scene.ahead[g].n[k], plain.ahead[g].n[k]);
      EXPECT_EQ(scene.ahead[g].t[k], plain.ahead[g].t[k]);
      const ContactGroup& contact = scene.contacts[g];
      open += got.n[k] == -contact.pn[k] ? 1 : 0;
      sliding += got.t[k] == contact.above[k] + contact.mu[k] * got.n[k] ? 1 : 0;
    }
  EXPECT_GT(open, 10);
  EXPECT_GT(sliding, 10);
  for (Index c = 0; c < scene.groups() * lane_count; ++c) {
    EXPECT_EQ(scene.force_of(c).x, plain.force_of(c).x);
    EXPECT_EQ(scene.force_of(c).y, plain.force_of(c).y);
    EXPECT_EQ(scene.force_of(c).spin, plain.force_of(c).spin);
  }
  EXPECT_NEAR(scene.sums.change, sums.change, 1e-5 * sums.change);
  EXPECT_NEAR(scene.sums.ascent, sums.ascent, 1e-5 * sums.change);
}

TEST(GradientKernels, bodies_sum_the_forces_of_their_contacts) {
  Scene scene = random_scene(20, 40);
  gradient_kernels().contacts(scene.contact_arrays(), 0, scene.groups(), step, beta, scene.sums);
  std::vector<double> x(scene.bodies(), 0.0), y(x), spin(x);
  for (Index c = 0; c < scene.groups() * lane_count; ++c) {
    const ContactGroup& group = scene.contacts[c / lane_count];
    const std::size_t a = group.a[lane_of(c)] / sizeof(Row), b = group.b[lane_of(c)] / sizeof(Row);
    x[a] -= scene.force_of(c).x;
    y[a] -= scene.force_of(c).y;
    x[b] += scene.force_of(c).x;
    y[b] += scene.force_of(c).y;
    spin[a] += scene.force_of(c).spin;
    spin[b] += scene.force_of(c).spin;
  }
  gradient_kernels().bodies(scene.body_arrays(), 0, scene.bodies());
  for (Index i = 0; i < scene.bodies(); ++i) {
    const Row& mobility = scene.mobility[i];
    EXPECT_NEAR(scene.velocity[i].x, mobility.x * x[i], 1e-5);
    EXPECT_NEAR(scene.velocity[i].y, mobility.y * y[i], 1e-5);
    EXPECT_NEAR(scene.velocity[i].spin, mobility.spin * spin[i], 1e-5);
  }
}

}  // namespace
}  // namespace talus
