#include "io/hdf5_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/errors.h"

namespace talus::hdf5 {
namespace {

Handle open_or_refuse(Handle file, const std::string& name) {
  if (file.get() < 0) throw_cause(name);
  if (file.get() < 0)
    throw Error(ExitCode::bad_data,
                name + ": HDF5 cannot open it, although its hash is right: it was made otherwise");
  return file;
}

hsize_t size_of(const Handle& file) {
  hsize_t size = 0;
  return H5Fget_filesize(file.get(), &size) < 0 ? 0 : size;
}

std::string shape_text(const std::vector<hsize_t>& dims) {
  std::string text = "[";
  for (std::size_t d = 0; d < dims.size(); ++d) {
    if (d > 0) text += ' ';
    text += std::to_string(dims[d]);
  }
  return text + "]";
}

std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

bool is_fixed_text(hid_t type) { return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0; }

}  // namespace

Reader::Reader(Handle file, std::string name, Sizes sizes)
    : file_(std::move(file)), file_size_(size_of(file_)), name_(std::move(name)), sizes_(std::move(sizes)) {}

Reader Reader::from_memory(std::vector<std::byte> image, const std::string& name, const Sizes& known) {
  return Reader(open_or_refuse(open_image(image, name, H5F_ACC_RDONLY), name), name, known);
}

Reader Reader::from_file(const std::string& path) {
  set_library_policy();
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  return Reader(open_or_refuse(std::move(file), path), path, {});
}

void Reader::refuse(const std::string& path, const std::string& problem) const {
  const std::string data_set = name_ + ": data set " + path;
  throw_cause(data_set);
  throw Error(ExitCode::bad_data, data_set + " " + problem);
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
  const Found found = find(file_.get(), path);
  if (found == Found::nothing) refuse(path, "is missing");
  if (found == Found::a_link_elsewhere) refuse(path, "is a link to another place, which is not followed");
  DataSet set;
  set.id = Handle(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (set.id.get() < 0) refuse(path, "cannot be opened: it is no data set");
  const Handle type(H5Dget_type(set.id.get()), H5Tclose), space(H5Dget_space(set.id.get()), H5Sclose);
  const ElementType expected = field_of(path).type;
  const bool same = expected == ElementType::text ? is_fixed_text(type.get())
                                                  : H5Tequal(type.get(), file_type(expected)) > 0;
  if (!same) refuse(path, "has another type than " + std::string(type_name(expected)));
  if (expected == ElementType::text && !can_hold(file_size_, H5Tget_size(type.get())))
    refuse(path, "is too long to be true");
  if (!is_stored_within(set.id.get())) refuse(path, "has its values in another file");
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
  constexpr hsize_t most = hsize_t{1} << 40;  // more than any file can hold
  hsize_t size = std::min<hsize_t>(count, most);
  for (std::size_t d = 1; d < set.dims.size(); ++d)
    size = set.dims[d] > most / std::max<hsize_t>(size, 1) ? most : size * set.dims[d];
  if (!can_hold(file_size_, size))
    refuse(path, "of shape " + shape_text(set.dims) + " is too large to be true");
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

void Reader::check(const std::string& path, const std::vector<double>& values, double low,
                   double high) const {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!(values[k] >= low && values[k] <= high && std::isfinite(values[k])))
      refuse(path, "holds " + short_number(values[k]) + " at index " + std::to_string(k) + ", expected " +
                       (std::isinf(high) && std::isinf(low) ? "a finite number"
                        : std::isinf(high)                  ? "a finite number >= " + short_number(low)
                                           : short_number(low) + " to " + short_number(high)));
}

std::string Reader::read_text(const std::string& path) {
  const DataSet set = open(path);
  const Handle type(H5Dget_type(set.id.get()), H5Tclose);
  std::string text(H5Tget_size(type.get()), '\0');
  read_block(set, path, 0, 1, type.get(), text.data());
  return text.substr(0, text.find('\0'));
}

namespace {

std::optional<std::uint64_t> stored_hash(hid_t set) {
  if (H5Aexists(set, hash_attribute) <= 0) return std::nullopt;
  const Handle attribute(H5Aopen(set, hash_attribute, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose), space(H5Aget_space(attribute.get()), H5Sclose);
  std::uint64_t hash = 0;
  if (H5Tequal(type.get(), H5T_STD_U64LE) <= 0 || H5Sget_simple_extent_npoints(space.get()) != 1 ||
      H5Aread(attribute.get(), H5T_NATIVE_UINT64, &hash) < 0)
    return std::nullopt;
  return hash;
}

}  // namespace

Reader::Stored Reader::read_stored(const std::string& path) {
  const DataSet set = open(path);
  Stored stored{{set.dims.begin(), set.dims.end()}, {}, stored_hash(set.id.get())};
  if (field_of(path).type == ElementType::text) {
    const std::string text = read_text(path);
    const auto bytes = std::as_bytes(std::span(text));
    stored.values.assign(bytes.begin(), bytes.end());
  } else {
    stored.values = read_row_bytes(path, 0, rows_of(set));
  }
  return stored;
}

std::vector<std::byte> Reader::read_row_bytes(const std::string& path, std::uint64_t first,
                                              std::uint64_t count) {
  const DataSet set = open(path);
  const hid_t type = file_type(field_of(path).type);
  std::vector<std::byte> values(block_size(set, path, first, count) * H5Tget_size(type));
  read_block(set, path, first, count, type, values.data());
  return values;
}

bool Reader::has(const std::string& path) const { return find(file_.get(), path) != Found::nothing; }

std::uint64_t Reader::row_count(const std::string& path) { return rows_of(open(path)); }

std::vector<std::string> Reader::names(const std::string& group) {
  if (find(file_.get(), group) != Found::an_object) refuse(group, "(a group) is missing");
  const Handle id(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (id.get() < 0 || H5Gget_info(id.get(), &info) < 0) refuse(group, "is not a group");
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    std::array<char, 256> name{};
    H5L_info_t link{};
    H5O_info_t object{};
    if (H5Lget_name_by_idx(id.get(), ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, k, name.data(), name.size(),
                           H5P_DEFAULT) < 0 ||
        H5Lget_info(id.get(), name.data(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD ||
        H5Oget_info_by_name(id.get(), name.data(), &object, H5P_DEFAULT) < 0)
      refuse(group, "(a group) cannot be listed");
    if (object.type == H5O_TYPE_DATASET) names.emplace_back(name.data());
  }
  return names;
}

}  // namespace talus::hdf5
