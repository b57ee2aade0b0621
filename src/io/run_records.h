#pragma once
/// Conversion of the records of a run to and from HDF5: header, frames, series, checkpoint. The files of a
/// run folder and a packed file contain the same data sets. Private to src/io.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/errors.h"
#include "core/snapshot.h"
#include "core/types.h"
#include "io/hdf5_file.h"
#include "io/run_store.h"

namespace talus::io {

// One table of fields for both directions: a record lists its data sets once, in the order of the file, and
// passes them to Fields, which writes or reads them. Private to src/io.

using hdf5::Range;
using hdf5::Reader;
using hdf5::Writer;
inline constexpr Range not_negative = {.low = 0.0};
/// Periodic images of contacts; a fast grain passes several periods in one step.
inline constexpr Range shifts = {-100.0, 100.0};

/// Rejects the same values when a record is read and when it is written, so that what is written can be read.
class RecordCheck {
 public:
  /// For a record that is written: throws Error(bad_data) that it cannot be stored.
  RecordCheck() = default;
  /// For a record that is read: throws the errors of the reader, which must outlive this.
  RecordCheck(const Reader& reader) : reader_(&reader) {}  // NOLINT(google-explicit-constructor)

  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const {
    if (reader_ != nullptr) reader_->refuse(path, problem);
    throw Error(ExitCode::bad_data,
                "the run cannot be stored: its data set {} {}; what was committed before is kept", path,
                problem);
  }
  /// Refuses a value outside its range.
  template <typename T>
  void check(const std::string& path, const std::vector<T>& values, Range range) const {
    if (reader_ == nullptr && !checks_what_is_written) return;
    hdf5::check_range(values, range, [&](const std::string& problem) { refuse(path, problem); });
  }

 private:
  const Reader* reader_ = nullptr;
};

/// Writes entire data sets.
struct FileWriter {
  Writer& writer;
  static constexpr bool reads = false;

  static bool has(const std::string&, bool is_there) { return is_there; }
  template <typename T>
  void put(const std::string& path, const std::vector<T>& values, Range range) {
    RecordCheck().check(path, values, range);
    writer.write(path, values);
  }
};

/// Reads entire data sets, or these rows of them and of those below /contacts.
struct FileReader {
  Reader& reader;
  std::optional<hdf5::Rows> rows{}, contact_rows{};
  static constexpr bool reads = true;

  bool has(const std::string& path, bool) const { return reader.has(path); }
  template <typename T>
  std::vector<T> get(const std::string& path, Range range) {
    return reader.read<T>(path, range, path.starts_with("/contacts/") ? contact_rows : rows);
  }
};

/// A value is stored as one number or several consecutive numbers; bools and enums are stored as int8.
template <typename T>
constexpr std::size_t part_count = std::is_same_v<T, Tensor2> ? 4
                                   : std::is_same_v<T, Vec2>  ? 2
                                                              : 1;
template <typename T>
auto& part(T& value, std::size_t p) {
  if constexpr (part_count<std::remove_const_t<T>> == 1)
    return value;
  else if constexpr (part_count<std::remove_const_t<T>> == 2)
    return p == 0 ? value.x : value.y;
  else
    return p < 2 ? (p == 0 ? value.xx : value.xy) : (p == 2 ? value.yx : value.yy);
}
template <typename T>
using NumberOf = std::remove_cvref_t<decltype(part(std::declval<T&>(), 0))>;
template <typename T>
using Stored = std::conditional_t<std::is_enum_v<NumberOf<T>> || std::is_same_v<NumberOf<T>, bool>,
                                  std::int8_t, NumberOf<T>>;

/// Exchanges data sets, described once for both directions. A range limits their values.
template <typename Direction>
struct Fields {
  Direction direction;

  template <typename T>
  void scalar(const std::string& path, T& value, Range range = {}) {
    exchange<Stored<T>>(
        path, 1, range, [](auto) {}, [&](std::size_t) -> T& { return value; });
  }
  /// Exchanges one member of each row, or the result of a function of it.
  template <typename Rows, typename Member>
  void column(const std::string& path, Rows& rows, const Member& member, Range range = {}) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Member, decltype(rows[0])>>;
    constexpr std::size_t parts = part_count<Value>;
    exchange<Stored<Value>>(
        path, parts * rows.size(), range, [&](auto count) { rows.resize(count / parts); },
        [&](std::size_t k) -> auto& { return part(std::invoke(member, rows[k / parts]), k % parts); });
  }
  template <typename Array>
  void array(const std::string& path, Array& values, Range range = {}) {
    column(path, values, std::identity(), range);
  }
  /// Exchanges an array that is stored only if it is not empty.
  template <typename Array>
  void array_if_any(const std::string& path, Array& values, Range range = {}) {
    if (direction.has(path, !values.empty())) array(path, values, range);
  }
  /// Exchanges two arrays as one array of pairs.
  template <typename X, typename Y>
  void pairs(const std::string& path, X& x, Y& y, Range range = {}) {
    exchange<Stored<typename X::value_type>>(
        path, 2 * x.size(), range,
        [&](auto count) {
          x.resize(count / 2);
          y.resize(count / 2);
        },
        [&](std::size_t k) -> auto& { return (k % 2 == 0 ? x : y)[k / 2]; });
  }

  template <typename Text>
  void text(const std::string& path, Text& value) {
    if constexpr (Direction::reads)
      value = direction.reader.read_text(path);
    else
      direction.writer.write_text(path, value);
  }
  /// Exchanges a group of values or texts, whose names the record chooses.
  template <typename Named>
  void named(const std::string& group, Named& values) {
    if constexpr (Direction::reads)
      for (const std::string& name : direction.reader.names(group))
        values.emplace_back(name, typename Named::value_type::second_type());
    else
      direction.writer.create_group(group);
    for (auto& [name, value] : values)
      if constexpr (std::is_same_v<typename Named::value_type::second_type, std::string>)
        text(group + "/" + name, value);
      else
        scalar(group + "/" + name, value, hdf5::any_number);
  }

 private:
  /// Exchanges the values of a data set: `at(k)` refers to element k, after `resize(count)` when reading.
  template <typename T, typename Resize, typename At>
  void exchange(const std::string& path, std::size_t count, Range range, const Resize& resize, const At& at) {
    if constexpr (Direction::reads) {
      const std::vector<T> values = direction.template get<T>(path, range);
      resize(values.size());
      for (std::size_t k = 0; k < values.size(); ++k)
        at(k) = static_cast<std::remove_cvref_t<decltype(at(k))>>(values[k]);
    } else {
      std::vector<T> values(count);
      for (std::size_t k = 0; k < count; ++k) values[k] = static_cast<T>(at(k));
      direction.put(path, values, range);
    }
  }
};
template <typename Direction>
Fields(Direction) -> Fields<Direction>;

/// Adds the sizes of the state from which a branch begins, if the run is a branch.
Sizes with_branch(Sizes sizes, const RunHeader& header);

/// Writes /parameters, /provenance and the static data sets of /particles. Sizes: N.
void write_header(Writer& writer, const RunHeader& header);
/// Rejects a file with another version of the schema.
void check_version(Reader& reader);
/// Reads the header; facts of the provenance for whose path `keeps` returns false are left out.
RunHeader read_header(Reader& reader, const std::function<bool(const std::string&)>& keeps = {});

/// Writes /frames, the time-dependent data sets of /particles, and /contacts. Sizes: T, N, M. `frame_at(k)`
/// is called once for each frame, in order.
void write_frames(Writer& writer, const std::function<Frame(std::size_t)>& frame_at);
/// Writes only /frames/step, time and tilt of the frames.
void write_instants(Writer& writer, const std::function<Frame(std::size_t)>& frame_at);
/// Read frame `row` of the file, entirely or only its step, time, tilt, x and y.
Frame read_frame(Reader& reader, std::size_t row);
Frame read_positions(Reader& reader, std::size_t row);
/// Returns the value of /frames/hash: the hash of the size and the bytes of each data set, as stored.
std::uint64_t frame_hash(const Frame& frame);
/// Rejects a frame whose grains or contacts cannot belong to a bed with `planes` planes and farthest_place
/// `farthest`, because other code uses these values as indices, or sizes grids by them, without a check.
void check_frame(const RecordCheck& record, const Frame& frame, double farthest, std::size_t planes);

/// Returns the rows of the contacts of frame `row` of the file.
hdf5::Rows contact_rows(Reader& reader, std::size_t row);

/// Returns the paths of the quantities that scripts have stored.
std::vector<std::string> own_data_sets(const Reader& reader);
/// Returns one of them without its values. The reader must know the sizes T, N and M. Throws Error(bad_data)
/// unless its name, kind and shape are valid.
OwnQuantity read_own_head(Reader& reader, const std::string& path);
/// Returns all values of such a quantity, or some rows of them.
std::vector<double> read_own_values(Reader& reader, const OwnQuantity& own,
                                    std::optional<hdf5::Rows> rows = {});
/// Writes a quantity with the values of all frames. Sizes: T, N, M.
void write_own(Writer& writer, const OwnQuantity& own);
/// Returns the path of its data set.
std::string path_of(const OwnQuantity& own);

/// Write and read all but the frames of a segment: /observables, /steps, and the groups /commands and
/// /trials, which exist only if they have rows. Sizes: R, S, K, Q.
Sizes sizes_of(const Segment& segment);
void write_series(Writer& writer, const Segment& segment);
std::vector<ObservableRow> read_observables(Reader& reader);
std::vector<StepRow> read_steps(Reader& reader);
std::vector<Command> read_commands(Reader& reader);
std::vector<TrialRow> read_trials(Reader& reader);

template <typename Row>
void append(std::vector<Row>& rows, const std::vector<Row>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

/// Write and read /checkpoint, /results and /provenance/timing. Sizes: G, C, P.
void write_checkpoint(Writer& writer, const Checkpoint& checkpoint);
Checkpoint read_checkpoint(Reader& reader);
/// Write and read only /results and /provenance/timing, for a repaired run without its last state.
void write_results(Writer& writer, const Checkpoint& checkpoint);
Checkpoint read_results(Reader& reader);

/// Returns the data sets of the run, without its analysis, that a file lists.
std::vector<std::string> listed_data_sets(Reader& reader);
/// Whether a data set matches its own hash. Those covered by hashes of frames do; unreadable ones do not.
bool is_as_written(Reader& reader, const std::string& path);
/// Returns the paths of the data sets that do not match, including those of a stored analysis.
std::vector<std::string> changed_data_sets(Reader& reader);

/// The provenance fact that records what a run lost before it was repaired.
inline constexpr const char* lost_fact = "repaired_lost";

}  // namespace talus::io
