/// Numbers of a page as codes, and tables of codes, which are restored exactly.

#include "exports/page/tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/exports/unpacked.h"

namespace talus::exports {
namespace {

/// The number of a code, as the page decodes it (run.js).
double value_of(const Quantum& quantum, std::uint32_t code) {
  if (code == no_code) return std::nan("");
  return quantum.logarithmic ? quantum.low * std::exp(quantum.step * code)
                             : quantum.low + quantum.step * code;
}

/// The force of a code, as the page decodes it (looks.js).
double force_of(std::uint32_t code) { return 6.0 * (code - 1.0) / 254.0 * (code - 1.0) / 254.0; }

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
  const Quantum quantum = places_of_period(period);
  for (double x = 0.0; x < period; x += 0.377)
    EXPECT_NEAR(quantum.low + quantum.step * place_code(quantum, x), x, 0.5 * quantum.step + 1e-12);
  EXPECT_EQ(place_code(quantum, period), 0U);
  EXPECT_EQ(place_code(quantum, -quantum.step), 65535U);
}

TEST(Quantised, places_of_a_box_have_both_ends) {
  const Quantum quantum = places_of_box(-1.0, 41.5);
  EXPECT_EQ(place_code(quantum, -1.0), 0U);
  EXPECT_EQ(place_code(quantum, 41.5), 65535U);
  for (double y = -1.0; y < 41.5; y += 0.177)
    EXPECT_NEAR(quantum.low + quantum.step * place_code(quantum, y), y, 0.5 * quantum.step + 1e-12);
  EXPECT_EQ(place_code(places_of_box(3.0, 3.0), 3.0), 0U) << "a box of zero height";
}

TEST(ForceCode, is_within_two_percent_of_the_mean_force) {
  for (double force = 0.0; force < 6.0; force += 0.0037) {
    const double back = force_of(force_code(force));
    EXPECT_NEAR(std::sqrt(back), std::sqrt(force), 0.5 * std::sqrt(6.0) / 254.0 + 1e-9) << force;
    if (force > 0.5) {
      EXPECT_NEAR(back / force, 1.0, 0.02) << force;
    }
  }
}

TEST(ForceCode, of_a_contact_is_never_that_of_none) {
  EXPECT_EQ(force_code(0.0), 1U);
  EXPECT_EQ(force_code(1e-9), 1U);
  EXPECT_EQ(force_code(6.0), 255U);
  EXPECT_EQ(force_code(60.0), 255U) << "the width of lines is limited";
}

/// Returns codes that are neither regular nor small, so that all bytes are used.
CodeTable some_table(std::size_t rows, std::size_t columns, int bytes) {
  CodeTable table = code_table(rows, columns, bytes);
  std::uint32_t state = 12345;
  for (std::uint32_t& code : table.codes) {
    state = state * 1664525U + 1013904223U;
    code = bytes == 4 ? state : state >> (32 - 8 * bytes);
  }
  return table;
}

TEST(PackedTable, comes_back_as_it_was) {
  for (int bytes = 1; bytes <= 4; ++bytes)
    for (const auto& [rows, columns] : {std::pair{1U, 1U}, {7U, 1U}, {1U, 9U}, {40U, 31U}}) {
      const CodeTable table = some_table(rows, columns, bytes);
      EXPECT_EQ(test::unpacked(packed_text(table), rows, columns, bytes), table.codes) << bytes << " bytes";
    }
}

TEST(PackedTable, is_differences_byte_by_byte) {
  CodeTable table = code_table(2, 2, 2);
  table.codes = {300, 299, 301, 301};
  // Differences 300 = 0x012c, -1 = 0xffff, 1, 0, with low bytes first.
  const std::vector<unsigned> expected = {0x2c, 0xff, 1, 0, 1, 0xff, 0, 0};
  const std::vector<std::byte> bytes = difference_bytes(table);
  ASSERT_EQ(bytes.size(), expected.size());
  for (std::size_t k = 0; k < bytes.size(); ++k)
    EXPECT_EQ(std::to_integer<unsigned>(bytes[k]), expected[k]) << k;
}

TEST(PackedTable, of_what_hardly_moves_is_small) {
  CodeTable table = code_table(1000, 50, 2);
  for (std::size_t row = 0; row < table.rows; ++row)
    for (std::size_t column = 0; column < table.columns; ++column)
      table.at(row, column) = static_cast<std::uint32_t>(row * 7919 % 65536 + (column > 25 ? 1 : 0));
  EXPECT_LT(packed_text(table).size(), 6000U) << "of 100 000 bytes";
}

TEST(PackedTable, is_a_zlib_stream) {
  const auto bytes = test::bytes_of_base64(packed_text(some_table(3, 3, 1)));
  ASSERT_GE(bytes.size(), 2U);
  EXPECT_EQ(bytes[0] & 0x0F, 8) << "deflate";
  EXPECT_EQ((bytes[0] * 256 + bytes[1]) % 31, 0) << "RFC 1950";
}

}  // namespace
}  // namespace talus::exports
