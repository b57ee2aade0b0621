#include "page/packed_table.h"

#include "core/base64.h"
#include "page/deflated.h"

namespace talus {

CodeTable code_table(std::size_t rows, std::size_t columns, int bytes, std::uint32_t code) {
  return {rows, columns, bytes, std::vector<std::uint32_t>(rows * columns, code)};
}

std::vector<std::byte> difference_bytes(const CodeTable& table) {
  std::vector<std::uint32_t> differences(table.codes.size());
  for (std::size_t row = 0; row < table.rows; ++row)
    for (std::size_t column = 0; column < table.columns; ++column) {
      const std::uint32_t above = row > 0 ? table.at(row - 1, 0) : 0;
      const std::uint32_t before = column > 0 ? table.at(row, column - 1) : above;
      differences[row * table.columns + column] = table.at(row, column) - before;
    }
  std::vector<std::byte> bytes;
  bytes.reserve(differences.size() * static_cast<std::size_t>(table.bytes));
  for (int plane = 0; plane < table.bytes; ++plane)
    for (const std::uint32_t difference : differences)
      bytes.push_back(static_cast<std::byte>(difference >> 8 * plane & 255U));
  return bytes;
}

std::string packed_text(const CodeTable& table) { return base64(deflated(difference_bytes(table))); }

}  // namespace talus
