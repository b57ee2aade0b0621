#include "unit/io/damaged_run.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/durable_file.h"
#include "unit/io/example_run.h"

namespace talus::example {
namespace {

/// Position of a row of a data set, or of a chunk, in a file.
struct Place {
  std::size_t offset = 0, size = 0;
};

Place place_of(const std::string& run, const std::string& path, unsigned row) {
  const hid_t file = H5Fopen(run.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
  const hid_t creation = H5Dget_create_plist(set);
  const hid_t file_creation = H5Fget_create_plist(file);
  hsize_t user_block = 0;
  H5Pget_userblock(file_creation, &user_block);
  H5Pclose(file_creation);
  Place place;
  if (H5Pget_layout(creation) == H5D_CHUNKED) {
    const hsize_t start[4] = {row, 0, 0, 0};
    unsigned mask = 0;
    haddr_t offset = 0;
    hsize_t size = 0;
    EXPECT_GE(H5Dget_chunk_info_by_coord(set, start, &mask, &offset, &size), 0) << path;
    // Versions of HDF5 count from the beginning of the file or from the end of the seal; deflated data begin
    // with an x.
    if (test::text_of(run).at(static_cast<std::size_t>(offset)) != 'x') offset += user_block;
    place = {static_cast<std::size_t>(offset), static_cast<std::size_t>(size)};
  } else {
    const hid_t space = H5Dget_space(set);
    hsize_t dims[4] = {1, 0, 0, 0};
    H5Sget_simple_extent_dims(space, dims, nullptr);
    H5Sclose(space);
    const std::size_t size = H5Dget_storage_size(set) / std::max<hsize_t>(1, dims[0]);
    place = {static_cast<std::size_t>(H5Dget_offset(set)) + row * size, size};
  }
  H5Pclose(creation);
  H5Dclose(set);
  H5Fclose(file);
  return place;
}

}  // namespace

void spoil_data_set(const std::string& run, const std::string& path, unsigned row) {
  const Place place = place_of(run, path, row);
  ASSERT_GT(place.size, 0U) << path;
  std::string text = test::text_of(run);
  std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(place.offset), std::min<std::size_t>(place.size, 8),
              '\x55');
  write_text(run, text);
}

void swap_data_sets(const std::string& run, const std::string& one, const std::string& other) {
  const hid_t file = H5Fopen(run.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const std::pair<std::string, std::string> moves[] = {{one, "/aside"}, {other, one}, {"/aside", other}};
  for (const auto& [from, to] : moves)
    EXPECT_GE(H5Lmove(file, from.c_str(), file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT), 0);
  H5Fclose(file);
}

void seal_again(const std::string& run) {
  const std::string text = test::text_of(run);
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  const std::vector<std::byte> sealed = io::sealed({bytes, bytes + text.size()});
  write_text(run, {reinterpret_cast<const char*>(sealed.data()), sealed.size()});
}

void set_version(const std::string& run, std::int32_t version) {
  const hid_t file = H5Fopen(run.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t set = H5Dopen2(file, "/parameters/schema_version", H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(set, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, &version), 0);
  H5Dclose(set);
  H5Fclose(file);
  if (test::text_of(run).starts_with("talus run file")) seal_again(run);
}

}  // namespace talus::example
