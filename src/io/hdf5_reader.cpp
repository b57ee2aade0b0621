#include "io/hdf5_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <span>

#include "base/errors.h"
#include "base/text.h"

namespace talus::io::hdf5 {
namespace {

hsize_t size_of(const Handle& file) {
  hsize_t size = 0;
  return H5Fget_filesize(file.get(), &size) < 0 ? 0 : size;
}

std::string shape_text(const std::vector<hsize_t>& dims) { return fmt::format("[{}]", joined(dims, " ")); }

bool is_fixed_text(hid_t type) { return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0; }

}  // namespace

Reader::Reader(Handle file, std::string name, Sizes sizes)
    : file_(std::move(file)), file_size_(size_of(file_)), name_(std::move(name)), sizes_(std::move(sizes)) {}

Reader& Reader::operator=(Reader&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(file_size_, other.file_size_);
  std::swap(name_, other.name_);
  std::swap(sizes_, other.sizes_);
  return *this;
}

Reader::~Reader() {
  const FileInUse in_use(name_);
  file_ = Handle();
}

Reader Reader::again() const {
  const FileInUse in_use(name_);
  return {Handle(H5Freopen(file_.get()), H5Fclose), name_, {}};
}

Reader Reader::from_memory(std::vector<std::byte> image, const std::string& name, const Sizes& known) {
  const FileInUse in_use(name);
  return {open_image(image, name, H5F_ACC_RDONLY), name, known};
}

Reader Reader::from_file(const std::string& path) {
  const FileInUse in_use(path);
  set_library_policy();
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  return {require_open(std::move(file), path), path, {}};
}

void Reader::refuse(const std::string& path, const std::string& problem) const {
  const std::string data_set = fmt::format("{}: data set {}", name_, path);
  throw_cause(data_set);
  throw Error(ExitCode::bad_data, fmt::format("{} {}", data_set, problem));
}

void Reader::check_shape(const DataSetField& field, const std::vector<hsize_t>& dims) {
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
      expected += fmt::format("{}{} = {}", expected.empty() ? " with " : ", ", symbol, size);
  refuse(field.path, fmt::format("has shape {}, expected [{}]{}", shape_text(dims), field.shape, expected));
}

/// Throws unless this file contains an object at that path.
void Reader::require(const std::string& path) const {
  const PathTarget found = find(file_.get(), path);
  if (found == PathTarget::nothing) refuse(path, "is missing");
  if (found == PathTarget::a_link_elsewhere)
    refuse(path, "is a link to another place, which is not followed");
}

DataSet Reader::open(const std::string& path) const {
  const FileInUse in_use(name_);
  require(path);
  DataSet set{Handle(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose), {}, {}, path};
  if (set.id.get() < 0) refuse(path, "cannot be opened: it is not a data set");
  set.type = Handle(H5Dget_type(set.id.get()), H5Tclose);
  if (!is_stored_within(set.id.get())) refuse(path, "has its values in another file");
  const Handle space(H5Dget_space(set.id.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) refuse(path, "has no shape");
  set.dims.resize(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space.get(), set.dims.data(), nullptr) != rank) refuse(path, "has no shape");
  return set;
}

DataSet Reader::open(const DataSetField& field) {
  const FileInUse in_use(name_);
  DataSet set = open(field.path);
  const bool is_text = field.type == ElementType::text;
  const bool same =
      is_text ? is_fixed_text(set.type.get()) : H5Tequal(set.type.get(), file_type(field.type)) > 0;
  if (!same) refuse(field.path, fmt::format("is not of the type {}", type_name(field.type)));
  if (is_text && !can_hold(file_size_, H5Tget_size(set.type.get())))
    refuse(field.path, "is longer than the file can hold");
  check_shape(field, set.dims);
  return set;
}

DataSet Reader::open_numbers(const std::string& path, bool of_reals) const {
  const FileInUse in_use(name_);
  DataSet set = open(path);
  const H5T_class_t kind = H5Tget_class(set.type.get());
  if (kind != H5T_INTEGER && !(of_reals && kind == H5T_FLOAT))
    refuse(path, of_reals ? "does not hold numbers" : "does not hold integers");
  return set;
}

std::size_t Reader::block_size(const DataSet& set, std::optional<Rows> rows) const {
  if (set.dims.empty()) return 1;
  const Rows block = rows.value_or(Rows{0, set.dims[0]});
  if (block.count > set.dims[0] || block.first > set.dims[0] - block.count)
    refuse(set.path,
           fmt::format("has {} rows; row {} was requested", set.dims[0], block.first + block.count));
  constexpr hsize_t most = hsize_t{1} << 40;  // more than any file can hold
  hsize_t size = std::min<hsize_t>(block.count, most);
  for (std::size_t d = 1; d < set.dims.size(); ++d)
    size = set.dims[d] > most / std::max<hsize_t>(size, 1) ? most : size * set.dims[d];
  if (!can_hold(file_size_, size))
    refuse(set.path, fmt::format("of shape {} is larger than the file can hold", shape_text(set.dims)));
  return size;
}

void Reader::read_block(const DataSet& set, std::optional<Rows> rows, hid_t type, void* values) const {
  const FileInUse in_use(name_);
  std::vector<hsize_t> start(set.dims.size(), 0), block = set.dims;
  if (rows && !block.empty()) {
    start[0] = rows->first;
    block[0] = rows->count;
  }
  if (std::ranges::count(block, 0u) > 0) return;
  const Handle space(H5Dget_space(set.id.get()), H5Sclose);
  const Handle memory(block.empty() ? H5Screate(H5S_SCALAR)
                                    : H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                      H5Sclose);
  if (!block.empty() &&
      H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr) < 0)
    refuse(set.path, "cannot be selected");
  if (H5Dread(set.id.get(), type, memory.get(), space.get(), H5P_DEFAULT, values) < 0)
    refuse(set.path, "cannot be read");
}

std::string problem_of(double value, std::size_t index, Range range) {
  return fmt::format("holds {:.6g} at index {}, expected {}", value, index,
                     std::isinf(range.high) && std::isinf(range.low) ? "a finite number"
                     : std::isinf(range.high) ? fmt::format("a finite number >= {:.6g}", range.low)
                                              : fmt::format("{:.6g} to {:.6g}", range.low, range.high));
}

void Reader::refuse_value(const std::string& path, double value, std::size_t index, Range range) const {
  refuse(path, problem_of(value, index, range));
}

std::string Reader::read_text(const std::string& path) {
  const FileInUse in_use(name_);
  const DataSet set = open(field_of(path));
  std::string text(H5Tget_size(set.type.get()), '\0');
  read_block(set, {}, set.type.get(), text.data());
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

bool Reader::is_as_written(const std::string& path) {
  const FileInUse in_use(name_);
  const DataSetField field = field_of(path);
  const DataSet set = open(field);
  const std::optional<std::uint64_t> hash = stored_hash(set.id.get());
  if (!hash) return false;
  if (field.type == ElementType::text) {
    const std::string text = read_text(path);
    return *hash == piece_hash(path, std::as_bytes(std::span(text)));
  }
  const hid_t type = file_type(field.type);
  std::vector<std::byte> values(block_size(set, {}) * H5Tget_size(type));
  read_block(set, {}, type, values.data());
  return *hash == piece_hash(path, values);
}

bool Reader::has(const std::string& path) const {
  const FileInUse in_use(name_);
  return find(file_.get(), path) != PathTarget::nothing;
}

std::uint64_t Reader::row_count(const std::string& path) {
  const FileInUse in_use(name_);
  const DataSet set = open(field_of(path));
  return set.dims.empty() ? 1 : set.dims[0];
}

std::vector<std::string> Reader::data_sets(const std::string& group) const {
  std::vector<std::string> paths;
  for (const std::string& name : names(group)) paths.push_back(fmt::format("{}/{}", group, name));
  for (const std::string& name : names(group, H5O_TYPE_GROUP))
    for (std::string& path : data_sets(fmt::format("{}/{}", group, name))) paths.push_back(std::move(path));
  return paths;
}

namespace {

/// Opens an object of a file, and what belongs to it; a failure of HDF5 is reported when the object is read.
herr_t look_at(hid_t file, const char* name, const ObjectInfo*, void*) {
  const Handle object(H5Oopen(file, name, H5P_DEFAULT), H5Oclose);
  const int attributes = object.get() < 0 ? 0 : H5Aget_num_attrs(object.get());
  for (int k = 0; k < attributes; ++k) {
    const Handle attribute(H5Aopen_by_idx(object.get(), ".", H5_INDEX_NAME, H5_ITER_NATIVE,
                                          static_cast<hsize_t>(k), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    const Handle type(H5Aget_type(attribute.get()), H5Tclose), space(H5Aget_space(attribute.get()), H5Sclose);
  }
  if (H5Iget_type(object.get()) != H5I_DATASET) return 0;
  const Handle type(H5Dget_type(object.get()), H5Tclose), space(H5Dget_space(object.get()), H5Sclose),
      creation(H5Dget_create_plist(object.get()), H5Pclose);
  hsize_t chunks = 0;
  if (H5Pget_layout(creation.get()) == H5D_CHUNKED) H5Dget_num_chunks(object.get(), H5S_ALL, &chunks);
  return 0;
}

}  // namespace

void Reader::walk() const {
  const FileInUse in_use(name_);
  visit_objects(file_.get(), H5_ITER_NATIVE, look_at, nullptr);
}

std::string Reader::attribute(const std::string& path, const char* name) const {
  const FileInUse in_use(name_);
  require(path);
  const Handle object(H5Oopen(file_.get(), path.c_str(), H5P_DEFAULT), H5Oclose);
  const Handle attribute(H5Aopen(object.get(), name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose), space(H5Aget_space(attribute.get()), H5Sclose);
  if (!is_fixed_text(type.get()) || H5Sget_simple_extent_npoints(space.get()) != 1 ||
      !can_hold(file_size_, H5Tget_size(type.get())))
    refuse(path, fmt::format("has no text attribute {}", name));
  std::string text(H5Tget_size(type.get()), '\0');
  if (H5Aread(attribute.get(), type.get(), text.data()) < 0)
    refuse(path, fmt::format("has an attribute {} that cannot be read", name));
  return text.substr(0, text.find('\0'));
}

std::vector<std::string> Reader::names(const std::string& group, H5O_type_t kind) const {
  const FileInUse in_use(name_);
  if (find(file_.get(), group) != PathTarget::an_object) refuse(group, "(a group) is missing");
  const Handle id(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (id.get() < 0 || H5Gget_info(id.get(), &info) < 0) refuse(group, "is not a group");
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    std::array<char, 256> name{};
    H5L_info_t link{};
    ObjectInfo object{};
    if (H5Lget_name_by_idx(id.get(), ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, k, name.data(), name.size(),
                           H5P_DEFAULT) < 0 ||
        H5Lget_info(id.get(), name.data(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD ||
        object_info(id.get(), name.data(), object) < 0)
      refuse(group, "(a group) cannot be listed");
    if (object.type == kind) names.emplace_back(name.data());
  }
  return names;
}

}  // namespace talus::io::hdf5
