#pragma once
/// One table of fields for both directions: a record names its data sets once, in the order of the file, and
/// the table is given a FieldWriter or a FieldReader. Private to this room.

#include <string>
#include <type_traits>
#include <vector>

#include "core/types.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"

namespace talus {

/// Records of several numbers per item: { {x0, y0}, {x1, y1}, ... } in one array, and one component of it
/// back.
template <typename T>
std::vector<T> interleaved(const std::vector<T>& x, const std::vector<T>& y) {
  std::vector<T> pairs(2 * x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    pairs[2 * i] = x[i];
    pairs[2 * i + 1] = y[i];
  }
  return pairs;
}
template <typename T>
std::vector<T> component(const std::vector<T>& records, std::size_t width, std::size_t which) {
  std::vector<T> values(records.size() / width);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = records[i * width + which];
  return values;
}

/// What the doubles of a data set can be; all of them are finite.
struct Range {
  double low = -hdf5::Reader::infinity, high = hdf5::Reader::infinity;
};
inline constexpr Range not_negative = {0.0, hdf5::Reader::infinity};

/// The type in which a value is stored: truths and kinds as int8.
template <typename T>
using Stored = std::conditional_t<std::is_enum_v<T> || std::is_same_v<T, bool>, std::int8_t, T>;

class FieldWriter {
 public:
  explicit FieldWriter(hdf5::Writer& writer) : writer_(writer) {}

  template <typename T>
  void scalar(const std::string& path, const T& value, Range = {}) {
    writer_.write_scalar(path, static_cast<Stored<T>>(value));
  }
  void two(const std::string& path, double first, double second, Range = {}) {
    writer_.write(path, std::vector{first, second});
  }
  template <typename T>
  void array(const std::string& path, const std::vector<T>& values, Range = {}) {
    writer_.write(path, values);
  }
  /// An array that is there only where it holds something.
  void array_if_any(const std::string& path, const std::vector<double>& values) {
    if (!values.empty()) writer_.write(path, values);
  }
  /// Two arrays as one of pairs.
  template <typename T>
  void pairs(const std::string& path, const std::vector<T>& x, const std::vector<T>& y, Range = {}) {
    writer_.write(path, interleaved(x, y));
  }
  /// One member of each row.
  template <typename Row, typename T>
  void column(const std::string& path, const std::vector<Row>& rows, T Row::*member, Range = {}) {
    std::vector<Stored<T>> values;
    for (const Row& row : rows) values.push_back(static_cast<Stored<T>>(row.*member));
    writer_.write(path, values);
  }
  template <typename Row>
  void column(const std::string& path, const std::vector<Row>& rows, Vec2 Row::*member, Range = {}) {
    std::vector<double> values;
    for (const Row& row : rows) values.insert(values.end(), {(row.*member).x, (row.*member).y});
    writer_.write(path, values);
  }

 private:
  hdf5::Writer& writer_;
};

class FieldReader {
 public:
  explicit FieldReader(hdf5::Reader& reader) : reader_(reader) {}

  template <typename T>
  void scalar(const std::string& path, T& value, Range range = {}) {
    value = static_cast<T>(values<Stored<T>>(path, range).at(0));
  }
  void two(const std::string& path, double& first, double& second, Range range = {}) {
    const std::vector<double> both = values<double>(path, range);
    first = both.at(0);
    second = both.at(1);
  }
  template <typename T>
  void array(const std::string& path, std::vector<T>& to, Range range = {}) {
    to = values<T>(path, range);
  }
  void array_if_any(const std::string& path, std::vector<double>& to) {
    if (reader_.has(path)) to = values<double>(path, {});
  }
  template <typename T>
  void pairs(const std::string& path, std::vector<T>& x, std::vector<T>& y, Range range = {}) {
    const std::vector<T> both = values<T>(path, range);
    x = component(both, 2, 0);
    y = component(both, 2, 1);
  }
  template <typename Row, typename T>
  void column(const std::string& path, std::vector<Row>& rows, T Row::*member, Range range = {}) {
    const auto stored = values<Stored<T>>(path, range);
    rows.resize(stored.size());
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*member = static_cast<T>(stored[k]);
  }
  template <typename Row>
  void column(const std::string& path, std::vector<Row>& rows, Vec2 Row::*member, Range range = {}) {
    const std::vector<double> stored = values<double>(path, range);
    rows.resize(stored.size() / 2);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*member = {stored[2 * k], stored[2 * k + 1]};
  }

 private:
  template <typename T>
  std::vector<T> values(const std::string& path, Range range) {
    if constexpr (std::is_same_v<T, double>)
      return reader_.read_finite(path, range.low, range.high);
    else
      return reader_.read<T>(path);
  }

  hdf5::Reader& reader_;
};

}  // namespace talus
