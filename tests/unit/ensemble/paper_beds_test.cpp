/// The paper's beds, and smaller ones of the same shape.

#include "ensemble/paper_beds.h"

#include <gtest/gtest.h>

#include <map>

namespace talus::ensemble {
namespace {

TEST(PaperBeds, are_periodic_in_three_preparations_and_between_walls) {
  const std::vector<Variant> beds = paper_beds(false);
  ASSERT_EQ(beds.size(), 8u);
  const scenario::DepositionMethod methods[] = {scenario::DepositionMethod::pour,
                                                scenario::DepositionMethod::geometric,
                                                scenario::DepositionMethod::collapse};
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(beds[b].scenario.bed.boundary, scenario::BedBoundary::periodic);
    EXPECT_EQ(beds[b].scenario.deposition.method, methods[b]);
    EXPECT_EQ(beds[b].scenario.bed.length, 200.0);
  }
  for (std::size_t b = 3; b < 8; ++b) {
    EXPECT_EQ(beds[b].scenario.bed.boundary, scenario::BedBoundary::walls);
    EXPECT_EQ(beds[b].scenario.bed.length, 100.0 + 50.0 * static_cast<double>(b - 3));
    EXPECT_EQ(beds[b].scenario.bed.depth, 40.0);
  }
}

TEST(PaperBeds, keep_depth_over_length_for_a_quick_look) {
  const std::vector<Variant> full = paper_beds(false), quick = paper_beds(true);
  for (std::size_t b = 0; b < full.size(); ++b) {
    EXPECT_DOUBLE_EQ(quick[b].scenario.bed.depth / quick[b].scenario.bed.length,
                     full[b].scenario.bed.depth / full[b].scenario.bed.length);
    EXPECT_EQ(quick[b].scenario.bed.depth, 20.0);
  }
  EXPECT_EQ(quick[3].name, "wbc-50");
}

TEST(PaperBeds, have_a_name_of_their_own) {
  std::map<std::string, int> names;
  for (const Variant& bed : paper_beds(false)) ++names[bed.name];
  EXPECT_EQ(names.size(), 8u);
}

}  // namespace
}  // namespace talus::ensemble
