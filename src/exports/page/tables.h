#pragma once
/// Numbers of a page as codes of 16 bits, and tables of codes as short texts.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace talus::exports {

/// The mapping from numbers to codes: linear from `low` or, if `logarithmic`, low * exp(step * code).
struct Quantum {
  double low = 0.0;
  double step = 1.0;  ///< positive
  bool logarithmic = false;
};

/// The code of a missing number.
inline constexpr std::uint32_t no_code = 65535;

/// Returns the nearest code, clamped to the ends of the range; the highest is 65534. NaN gives no_code. On a
/// logarithmic scale, everything up to `low` gives code 0.
std::uint32_t code_of(const Quantum& quantum, double value);

/// Return the quantum of positions, which are never missing: along a period, with 65536 steps, or in a box
/// from low to high, with 65535 steps so that both ends have a code.
Quantum places_of_period(double period);
Quantum places_of_box(double low, double high);
/// Returns the code of a position; codes wrap around a period.
std::uint32_t place_code(const Quantum& places, double place);

/// Returns the code of a force, 1 to 255; 0 means no contact. Forces are stored up to the value at which
/// lines reach their largest width, in steps of their square root.
std::uint32_t force_code(double force_over_mean);

/// One row for each grain or contact, one column for each frame. The numbers are below 256^bytes.
struct CodeTable {
  std::size_t rows = 0, columns = 0;
  int bytes = 2;                     ///< per number, 1 to 4
  std::vector<std::uint32_t> codes;  ///< row by row

  std::uint32_t& at(std::size_t row, std::size_t column) { return codes[row * columns + column]; }
  std::uint32_t at(std::size_t row, std::size_t column) const { return codes[row * columns + column]; }
};

/// Returns a table filled with `code`.
CodeTable code_table(std::size_t rows, std::size_t columns, int bytes = 2, std::uint32_t code = 0);

/// Returns the differences from column to column (in the first column from row to row) modulo 256^bytes:
/// first the lowest byte of all of them, then the next one. Slowly varying data then become runs of zeros.
std::vector<std::byte> difference_bytes(const CodeTable& table);

/// Returns these bytes as base64 of a zlib stream (RFC 1950), which a browser decompresses with
/// DecompressionStream("deflate"). The text depends only on the table and zlib.
std::string packed_text(const CodeTable& table);

}  // namespace talus::exports
