/// 16-bit numbers deviate from the originals by at most half a quantum.

#include <gtest/gtest.h>

#include <cmath>

#include "exports/page/tables.h"

namespace talus::exports {
namespace {

TEST(Quantised, is_within_half_a_step) {
  const Quantum quantum{-2.0, 0.001};
  for (int k = 0; k < 5000; ++k) {
    const double value = -2.0 + 0.0131 * k;
    EXPECT_NEAR(value_of(quantum, code_of(quantum, value)), value, 0.0005 + 1e-12);
  }
}

TEST(Quantised, of_a_logarithmic_scale_is_within_half_a_step_of_its_logarithm) {
  const Quantum quantum{1e-7, 0.02, true};
  for (double value = 1.01e-7; value < 1e3; value *= 1.37)
    EXPECT_NEAR(std::log(value_of(quantum, code_of(quantum, value)) / value), 0.0, 0.01 + 1e-12) << value;
  EXPECT_EQ(code_of(quantum, 0.0), 0U);
  EXPECT_EQ(code_of(quantum, 1e-8), 0U);
}

TEST(Quantised, keeps_no_value_and_stops_at_the_ends) {
  const Quantum quantum{0.0, 0.5};
  EXPECT_EQ(code_of(quantum, std::nan("")), no_code);
  EXPECT_TRUE(std::isnan(value_of(quantum, no_code)));
  EXPECT_EQ(code_of(quantum, -3.0), 0U);
  EXPECT_EQ(code_of(quantum, 1e9), 65534U);
  EXPECT_EQ(code_of(quantum, INFINITY), 65534U);
}

TEST(Quantised, places_go_on_around_a_period) {
  const double period = 200.0;
  const PlaceQuantum quantum = places_of_period(period);
  for (double x = 0.0; x < period; x += 0.377)
    EXPECT_NEAR(quantum.low + quantum.step * place_code(quantum, x), x, 0.5 * quantum.step + 1e-12);
  EXPECT_EQ(place_code(quantum, period), 0U);
  EXPECT_EQ(place_code(quantum, -quantum.step), 65535U);
}

TEST(Quantised, places_of_a_box_have_both_ends) {
  const PlaceQuantum quantum = places_of_box(-1.0, 41.5);
  EXPECT_EQ(place_code(quantum, -1.0), 0U);
  EXPECT_EQ(place_code(quantum, 41.5), 65535U);
  for (double y = -1.0; y < 41.5; y += 0.177)
    EXPECT_NEAR(quantum.low + quantum.step * place_code(quantum, y), y, 0.5 * quantum.step + 1e-12);
  EXPECT_EQ(place_code(places_of_box(3.0, 3.0), 3.0), 0U) << "a box of zero height";
}

}  // namespace
}  // namespace talus::exports
