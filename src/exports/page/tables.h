#pragma once
/// The varying data of a page: numbers in 16 bits, tables of them as short texts, and texts that are stored
/// only once.

#include <cstddef>
#include <cstdint>
#include <span>
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

/// Returns the number of a code, within half a step of the original; NaN for no_code.
double value_of(const Quantum& quantum, std::uint32_t code);

/// Positions along a line, which are never missing: all 65536 codes are used, and wrap around a period.
struct PlaceQuantum {
  double low = 0.0, step = 1.0;
};
/// Return the quantum of a period, with 65536 steps, or of a box from low to high, with 65535 steps so that
/// both ends have a code.
PlaceQuantum places_of_period(double period);
PlaceQuantum places_of_box(double low, double high);
std::uint32_t place_code(const PlaceQuantum& quantum, double place);

/// One row for each grain or contact, one column for each frame. The numbers are below 256^bytes.
struct CodeTable {
  std::size_t rows = 0, columns = 0;
  int bytes = 2;                     ///< per number, 1 to 4
  std::vector<std::uint32_t> codes;  ///< row by row

  std::uint32_t& at(std::size_t row, std::size_t column) { return codes[row * columns + column]; }
  std::uint32_t at(std::size_t row, std::size_t column) const { return codes[row * columns + column]; }
};

/// Returns a table filled with `code`.
CodeTable code_table(std::size_t rows, std::size_t columns, int bytes, std::uint32_t code = 0);

/// Returns the differences from column to column (in the first column from row to row) modulo 256^bytes:
/// first the lowest byte of all of them, then the next one. Slowly varying data then become runs of zeros.
std::vector<std::byte> difference_bytes(const CodeTable& table);

/// Returns these bytes deflated, as base64.
std::string packed_text(const CodeTable& table);

/// Compresses the bytes to a zlib stream (RFC 1950), which a browser decompresses with
/// DecompressionStream("deflate"). The result depends only on the bytes and the version of zlib. Throws
/// std::bad_alloc.
std::vector<std::byte> deflated(std::span<const std::byte> bytes);

/// Texts of frames, most of which are equal; each distinct text is stored once.
class DistinctTexts {
 public:
  void add(const std::string& text);
  /// Returns {"kinds": [...], "of": [index of each frame's text]}; the texts are already JSON.
  std::string json() const;

 private:
  std::vector<std::string> texts_;
  std::vector<int> places_;
};

}  // namespace talus::exports
