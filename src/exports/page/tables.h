#pragma once
/// What changes from frame to frame as a page holds it: numbers in 16 bits, tables of them as short texts,
/// and texts of which each is kept once.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace talus::exports {

/// How a number becomes a code: evenly from `low` on, or, `logarithmic`, as low * exp(step * code).
struct Quantum {
  double low = 0.0;
  double step = 1.0;  ///< above 0
  bool logarithmic = false;
};

/// The code of a number that there is none of.
inline constexpr std::uint32_t no_code = 65535;

/// The nearest code; beyond the ends that of the end, which is 65534 at the top. NaN is no_code, and on a
/// logarithmic scale all that is not above `low` has code 0.
std::uint32_t code_of(const Quantum& quantum, double value);

/// What it stands for, half a quantum from the number at most; NaN for no_code.
double value_of(const Quantum& quantum, std::uint32_t code);

/// Places along a line, which have no gaps: all 65536 codes, and around a period they go on from the first.
struct PlaceQuantum {
  double low = 0.0, step = 1.0;
};
/// Of a period: 65536 steps. Of a box from low to high: 65535, so that both ends have a code.
PlaceQuantum places_of_period(double period);
PlaceQuantum places_of_box(double low, double high);
std::uint32_t place_code(const PlaceQuantum& quantum, double place);

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

/// The bytes as a zlib stream (RFC 1950), which a browser undoes by DecompressionStream("deflate"). The same
/// for the same bytes and the same version of zlib. Throws std::bad_alloc.
std::vector<std::byte> deflated(std::span<const std::byte> bytes);

/// Texts of frames, most of which are the same: each is kept once.
class Distinct {
 public:
  void add(const std::string& text);
  /// {"kinds": [...], "of": [place of that of each frame]}; the texts are JSON already.
  std::string json() const;

 private:
  std::vector<std::string> texts_;
  std::vector<int> places_;
};

}  // namespace talus::exports
