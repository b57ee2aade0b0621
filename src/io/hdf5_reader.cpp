#include "io/hdf5_reader.h"

#include <array>

#include "core/errors.h"
#include "core/hash.h"

namespace talus::hdf5 {
namespace {

constexpr hsize_t largest_block = hsize_t{1} << 29;  // values read at once: 4 GiB of doubles

Handle open_or_refuse(hid_t file, const std::string& name) {
  if (file < 0)
    throw Error(ExitCode::bad_data,
                name + ": HDF5 cannot open it, although its hash is right: it was made otherwise");
  return Handle(file, H5Fclose);
}

std::string shape_text(const std::vector<hsize_t>& dims) {
  std::string text = "[";
  for (std::size_t d = 0; d < dims.size(); ++d) {
    if (d > 0) text += ' ';
    text += std::to_string(dims[d]);
  }
  return text + "]";
}

bool is_fixed_text(hid_t type) {
  return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
         H5Tget_size(type) < largest_block;
}

}  // namespace

Reader::Reader(Handle file, std::string name, Sizes sizes)
    : file_(std::move(file)), name_(std::move(name)), sizes_(std::move(sizes)) {}

Reader Reader::from_memory(const std::vector<std::byte>& image, const std::string& name, const Sizes& known) {
  set_library_policy();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // HDF5 copies the image and never writes to the buffer it is given.
  void* bytes = const_cast<std::byte*>(image.data());
  if (H5Pset_fapl_core(access.get(), 1 << 20, false) < 0 ||
      H5Pset_file_image(access.get(), bytes, image.size()) < 0)
    throw Error(ExitCode::out_of_memory, name + ": no memory to open it");
  const std::string unique = memory_name(name + " " + hash_text(hash_bytes(image)));
  return Reader(open_or_refuse(H5Fopen(unique.c_str(), H5F_ACC_RDONLY, access.get()), name), name, known);
}

Reader Reader::from_file(const std::string& path) {
  set_library_policy();
  return Reader(open_or_refuse(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), path), path, {});
}

void Reader::refuse(const std::string& path, const std::string& problem) const {
  throw Error(ExitCode::bad_data, name_ + ": data set " + path + " " + problem);
}

void Reader::check_shape(const std::string& path, const std::vector<hsize_t>& dims) {
  const DataSetField& field = field_of(path);
  const std::vector<Extent> shape = extents(field);
  bool fits = dims.size() == shape.size();
  for (std::size_t d = 0; fits && d < dims.size(); ++d) {
    fits = dims[d] >= shape[d].plus;
    if (!fits || shape[d].symbol == '\0') {
      fits = fits && dims[d] == shape[d].plus;
      continue;
    }
    const std::uint64_t size = dims[d] - shape[d].plus;
    fits = sizes_.emplace(shape[d].symbol, size).first->second == size;
  }
  if (fits) return;
  std::string expected;
  for (const auto& [symbol, size] : sizes_)
    if (field.shape.find(symbol) != std::string::npos)
      expected +=
          (expected.empty() ? " with " : ", ") + std::string(1, symbol) + " = " + std::to_string(size);
  refuse(path, "has shape " + shape_text(dims) + ", expected [" + field.shape + "]" + expected);
}

Reader::DataSet Reader::open(const std::string& path) {
  DataSet set;
  set.id = Handle(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.id.get() < 0) refuse(path, "is missing");
  const Handle type(H5Dget_type(set.id.get()), H5Tclose), space(H5Dget_space(set.id.get()), H5Sclose);
  const ElementType expected = field_of(path).type;
  const bool same = expected == ElementType::text ? is_fixed_text(type.get())
                                                  : H5Tequal(type.get(), file_type(expected)) > 0;
  if (!same) refuse(path, "has another type than " + std::string(type_name(expected)));
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) refuse(path, "has no shape");
  set.dims.resize(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space.get(), set.dims.data(), nullptr) != rank) refuse(path, "has no shape");
  check_shape(path, set.dims);
  return set;
}

std::size_t Reader::block_size(const DataSet& set, const std::string& path, std::uint64_t first,
                               std::uint64_t count) const {
  if (set.dims.empty()) return 1;
  if (count > set.dims[0] || first > set.dims[0] - count)
    refuse(path, "has " + std::to_string(set.dims[0]) + " rows; row " + std::to_string(first + count) +
                     " was asked for");
  hsize_t size = count;
  for (std::size_t d = 1; d < set.dims.size(); ++d)
    if (set.dims[d] == 0 || size > largest_block / set.dims[d])
      size = set.dims[d] == 0 ? 0 : largest_block + 1;
    else
      size *= set.dims[d];
  if (size > largest_block) refuse(path, "of shape " + shape_text(set.dims) + " is too large to be true");
  return size;
}

void Reader::read_block(const DataSet& set, const std::string& path, std::uint64_t first, std::uint64_t count,
                        hid_t type, void* values) const {
  if (!set.dims.empty() && count == 0) return;
  const Handle space(H5Dget_space(set.id.get()), H5Sclose);
  std::vector<hsize_t> start(set.dims.size(), 0), block = set.dims;
  Handle memory(H5Screate(H5S_SCALAR), H5Sclose);
  if (!block.empty()) {
    start[0] = first;
    block[0] = count;
    memory = Handle(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr), H5Sclose);
    if (H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr) < 0)
      refuse(path, "cannot be selected");
  }
  if (H5Dread(set.id.get(), type, memory.get(), space.get(), H5P_DEFAULT, values) < 0)
    refuse(path, "cannot be read");
}

std::string Reader::read_text(const std::string& path) {
  const DataSet set = open(path);
  const Handle type(H5Dget_type(set.id.get()), H5Tclose);
  std::string text(H5Tget_size(type.get()), '\0');
  read_block(set, path, 0, 1, type.get(), text.data());
  return text.substr(0, text.find('\0'));
}

bool Reader::has(const std::string& path) const {
  return H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT) > 0;
}

std::uint64_t Reader::row_count(const std::string& path) {
  const DataSet set = open(path);
  return set.dims.empty() ? 1 : set.dims[0];
}

std::vector<std::string> Reader::names(const std::string& group) {
  const Handle id(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (id.get() < 0 || H5Gget_info(id.get(), &info) < 0) refuse(group, "(a group) is missing");
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    std::array<char, 256> name{};
    H5O_info_t object{};
    if (H5Lget_name_by_idx(id.get(), ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, k, name.data(), name.size(),
                           H5P_DEFAULT) < 0 ||
        H5Oget_info_by_name(id.get(), name.data(), &object, H5P_DEFAULT) < 0)
      refuse(group, "(a group) cannot be listed");
    if (object.type == H5O_TYPE_DATASET) names.emplace_back(name.data());
  }
  return names;
}

}  // namespace talus::hdf5
