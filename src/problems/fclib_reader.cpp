#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "base/errors.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/hdf5_reader.h"
#include "problems/fclib_file.h"
#include "problems/fclib_schema.h"

namespace talus::problems {
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
    throw Error(ExitCode::bad_data, fmt::format("{}: data set {} {}", path_, path, problem));
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
    throw Error(ExitCode::bad_data,
                path +
                    ": has no group /fclib_local, so it is not a local problem of FCLIB; talus dump "
                    "writes one from a run");
  const Index dimension = file.read_integer("/fclib_local/spacedim");
  if (dimension != 2)
    file.refuse("/fclib_local/spacedim",
                fmt::format("is {}, expected 2: Talus solves problems in the plane", dimension));
  if (file.has("/fclib_local/V") || file.has("/fclib_local/R"))
    throw Error(ExitCode::bad_data,
                path +
                    ": has equality constraints (groups /fclib_local/V and R), which Talus "
                    "does not solve");
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

FclibProblem read_fclib(const std::string& path) {
  std::vector<std::byte> bytes = io::read_file(path);
  const auto work = [&] { return arrays_in(io::hdf5::Reader::from_memory(std::move(bytes), path)); };
  return checked_problem(path, io::in_child_process(path, bytes.size(), work));
}

}  // namespace talus::problems
