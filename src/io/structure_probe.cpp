#include "io/structure_probe.h"

#include <filesystem>

#include "io/child_process.h"
#include "io/hdf5_handle.h"

namespace talus {
namespace {

using hdf5::Handle;

/// Reads what describes an object, but not its values. Objects that cannot be opened are none of a run.
herr_t look_at(hid_t place, const char* name, const H5O_info_t* info, void*) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const Handle set(H5Dopen2(place, name, H5P_DEFAULT), H5Dclose);
  if (set.get() < 0) return 0;
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const Handle properties(H5Dget_create_plist(set.get()), H5Pclose);
  hsize_t chunks = 0;
  if (H5Pget_layout(properties.get()) == H5D_CHUNKED) H5Dget_num_chunks(set.get(), space.get(), &chunks);
  return 0;
}

void look_around(const Handle& file) {
  if (file.get() >= 0) H5Ovisit2(file.get(), H5_INDEX_NAME, H5_ITER_NATIVE, look_at, nullptr, H5O_INFO_BASIC);
}

}  // namespace

void probe_packed(const std::string& path) {
  const auto look = [&path] {
    hdf5::set_library_policy();
    look_around(Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose));
    return std::vector<std::byte>();
  };
  std::error_code unknown;
  in_child_process(path, std::filesystem::file_size(path, unknown), look);
}

void probe_folder(const std::string& folder, std::vector<std::vector<std::byte>>& once,
                  const std::vector<StoredSegment>& segments) {
  const auto look_in = [&folder](std::vector<std::byte>& bytes) {
    look_around(hdf5::open_image(bytes, folder, H5F_ACC_RDONLY));
  };
  const auto look = [&] {
    for (std::vector<std::byte>& bytes : once) look_in(bytes);
    for (const StoredSegment& segment : segments) {
      std::vector<std::byte> bytes = read_stored(folder, segment.file);
      look_in(bytes);
    }
    return std::vector<std::byte>();
  };
  std::size_t size = 0;
  for (const std::vector<std::byte>& bytes : once) size += bytes.size();
  for (const StoredSegment& segment : segments) size += segment.file.size;
  in_child_process(folder, size, look);
}

}  // namespace talus
