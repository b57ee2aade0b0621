#include "exports/page/tables.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "base/text.h"
#include "pictures/layers.h"

namespace talus::exports {
namespace {

constexpr double last_code = 65534.0;
constexpr double force_steps = 254.0;

std::vector<std::byte> deflated(const std::vector<std::byte>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::byte> result(size);
  // zlib has its own byte type. Its best compression takes ten times as long, for 4 % fewer bytes.
  const int state =
      compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  if (state != Z_OK)
    throw std::bad_alloc();  // the only other error of compress2 is a buffer that is too small
  result.resize(size);
  return result;
}

}  // namespace

std::uint32_t code_of(const Quantum& quantum, double value) {
  if (std::isnan(value)) return no_code;
  if (quantum.logarithmic && !(value > quantum.low)) return 0;
  const double place = quantum.logarithmic ? std::log(value / quantum.low) / quantum.step
                                           : (value - quantum.low) / quantum.step;
  return static_cast<std::uint32_t>(std::lround(std::clamp(place, 0.0, last_code)));
}

Quantum places_of_period(double period) { return {0.0, period / 65536.0}; }

Quantum places_of_box(double low, double high) { return {low, high > low ? (high - low) / 65535.0 : 1.0}; }

std::uint32_t place_code(const Quantum& places, double place) {
  return static_cast<std::uint32_t>(std::llround((place - places.low) / places.step)) & 65535U;
}

std::uint32_t force_code(double force_over_mean) {
  const double share = std::sqrt(std::clamp(force_over_mean / pictures::force_lines.widest, 0.0, 1.0));
  return 1U + static_cast<std::uint32_t>(std::lround(force_steps * share));
}

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

}  // namespace talus::exports
