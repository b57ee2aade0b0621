#include "problems/fclib_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/core.h>
#include <limits>
#include <span>

#include "base/errors.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/hdf5_file.h"

namespace talus::problems {

namespace {

using enum io::ElementType;

std::vector<io::DataSetField> make_schema() {
  return {
      {"/fclib_local/spacedim", int32, "1", "1", "dimension of space, 2"},
      {"/fclib_local/W/nzmax", int32, "1", "1", "number of entries of W"},
      {"/fclib_local/W/m", int32, "1", "1", "rows of W, two for each contact: normal, tangent"},
      {"/fclib_local/W/n", int32, "1", "1", "columns of W, as many as rows"},
      {"/fclib_local/W/nz", int32, "1", "1",
       "form of W: -2 compressed rows, as Talus writes it; -1 compressed columns; 0 or more: the number of "
       "triplets"},
      {"/fclib_local/W/p", int32, "U+1", "1",
       "entries of row k are p[k] ... p[k+1] - 1; the same of columns in compressed columns; column of each "
       "entry in triplets"},
      {"/fclib_local/W/i", int32, "E", "1", "column of each entry; its row in the two other forms"},
      {"/fclib_local/W/x", float64, "E", "1/kg", "value of each entry"},
      {"/fclib_local/vectors/q", float64, "U", "m/s",
       "relative velocity (n, t) of each contact without impulses, gap / h and restitution included: u = W r "
       "+ q"},
      {"/fclib_local/vectors/mu", float64, "C", "1", "coefficient of friction of each contact"},
      {"/fclib_local/info/title", text, "", "1", "origin of the problem"},
      {"/fclib_local/info/description", text, "", "1", "conventions, in words"},
      {"/fclib_local/info/math_info", text, "", "1", "properties of W"},
      {"/guesses/number_of_guesses", int32, "1", "1", "number of first guesses: 1"},
      {"/guesses/1/r", float64, "U", "N s", "impulses of the step before, (n, t) of each contact"},
      {"/guesses/1/u", float64, "U", "m/s", "their relative velocities, W r + q"},
      {"/solution/r", float64, "U", "N s", "solution: impulses on the second body, (n, t) of each contact"},
      {"/solution/u", float64, "U", "m/s", "solution: relative velocities, W r + q"},
      {"/talus/bodies/vx", float64, "B", "m/s", "free velocity along the bed, gravity included"},
      {"/talus/bodies/vy", float64, "B", "m/s", "free velocity away from the floor"},
      {"/talus/bodies/omega", float64, "B", "rad/s", "rotation velocity, counter-clockwise positive"},
      {"/talus/bodies/inverse_mass", float64, "B", "1/kg",
       "inverse of the mass; 0 for a body that does not move"},
      {"/talus/bodies/inverse_inertia", float64, "B", "1/(kg m^2)",
       "inverse of the inertia; 0 for a body that does not rotate"},
      {"/talus/bodies/lever", float64, "B", "m", "distance from the centre to every contact; 0 for a plane"},
      {"/talus/bodies/column", int32, "B", "1",
       "column of a large bed that the body is in, from one end to the other"},
      {"/talus/contacts/a", int32, "C", "1", "first body; ascending"},
      {"/talus/contacts/b", int32, "C", "1", "second body, on which the impulses act"},
      {"/talus/contacts/nx", float64, "C", "1", "unit normal along the bed, from a to b"},
      {"/talus/contacts/ny", float64, "C", "1", "unit normal away from the floor"},
      {"/talus/contacts/cn", float64, "C", "m/s",
       "normal part of q that is not free velocity: gap, restitution"},
      {"/talus/contacts/ct", float64, "C", "m/s", "tangential part: restitution"},
      {"/talus/scales/time_step", float64, "1", "s", "length of the step, h"},
      {"/talus/scales/gravity", float64, "1", "m/s^2", "magnitude of gravity, g"},
      {"/talus/scales/tilt", float64, "1", "rad", "angle of the bed to the horizontal in this step"},
      {"/talus/scales/mean_diameter", float64, "1", "m", "mean diameter of the free grains, D"},
      {"/talus/scales/weight", float64, "1", "N", "weight of the free grains, per metre of thickness"},
      {"/talus/run/velocity", float64, "1", "g h",
       "rms velocity of the free grains before the step, rim velocity included"},
      {"/talus/run/tolerance", float64, "1", "1", "residual eta that the run asks of this step"},
      {"/talus/run/tolerance_at_rest", float64, "1", "1", "residual eta that the run asks of a bed at rest"},
  };
}

}  // namespace

const std::vector<io::DataSetField>& fclib_schema() {
  static const std::vector<io::DataSetField> schema = make_schema();
  return schema;
}

const io::DataSetField& fclib_field(const std::string& path) {
  for (const io::DataSetField& field : fclib_schema())
    if (field.path == path) return field;
  throw Error(ExitCode::internal, "the schema of problem files has no data set " + path);
}

namespace {

/// The numerical data sets of a problem file of any program, with checks.
class FclibFile {
 public:
  FclibFile(std::string path, const io::Parcels& found) : path_(std::move(path)), found_(found) {}

  /// Whether a group or data set exists.
  bool has(const std::string& path) const { return found_.contains(path); }

  /// Returns all values of a numerical data set of any shape. Throws Error(bad_data) if it is missing or not
  /// finite.
  template <typename T>
  std::vector<T> read(const std::string& path) const {
    const auto found = found_.find(path);
    if (found == found_.end()) refuse(path, "is missing");
    auto values = io::values_of<std::vector<T>>(found->second);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!std::isfinite(values[k]))
        refuse(path, fmt::format("holds a value that is not finite, at index {}", k));
    return values;
  }

  /// Returns the values of a data set of a known size; `why` explains the size in messages.
  template <typename T>
  std::vector<T> read(const std::string& path, std::size_t size, const std::string& why) const {
    std::vector<T> values = read<T>(path);
    if (values.size() != size)
      refuse(path, fmt::format("has {} values, expected {}, {}", values.size(), size, why));
    return values;
  }

  Index read_integer(const std::string& path) const { return read<Index>(path, 1, "a scalar")[0]; }

  [[noreturn]] void refuse(const std::string& path, const std::string& problem) const {
    throw Error(ExitCode::bad_data, "{}: data set {} {}", path_, path, problem);
  }

 private:
  std::string path_;
  const io::Parcels& found_;
};

/// Returns the existing groups and data sets from which a problem is read.
io::Parcels arrays_in(io::hdf5::Reader reader) {
  io::Parcels found;
  for (const char* group : {"/fclib_local", "/fclib_local/V", "/fclib_local/R", "/talus", "/talus/run"})
    if (reader.has(group)) found[group];
  for (const io::DataSetField& field : fclib_schema())
    if (field.type != io::ElementType::text && !field.path.starts_with("/solution/") &&
        reader.has(field.path))
      found[field.path] = field.type == io::ElementType::int32
                              ? io::bytes_of(reader.read_numbers<Index>(field.path))
                              : io::bytes_of(reader.read_numbers<double>(field.path));
  return found;
}

void check_kind(const FclibFile& file, const std::string& path) {
  if (!file.has("/fclib_local"))
    throw Error(ExitCode::bad_data, path +
                                        ": has no group /fclib_local, so it is not a local problem of FCLIB; "
                                        "talus dump writes one from a run");
  const Index dimension = file.read_integer("/fclib_local/spacedim");
  if (dimension != 2)
    file.refuse("/fclib_local/spacedim",
                fmt::format("is {}, expected 2: Talus solves problems in the plane", dimension));
  if (file.has("/fclib_local/V") || file.has("/fclib_local/R"))
    throw Error(
        ExitCode::bad_data,
        path + ": has equality constraints (groups /fclib_local/V and R), which Talus does not solve");
}

void check_index(const FclibFile& file, const std::string& path, const std::vector<Index>& values,
                 std::size_t end) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] < 0 || static_cast<std::size_t>(values[k]) >= end)
      file.refuse(path, fmt::format("holds {} at index {}, expected 0 to {}", values[k], k, end - 1));
}

/// Returns the line (row or column) of each entry of compressed rows or columns.
std::vector<Index> line_of_entries(const FclibFile& file, std::size_t lines, std::size_t entries) {
  const std::string path = "/fclib_local/W/p";
  const auto begin = file.read<Index>(path, lines + 1, "one more than the number of rows of W");
  if (begin[0] != 0 || static_cast<std::size_t>(begin[lines]) != entries)
    file.refuse(path, fmt::format("goes from {} to {}, expected 0 to {}, the entries of W", begin[0],
                                  begin[lines], entries));
  std::vector<Index> line;
  line.reserve(entries);
  for (std::size_t k = 0; k < lines; ++k) {
    if (begin[k + 1] < begin[k] || static_cast<std::size_t>(begin[k + 1]) > entries)
      file.refuse(path, fmt::format("does not ascend at index {}", k + 1));
    line.insert(line.end(), static_cast<std::size_t>(begin[k + 1] - begin[k]), static_cast<Index>(k));
  }
  return line;
}

void read_matrix(const FclibFile& file, FclibProblem& problem) {
  const std::string group = "/fclib_local/W/";
  const std::size_t rows = problem.q.size();
  for (const char* side : {"m", "n"})
    if (const Index found = file.read_integer(group + side); static_cast<std::size_t>(found) != rows)
      file.refuse(
          group + side,
          fmt::format("is {}, expected {}, two for each contact of /fclib_local/vectors/mu", found, rows));
  const Index form = file.read_integer(group + "nz");
  if (form < -2)
    file.refuse(group + "nz", fmt::format("is {}, expected -2, -1, or a number of triplets", form));
  problem.value = file.read<double>(group + "x");
  const std::size_t entries = problem.value.size();
  auto inner = file.read<Index>(group + "i", entries, "one for each value of /fclib_local/W/x");
  check_index(file, group + "i", inner, rows);
  std::vector<Index> outer;
  if (form >= 0) {
    outer = file.read<Index>(group + "p", entries, "one for each value of /fclib_local/W/x");
    check_index(file, group + "p", outer, rows);
  } else {
    outer = line_of_entries(file, rows, entries);
  }
  if (form == -2) std::swap(inner, outer);
  problem.row = std::move(inner);
  problem.column = std::move(outer);
}

/// Checks that the diagonal of W is not negative: an impulse must not cause a velocity in the opposite
/// direction.
void check_diagonal(const FclibFile& file, const FclibProblem& problem) {
  for (std::size_t k = 0; k < problem.value.size(); ++k)
    if (problem.row[k] == problem.column[k] && problem.value[k] < 0.0)
      file.refuse("/fclib_local/W/x",
                  fmt::format("has the negative value {:g} on the diagonal of W, in row {}", problem.value[k],
                              problem.row[k]));
}

void read_vectors(const FclibFile& file, FclibProblem& problem) {
  const std::string mu = "/fclib_local/vectors/mu";
  problem.mu = file.read<double>(mu);
  if (problem.mu.size() > std::numeric_limits<Index>::max() / 2) file.refuse(mu, "has too many contacts");
  for (std::size_t c = 0; c < problem.mu.size(); ++c)
    if (problem.mu[c] < 0.0)
      file.refuse(mu, fmt::format("holds the negative value {:g} at index {}", problem.mu[c], c));
  problem.q = file.read<double>("/fclib_local/vectors/q", 2 * problem.mu.size(),
                                "two for each contact of /fclib_local/vectors/mu");
  if (file.has("/guesses/1/r"))
    problem.guess_r = file.read<double>("/guesses/1/r", problem.q.size(),
                                        "two for each contact of /fclib_local/vectors/mu");
}

std::size_t expected_size(const io::DataSetField& field, const FclibProblem& problem, std::size_t bodies) {
  if (field.shape == "1") return 1;
  return field.shape == "B" ? bodies : problem.mu.size();
}

void read_additions(const FclibFile& file, FclibProblem& problem) {
  if (!file.has("/talus")) return;
  const std::size_t bodies = file.read<double>("/talus/bodies/vx").size();
  for (const io::DataSetField& field : fclib_schema()) {
    if (!field.path.starts_with("/talus/")) continue;
    if (field.path.starts_with("/talus/run/") && !file.has("/talus/run")) continue;  // older file
    if (field.path == "/talus/bodies/column" && !file.has(field.path)) continue;     // small bed
    const std::size_t size = expected_size(field, problem, bodies);
    const std::string why = field.shape == "1"   ? "a scalar"
                            : field.shape == "B" ? "one for each body of /talus/bodies/vx"
                                                 : "one for each contact of /fclib_local/vectors/mu";
    if (field.type == io::ElementType::int32) {
      problem.integers[field.path] = file.read<Index>(field.path, size, why);
      check_index(file, field.path, problem.integers[field.path], bodies);
    } else {
      problem.reals[field.path] = file.read<double>(field.path, size, why);
    }
  }
}

}  // namespace

FclibProblem checked_problem(const std::string& path, const io::Parcels& found) {
  const FclibFile file(path, found);
  check_kind(file, path);
  FclibProblem problem;
  read_vectors(file, problem);
  read_matrix(file, problem);
  check_diagonal(file, problem);
  read_additions(file, problem);
  return problem;
}

namespace {

/// Whether bytes are a file of HDF5. Its signature is at their beginning, or at 512, 1024, ... after a user
/// block.
bool is_hdf5(std::span<const std::byte> bytes) {
  for (std::size_t at = 0; at + io::hdf5_signature.size() <= bytes.size(); at = at == 0 ? 512 : 2 * at)
    if (std::memcmp(bytes.data() + at, io::hdf5_signature.data(), io::hdf5_signature.size()) == 0)
      return true;
  return false;
}

}  // namespace

FclibProblem read_fclib(const std::string& path) {
  std::vector<std::byte> bytes = io::read_file(path);
  if (!is_hdf5(bytes))
    throw Error(ExitCode::bad_data,
                "{}: is not a contact problem; expected a file of talus dump, or of FCLIB", path);
  const auto work = [&] { return arrays_in(io::hdf5::Reader::from_memory(std::move(bytes), path)); };
  return checked_problem(path, io::in_child_process(path, bytes.size(), work));
}

namespace {

/// Writes an array with its actual size.
template <typename T>
void write(io::hdf5::Writer& writer, const std::string& path, const std::vector<T>& values) {
  io::DataSetField field = fclib_field(path);
  field.shape = std::to_string(values.size());
  writer.write(field, values);
}

void write(io::hdf5::Writer& writer, const std::string& path, Index value) {
  write(writer, path, std::vector<Index>{value});
}

void write(io::hdf5::Writer& writer, const std::string& path, const std::string& text) {
  writer.write_text(fclib_field(path), text + '\0');  // for programs in C
}

/// Returns the beginning of each row among entries sorted by row.
std::vector<Index> row_begins(const std::vector<Index>& row, std::size_t rows) {
  std::vector<Index> begin(rows + 1, 0);
  for (const Index r : row) ++begin[static_cast<std::size_t>(r) + 1];
  for (std::size_t r = 0; r < rows; ++r) begin[r + 1] += begin[r];
  return begin;
}

void write_local_problem(io::hdf5::Writer& file, const FclibProblem& problem) {
  const auto rows = static_cast<Index>(problem.q.size());
  write(file, "/fclib_local/spacedim", 2);
  write(file, "/fclib_local/W/nzmax", static_cast<Index>(problem.value.size()));
  write(file, "/fclib_local/W/m", rows);
  write(file, "/fclib_local/W/n", rows);
  write(file, "/fclib_local/W/nz", -2);
  write(file, "/fclib_local/W/p", row_begins(problem.row, problem.q.size()));
  write(file, "/fclib_local/W/i", problem.column);
  write(file, "/fclib_local/W/x", problem.value);
  write(file, "/fclib_local/vectors/q", problem.q);
  write(file, "/fclib_local/vectors/mu", problem.mu);
  write(file, "/fclib_local/info/title", problem.title);
  write(file, "/fclib_local/info/description",
        std::string("u = W r + q; unknowns (n, t) of each contact, n from body a to body b, t = (-n_y, n_x); "
                    "r is the impulse on b, u the velocity of b seen from a; 0 <= u_n complementary to r_n "
                    ">= 0, |r_t| <= mu r_n; SI units, per metre of thickness"));
  write(file, "/fclib_local/info/math_info", std::string("W symmetric, positive semidefinite"));
}

}  // namespace

void write_fclib(const std::string& path, const FclibProblem& problem, const std::vector<double>& guess_u) {
  io::hdf5::Writer file({});
  write_local_problem(file, problem);
  write(file, "/guesses/number_of_guesses", 1);
  write(file, "/guesses/1/r", problem.guess_r);
  write(file, "/guesses/1/u", guess_u);
  for (const auto& [set, values] : problem.reals) write(file, set, values);
  for (const auto& [set, values] : problem.integers) write(file, set, values);
  io::write_durably(path, file.image());
}

void write_fclib_solution(const std::string& from, const std::string& to, const std::vector<double>& r,
                          const std::vector<double>& u) {
  const std::vector<std::byte> bytes = io::read_file(from);
  const auto with_solution = [&] {  // in a child process, because HDF5 may crash on a file of another program
    io::hdf5::Writer file({}, 0, bytes, from);
    file.remove("/solution");
    write(file, "/solution/r", r);
    write(file, "/solution/u", u);
    return io::Parcels{{"file", file.image()}};
  };
  io::write_durably(to, io::in_child_process(from, bytes.size(), with_solution)["file"]);
}

}  // namespace talus::problems
