#include <algorithm>

#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/hdf5_writer.h"
#include "problems/fclib_file.h"
#include "problems/fclib_schema.h"

namespace talus::problems {
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
        std::string(
            "u = W r + q; unknowns (n, t) of each contact, n from body a to body b, t = (-n_y, n_x); r is "
            "the impulse on b, u the velocity of b seen from a; 0 <= u_n complementary to r_n >= 0, "
            "|r_t| <= mu r_n; SI units, per metre of thickness"));
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
