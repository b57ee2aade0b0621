/// Properties of a grain, checked with forces given by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/overload/clusters.h"
#include "unit/analysis/packings.h"
#include "view/selection.h"

namespace talus::view {
namespace {

/// Returns the packing with all data of a run's frame.
test::Packing whole(test::Packing packing) {
  Frame& frame = packing.frame;
  frame.angle = frame.vx = frame.vy = std::vector(frame.x.size(), 0.0);
  packing.statics.mass.assign(frame.x.size(), 3.0);
  return packing;
}

analysis::Clusters clusters_of(const test::Packing& packing, double threshold) {
  std::vector<bool> overloaded;
  for (Index i = 0; i < packing.statics.free_count; ++i)
    overloaded.push_back(packing.frame.gamma[i] >= threshold);
  return analysis::find_clusters(overloaded, analysis::force_links(packing), packing.frame.x,
                                 packing.statics.periodic ? packing.statics.length : 0.0);
}

/// Returns grain 1 with grain 0 to its left, a floor grain below it, and the right wall next to it.
test::Packing corner() {
  test::Packing packing = test::empty_packing(2.0, false);
  test::add_grain(packing, 0.5, 0.5);
  test::add_grain(packing, 1.5, 0.5);
  test::add_floor_grain(packing, 1.5, -0.5);
  test::add_contact(packing, 0, 1, 4.0, 1.0);
  test::add_contact(packing, 1, 2, 6.0, -3.0);
  test::moments_from_contacts(packing);
  packing = whole(packing);
  test::add_contact(packing, 1, 3 + 1, 4.0, 0.5);  // second plane
  return packing;
}

/// Returns a rule for single grains.
analysis::CoarseGrainingRule rule_of(double threshold, double cut) {
  return {.threshold = threshold, .end_ratio = threshold, .l_min = 0.0, .cut = cut};
}

TEST(Inspection, has_the_contacts_of_the_grain_seen_from_it) {
  const test::Packing packing = corner();
  const Inspection inspection = inspect(packing, clusters_of(packing, 2.0), rule_of(2.0, 1.0), 1.0, 1);
  ASSERT_EQ(inspection.contacts.size(), 3u);
  const GrainContact& left = inspection.contacts[0];
  EXPECT_EQ(left.other_name, "grain 0");
  EXPECT_EQ(left.fn, 4.0);
  EXPECT_EQ(left.ft, 1.0);
  const GrainContact& below = inspection.contacts[1];
  EXPECT_EQ(below.other_name, "floor grain 2");
  EXPECT_EQ(below.ft, -3.0);
  EXPECT_EQ(below.status, ContactStatus::sliding);
  EXPECT_EQ(inspection.contacts[2].other_name, "right wall");
}

TEST(Inspection, names_planes_by_where_they_are) {
  test::Packing packing = corner();
  packing.frame.contacts.nx.back() = -1.0;
  const auto name = [&packing] {
    return inspect(packing, clusters_of(packing, 2.0), rule_of(2.0, 1.0), 1.0, 1).contacts.back().other_name;
  };
  EXPECT_EQ(name(), "left wall");
  packing.frame.contacts.nx.back() = 0.0;
  packing.frame.contacts.ny.back() = -1.0;
  EXPECT_EQ(name(), "floor");
}

TEST(Inspection, of_a_pressed_grain_has_its_stress) {
  // Pressed with 4 N along x and 1 N along y at radius 1/2: moments 4 J and 1 J, gamma = 3/5.
  test::Packing packing = test::empty_packing(10.0, false);
  test::add_grain(packing, 5.0, 2.0);
  for (const auto& [x, y, fn] :
       {std::array{4.0, 2.0, 4.0}, {6.0, 2.0, 4.0}, {5.0, 1.0, 1.0}, {5.0, 3.0, 1.0}}) {
    const Index other = test::add_grain(packing, x, y);
    test::add_contact(packing, 0, other, fn);
  }
  test::moments_from_contacts(packing);
  packing = whole(packing);
  const Inspection inspection = inspect(packing, clusters_of(packing, 0.5), rule_of(0.5, 5.0), 0.0, 0);
  EXPECT_NEAR(inspection.state.ratio, 0.6, 1e-15);
  EXPECT_NEAR(inspection.gamma, 0.6, 1e-15);
  EXPECT_NEAR(inspection.state.axis, 0.0, 1e-15);
  EXPECT_TRUE(inspection.overloaded);
  EXPECT_EQ(inspection.cluster, 0);
  EXPECT_EQ(inspection.cluster_size, 5);  // all of them carry force along one line
  EXPECT_NEAR(inspection.neighbourhood_gamma, 0.6, 1e-15) << "the grain alone";
  // Its neighbours add twice 2 J along x and twice 1/2 J along y: 8 to 2, still 3/5; it never falls below
  // 1/2.
  ASSERT_EQ(inspection.curve.l.size(), 2u);
  EXPECT_EQ(inspection.curve.l[1], 2.0);
  EXPECT_NEAR(inspection.curve.gamma[1], 0.6, 1e-15);
  EXPECT_EQ(inspection.coarse_graining_length, 5.0) << "the cut-off";
}

TEST(Inspection, of_a_grain_that_is_not_overloaded_has_no_length) {
  const test::Packing packing = whole(test::random_packing(1, 50, 10.0, 6.0, true));
  const Inspection inspection = inspect(packing, clusters_of(packing, 1.5), rule_of(1.5, 3.0), 3.0, 4);
  EXPECT_FALSE(inspection.overloaded);
  EXPECT_FALSE(inspection.coarse_graining_length.has_value());
  EXPECT_EQ(inspection.cluster, -1);
}

TEST(Inspection, agrees_with_coarse_graining_of_the_whole_bed) {
  constexpr double wide = 7.0;
  for (const double l_min : {0.0, 3.0}) {
    const double threshold = l_min > 0.0 ? 0.2 : 0.4, cut = l_min > 0.0 ? 4.0 : 2.5;
    test::Packing packing = whole(test::random_packing(2, 150, 20.0, 8.0, true));
    packing.frame = analysis::with_gamma_of_neighbourhoods(packing.frame, packing.statics, l_min);
    const analysis::CoarseGrainingRule rule = {
        .threshold = threshold, .end_ratio = threshold, .l_min = l_min, .cut = cut};
    const analysis::CoarseGraining all = analysis::coarse_graining(packing, rule);
    const std::vector<double> gamma = analysis::coarse_stress_ratio(packing, wide);
    const analysis::Clusters clusters = clusters_of(packing, threshold);
    ASSERT_GT(all.cut_off, 5);
    ASSERT_GT(all.overloaded - all.cut_off, 5);
    for (Index i = 0; i < packing.statics.free_count; ++i) {
      const Inspection inspection = inspect(packing, clusters, rule, wide, i);
      EXPECT_EQ(inspection.coarse_graining_length.has_value(), !std::isnan(all.length[i]));
      if (inspection.coarse_graining_length) {
        EXPECT_EQ(*inspection.coarse_graining_length, all.length[i]) << "grain " << i;
      }
      EXPECT_EQ(inspection.neighbourhood_gamma, gamma[i]);
      EXPECT_EQ(inspection.gamma, packing.frame.gamma[i]);
      EXPECT_EQ(inspection.state.ratio, stress::stress_state(packing.frame.internal_moment[i]).ratio)
          << "of the grain alone";
    }
  }
}

TEST(Inspection, of_a_floor_grain_has_contacts_only) {
  const test::Packing packing = corner();
  const Inspection inspection = inspect(packing, clusters_of(packing, 0.1), rule_of(0.1, 1.0), 1.0, 2);
  EXPECT_FALSE(inspection.free);
  ASSERT_EQ(inspection.contacts.size(), 1u);
  EXPECT_TRUE(inspection.curve.l.empty());
  EXPECT_FALSE(inspection.coarse_graining_length.has_value());
}

TEST(GrainAt, is_the_grain_whose_disc_holds_the_place) {
  const test::Packing packing = corner();
  EXPECT_EQ(find_grain(packing, 0.1, 0.5), 0);
  EXPECT_EQ(find_grain(packing, 1.1, 0.5), 1);
  EXPECT_EQ(find_grain(packing, 1.5, -0.7), 2);
  EXPECT_EQ(find_grain(packing, 0.4, 1.9), 0) << "within a D of its edge";
  EXPECT_FALSE(find_grain(packing, 0.5, 2.1).has_value());
}

TEST(GrainAt, looks_through_the_periodic_edge) {
  test::Packing packing = test::empty_packing(10.0, true);
  test::add_grain(packing, 0.2, 0.5);
  test::add_grain(packing, 5.0, 0.5);
  EXPECT_EQ(find_grain(packing, 9.9, 0.5), 0);
  EXPECT_EQ(find_grain(packing, 20.3, 0.5), 0);
  packing.statics.periodic = false;
  EXPECT_FALSE(find_grain(packing, 9.9, 0.5).has_value());
}

TEST(GrainAt, prefers_a_disc_to_a_near_centre) {
  test::Packing packing = test::empty_packing(10.0, false);
  test::add_grain(packing, 2.0, 2.0, 2.0);
  test::add_grain(packing, 4.6, 2.0, 0.5);
  EXPECT_EQ(find_grain(packing, 3.9, 2.0), 0);
}

}  // namespace
}  // namespace talus::view
