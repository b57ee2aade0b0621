#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <fmt/core.h>
#include <iterator>
#include <new>

#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "io/hdf5_file.h"

namespace talus::io::hdf5 {

void set_library_policy() {
  static const int without_locks = ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
  if (without_locks != 0) throw std::bad_alloc();
  errno = 0;
  H5dont_atexit();
  if (H5open() < 0 || errno == ENOMEM) throw std::bad_alloc();  // it can start incompletely
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
}

MemoryFile in_memory(const std::string& name) {
  static std::atomic<std::uint64_t> count = 0;
  constexpr std::size_t growth = std::size_t{1} << 20;  // bytes by which the image grows
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (H5Pset_fapl_core(access.get(), growth, false) < 0 ||
      H5Pset_libver_bounds(access.get(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST) < 0)
    throw std::bad_alloc();
  return {fmt::format("/dev/null/{} {}", name, ++count), std::move(access)};
}

hid_t file_type(ElementType type) {
  const hid_t types[] = {
      H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_STD_I8LE, H5T_STD_I32LE, H5T_STD_I64LE, H5T_STD_U64LE, -1};
  return types[static_cast<std::size_t>(type)];
}

PathTarget find(hid_t file, const std::string& path) {
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    H5L_info_t link{};
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return PathTarget::nothing;
    if (H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      return PathTarget::a_link_elsewhere;
    if (slash == std::string::npos) return PathTarget::an_object;
  }
}

std::uint64_t piece_hash(const std::string& path, std::span<const std::byte> values) {
  Hasher hasher;
  hasher.add_array(path);
  hasher.add_array(values);
  return hasher.value();
}

hid_t create_space(const Shape& dims) {
  return dims.empty() ? H5Screate(H5S_SCALAR)
                      : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
}

bool select(hid_t space, const Shape& start, const Shape& block) {
  return block.empty() ||
         H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr) >= 0;
}

namespace {

/// Throws Error(out_of_memory) or Error(io_error) if the system caused a failed HDF5 call on `name`, a file
/// or one of its data sets. HDF5 does not report the cause reliably, least of all without memory; errno does,
/// after set_library_policy. A malformed file can request more memory than exists.
void throw_cause(const std::string& name) {
  constexpr int of_the_system[] = {EIO, ENOSPC, EDQUOT, EMFILE, ENFILE, ESTALE};
  const int cause = errno;
  if (cause == ENOMEM)
    throw Error(
        ExitCode::out_of_memory,
        name + ": out of memory while it was read; if enough memory is available, the file is malformed");
  if (std::ranges::find(of_the_system, cause) != std::end(of_the_system))
    throw system_error(ExitCode::io_error, "read", name, cause);
}

/// Returns an open file. Throws Error(bad_data) if HDF5 could not open it, and the errors of throw_cause.
Handle require_open(Handle file, const std::string& name) {
  if (file.get() < 0) throw_cause(name);
  if (file.get() < 0)
    throw Error(ExitCode::bad_data, name + ": HDF5 cannot open it: it is malformed, or of another format");
  return file;
}

std::string shape_text(const Shape& dims) { return fmt::format("[{}]", joined(dims, " ")); }

bool is_fixed_text(hid_t type) { return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0; }

/// Returns the bytes before the first zero.
std::string trimmed(const std::string& text) { return text.substr(0, text.find('\0')); }

/// Whether the values of a data set are in its own file and not a view of other data sets.
bool is_stored_within(hid_t set) {
  const Handle creation(H5Dget_create_plist(set), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  return layout >= 0 && layout != H5D_VIRTUAL && H5Pget_external_count(creation.get()) == 0;
}

/// Whether a file of `file_size` bytes can hold `count` values: deflate shrinks data at most by a factor of
/// 1032, and nothing that is read at once exceeds 4 GiB of doubles.
bool can_hold(hsize_t file_size, hsize_t count) {
  constexpr hsize_t most = hsize_t{1} << 29;
  return count <= most && count / 1032 <= file_size;
}

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

/// Opens an object of a file, and what belongs to it; a failure of HDF5 is reported when the object is read.
/// Links to other files or places are not followed.
herr_t look_at(hid_t file, const char* name, const H5L_info_t* link, void*) {
  if (link != nullptr && link->type != H5L_TYPE_HARD) return 0;
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

Handle open_image(std::vector<std::byte>& image, const std::string& name, unsigned access_flags) {
  set_library_policy();
  const MemoryFile file = in_memory(name);
  if (H5Pset_file_image(file.access.get(), image.data(), image.size()) < 0)
    throw Error(ExitCode::out_of_memory, name + ": no memory to open it");
  return require_open({H5Fopen(file.path.c_str(), access_flags, file.access.get()), H5Fclose}, name);
}

std::string problem_of(double value, std::size_t index, Range range) {
  return fmt::format("holds {:.6g} at index {}, expected {}", value, index,
                     std::isinf(range.high) && std::isinf(range.low) ? "a finite number"
                     : std::isinf(range.high) ? fmt::format("a finite number >= {:.6g}", range.low)
                                              : fmt::format("{:.6g} to {:.6g}", range.low, range.high));
}

Reader::Reader(Handle file, const std::string& name, Sizes sizes)
    : file_(std::move(file)), name_(name), sizes_(std::move(sizes)) {
  if (H5Fget_filesize(file_.get(), &file_size_) < 0) file_size_ = 0;
}

Reader Reader::again() const { return {Handle(H5Freopen(file_.get()), H5Fclose), name_, {}}; }

Reader Reader::from_memory(std::vector<std::byte> image, const std::string& name, const Sizes& known) {
  return {open_image(image, name, H5F_ACC_RDONLY), name, known};
}

Reader Reader::from_file(const std::string& path) {
  set_library_policy();
  return {require_open({H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose}, path), path, {}};
}

void Reader::refuse(const std::string& path, const std::string& problem) const {
  const std::string data_set = fmt::format("{}: data set {}", name_, path);
  throw_cause(data_set);
  throw Error(ExitCode::bad_data, "{} {}", data_set, problem);
}

void Reader::check_shape(const DataSetField& field, const Shape& dims) {
  const std::vector<Extent> shape = extents(field);
  bool fits = dims.size() == shape.size();
  for (std::size_t d = 0; fits && d < dims.size(); ++d) {
    const auto [symbol, plus] = shape[d];
    fits = symbol == '\0'
               ? dims[d] == plus
               : dims[d] >= plus && sizes_.emplace(symbol, dims[d] - plus).first->second == dims[d] - plus;
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
  require(path);
  DataSet set{Handle(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose), {}, {}, path};
  if (set.id.get() < 0) refuse(path, "cannot be opened: it is not a data set");
  set.type = Handle(H5Dget_type(set.id.get()), H5Tclose);
  if (!is_stored_within(set.id.get())) refuse(path, "has its values in another file");
  const Handle space(H5Dget_space(set.id.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  set.dims.resize(std::max(rank, 0));
  if (rank < 0 || H5Sget_simple_extent_dims(space.get(), set.dims.data(), nullptr) != rank)
    refuse(path, "has no shape");
  return set;
}

DataSet Reader::open(const DataSetField& field) {
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
  Shape start(set.dims.size(), 0), block = set.dims;
  if (rows && !block.empty()) {
    start[0] = rows->first;
    block[0] = rows->count;
  }
  if (std::ranges::count(block, 0u) > 0) return;
  const Handle space(H5Dget_space(set.id.get()), H5Sclose), memory(create_space(block), H5Sclose);
  if (!select(space.get(), start, block)) refuse(set.path, "cannot be selected");
  if (H5Dread(set.id.get(), type, memory.get(), space.get(), H5P_DEFAULT, values) < 0)
    refuse(set.path, "cannot be read");
}

std::string Reader::read_text(const std::string& path) {
  const DataSet set = open(field_of(path));
  std::string text(H5Tget_size(set.type.get()), '\0');
  read_block(set, {}, set.type.get(), text.data());
  return trimmed(text);
}

bool Reader::is_as_written(const std::string& path) {
  const DataSetField field = field_of(path);
  const DataSet set = open(field);
  const std::optional<std::uint64_t> hash = stored_hash(set.id.get());
  if (!hash) return false;
  std::string values(block_size(set, {}) * H5Tget_size(set.type.get()), '\0');
  read_block(set, {}, set.type.get(), values.data());
  if (field.type == ElementType::text) values = trimmed(values);
  return *hash == piece_hash(path, std::as_bytes(std::span(values)));
}

bool Reader::has(const std::string& path) const { return find(file_.get(), path) != PathTarget::nothing; }

std::uint64_t Reader::row_count(const std::string& path) {
  const DataSet set = open(field_of(path));
  return set.dims.empty() ? 1 : set.dims[0];
}

void Reader::walk() const {
  look_at(file_.get(), "/", nullptr, nullptr);
  H5Lvisit(file_.get(), H5_INDEX_NAME, H5_ITER_NATIVE, look_at, nullptr);
}

std::string Reader::attribute(const std::string& path, const char* name) const {
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
  return trimmed(text);
}

std::vector<std::string> Reader::names(const std::string& group) const {
  if (find(file_.get(), group) != PathTarget::an_object) refuse(group, "(a group) is missing");
  const Handle id(H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (id.get() < 0 || H5Gget_info(id.get(), &info) < 0) refuse(group, "is not a group");
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    std::array<char, 256> name{};
    H5L_info_t link{};
    if (H5Lget_name_by_idx(id.get(), ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, k, name.data(), name.size(),
                           H5P_DEFAULT) < 0 ||
        H5Lget_info(id.get(), name.data(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      refuse(group, "(a group) cannot be listed");
    // Reading a damaged object reports it, and leaves the others readable.
    const Handle object(H5Oopen(id.get(), name.data(), H5P_DEFAULT), H5Oclose);
    if (object.get() < 0 || H5Iget_type(object.get()) == H5I_DATASET) names.emplace_back(name.data());
  }
  return names;
}

}  // namespace talus::io::hdf5
