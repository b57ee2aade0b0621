/// Tables are restored exactly.

#include <gtest/gtest.h>

#include "exports/page/tables.h"
#include "unit/exports/unpacked.h"

namespace talus::exports {
namespace {

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
