/// Table of the paper's values: complete, in order, and as printed.

#include "studies/paper_values.h"

#include <gtest/gtest.h>

namespace talus::studies {
namespace {

TEST(PaperValues, have_a_row_for_each_quantity_in_order) {
  for (std::size_t q = 0; q < quantity_count; ++q)
    EXPECT_EQ(static_cast<std::size_t>(paper_values[q].quantity), q) << paper_values[q].name;
}

TEST(PaperValues, are_in_three_parts) {
  EXPECT_EQ(packing_values().size() + chain_values().size() + wall_values().size() + 1, quantity_count)
      << "and the coefficient of the walls";
  EXPECT_EQ(chain_values().front().quantity, PaperQuantity::overloaded_at_0);
  EXPECT_EQ(chain_values().back().quantity, PaperQuantity::theta_d_by_dilation);
}

TEST(PaperValues, are_read_from_quantities_of_the_table) {
  for (const PaperValue& paper : paper_values)
    EXPECT_NO_THROW(analysis::quantity_of(paper.source)) << paper.name;
}

TEST(PaperValues, that_are_equal_to_something_have_an_accuracy) {
  for (const PaperValue& paper : paper_values) {
    const bool derived = paper.quantity == PaperQuantity::shear_over_tangent_of_walls;
    if (paper.relation == Relation::equals && !derived) {
      EXPECT_GT(paper.accuracy, 0.0) << paper.name;
    }
  }
}

TEST(PaperValues, of_the_walls_are_those_of_equation_15) {
  EXPECT_NEAR(paper_wall_ratio(40.0 / 100.0), 0.667, 5e-4);
  EXPECT_NEAR(paper_wall_ratio(40.0 / 300.0), 0.889, 5e-4);
  const PaperValue at_100 = paper_value_of_walls(PaperQuantity::shear_over_tangent_of_walls, 0.4);
  EXPECT_DOUBLE_EQ(at_100.value, paper_wall_ratio(0.4));
  EXPECT_NEAR(at_100.accuracy, 0.0333, 1e-4) << "k_L - k_0 is known to 0.25";
  EXPECT_DOUBLE_EQ(paper_value_of_walls(PaperQuantity::theta_c_of_walls, 0.4).value, 20.0);
}

}  // namespace
}  // namespace talus::studies
