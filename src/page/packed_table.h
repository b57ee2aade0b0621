#pragma once
/// Whole numbers in rows and columns as a short text: how a page holds what changes from frame to frame.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace talus {

/// One row for each grain or contact, one column for each frame. The numbers are below 256^bytes.
struct CodeTable {
  std::size_t rows = 0, columns = 0;
  int bytes = 2;                     ///< of each number, 1 to 4
  std::vector<std::uint32_t> codes;  ///< row by row

  std::uint32_t& at(std::size_t row, std::size_t column) { return codes[row * columns + column]; }
  std::uint32_t at(std::size_t row, std::size_t column) const { return codes[row * columns + column]; }
};

/// Full of `code`.
CodeTable code_table(std::size_t rows, std::size_t columns, int bytes, std::uint32_t code = 0);

/// The differences from column to column (in the first column from row to row) modulo 256^bytes, first the
/// lowest byte of all of them, then the next one: what hardly changes becomes runs of zeros.
std::vector<std::byte> difference_bytes(const CodeTable& table);

/// These bytes deflated, as base64.
std::string packed_text(const CodeTable& table);

}  // namespace talus
