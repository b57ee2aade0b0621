#include <algorithm>
#include <fmt/core.h>

#include "core/errors.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/hdf5_handle.h"
#include "problems/fclib_file.h"
#include "problems/fclib_schema.h"

namespace talus {
namespace {

using hdf5::Handle;

constexpr std::size_t growth = std::size_t{1} << 20;  // bytes by which an image in memory grows

template <typename Result>
Result checked(Result result, const std::string& action) {
  if (result < 0) throw Error(ExitCode::io_error, fmt::format("HDF5 cannot {} (in memory)", action));
  return result;
}

Handle properties(hid_t kind) { return Handle(checked(H5Pcreate(kind), "create properties"), H5Pclose); }

Handle in_memory() {
  hdf5::set_library_policy();
  Handle access = properties(H5P_FILE_ACCESS);
  checked(H5Pset_fapl_core(access.get(), growth, false), "choose memory");
  return access;
}

Handle text_type(std::size_t length) {
  Handle type(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
  checked(H5Tset_size(type.get(), length + 1), "set the length of a text");
  return type;
}

Handle space_of(const DataSetField& field, std::size_t count) {
  const hsize_t size = count;
  return Handle(checked(field.shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr),
                        "create a shape"),
                H5Sclose);
}

void write_unit(hid_t set, const std::string& unit) {
  const Handle type = text_type(unit.size()), space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      checked(H5Acreate2(set, "unit", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), "create a unit"),
      H5Aclose);
  checked(H5Awrite(attribute.get(), type.get(), unit.c_str()), "write a unit");
}

/// Creates a data set, and the groups above it, with `count` values of the type in memory.
void write_values(hid_t file, const std::string& path, hid_t stored_type, hid_t type, std::size_t count,
                  const void* values) {
  const DataSetField& field = fclib_field(path);
  const Handle links = properties(H5P_LINK_CREATE), creation = properties(H5P_DATASET_CREATE);
  checked(H5Pset_create_intermediate_group(links.get(), 1), "create groups");
  checked(H5Pset_obj_track_times(creation.get(), false), "leave out times");  // equal problems, equal bytes
  const Handle space = space_of(field, count);
  const Handle set(checked(H5Dcreate2(file, path.c_str(), stored_type, space.get(), links.get(),
                                      creation.get(), H5P_DEFAULT),
                           "create " + path),
                   H5Dclose);
  if (count > 0) checked(H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write " + path);
  write_unit(set.get(), field.unit);
}

template <typename T>
void write(hid_t file, const std::string& path, const std::vector<T>& values) {
  write_values(file, path, hdf5::file_type(fclib_field(path).type), hdf5::memory_type<T>(), values.size(),
               values.data());
}

void write(hid_t file, const std::string& path, Index value) { write(file, path, std::vector<Index>{value}); }

void write(hid_t file, const std::string& path, const std::string& text) {
  const Handle type = text_type(text.size());
  write_values(file, path, type.get(), type.get(), 1, text.c_str());
}

/// Where each row begins among entries sorted by row.
std::vector<Index> row_begins(const std::vector<Index>& row, std::size_t rows) {
  std::vector<Index> begin(rows + 1, 0);
  for (const Index r : row) ++begin[static_cast<std::size_t>(r) + 1];
  for (std::size_t r = 0; r < rows; ++r) begin[r + 1] += begin[r];
  return begin;
}

void write_local_problem(hid_t file, const FclibProblem& problem) {
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

/// The bytes of a file in memory.
std::vector<std::byte> image_of(hid_t file) {
  checked(H5Fflush(file, H5F_SCOPE_LOCAL), "complete a file");
  const ssize_t size = checked(H5Fget_file_image(file, nullptr, 0), "measure a file");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  checked(H5Fget_file_image(file, bytes.data(), bytes.size()), "copy a file");
  return bytes;
}

}  // namespace

void write_fclib(const std::string& path, const FclibProblem& problem, const std::vector<double>& guess_u) {
  const Handle access = in_memory();
  const std::string name = hdf5::memory_name("problem");
  const Handle file(
      checked(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), "create a file"), H5Fclose);
  write_local_problem(file.get(), problem);
  write(file.get(), "/guesses/number_of_guesses", 1);
  write(file.get(), "/guesses/1/r", problem.guess_r);
  write(file.get(), "/guesses/1/u", guess_u);
  for (const auto& [set, values] : problem.reals) write(file.get(), set, values);
  for (const auto& [set, values] : problem.integers) write(file.get(), set, values);
  write_durably(path, image_of(file.get()));
}

void write_fclib_solution(const std::string& from, const std::string& to, const std::vector<double>& r,
                          const std::vector<double>& u) {
  std::vector<std::byte> bytes = read_file(from);
  const auto with_solution = [&] {  // HDF5 may fail on a file of another program: not in this process
    const Handle file = hdf5::open_image(bytes, from, H5F_ACC_RDWR);
    if (file.get() < 0) throw Error(ExitCode::bad_data, from + ": is not an HDF5 file that can be added to");
    if (H5Lexists(file.get(), "/solution", H5P_DEFAULT) > 0)
      checked(H5Ldelete(file.get(), "/solution", H5P_DEFAULT), "remove /solution");
    write(file.get(), "/solution/r", r);
    write(file.get(), "/solution/u", u);
    return image_of(file.get());
  };
  write_durably(to, in_child_process(from, bytes.size(), with_solution));
}

}  // namespace talus
