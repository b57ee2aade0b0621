#include "io/hdf5_writer.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <utility>

#include "base/errors.h"
#include "base/visible_text.h"

namespace talus::io::hdf5 {
namespace {

constexpr std::size_t growth = std::size_t{1} << 20;  // bytes by which the image in memory grows
constexpr hsize_t series_chunk = 1 << 16;             // rows of a series per chunk
constexpr unsigned deflate_level = 4;

/// Returns the result of HDF5 unless it failed; in memory, the cause of a failure is lack of memory.
template <typename Result>
Result checked(Result result, const std::string& action) {
  if (result >= 0) return result;
  throw Error(
      ExitCode::out_of_memory,
      fmt::format("out of memory: HDF5 cannot {} in memory; use a smaller bed (bed.length, bed.depth)",
                  action));
}

std::string parent_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

Handle text_type(std::size_t length) {
  Handle type(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
  checked(H5Tset_size(type.get(), std::max<std::size_t>(1, length)), "set the length of a text");
  checked(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "set the padding of a text");
  checked(H5Tset_cset(type.get(), H5T_CSET_UTF8), "set the character set of a text");
  return type;
}

Handle space_of(const std::vector<hsize_t>& dims) {
  const hid_t space = dims.empty() ? H5Screate(H5S_SCALAR)
                                   : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
  return Handle(checked(space, "create a shape"), H5Sclose);
}

void attach(hid_t object, const char* name, hid_t type, const std::vector<hsize_t>& dims, const void* data) {
  const Handle space = space_of(dims);
  const Handle attribute(checked(H5Acreate2(object, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                                 std::string("create attribute ") + name),
                         H5Aclose);
  checked(H5Awrite(attribute.get(), type, data), std::string("write attribute ") + name);
}

void attach_text(hid_t object, const char* name, const std::string& text) {
  attach(object, name, text_type(text.size()).get(), {}, text.c_str());
}

void attach_hash(hid_t object, std::uint64_t hash) {
  attach(object, hash_attribute, H5T_STD_U64LE, {}, &hash);
}

Handle properties(hid_t kind) {
  Handle list(checked(H5Pcreate(kind), "create properties"), H5Pclose);
  if (kind != H5P_FILE_ACCESS && kind != H5P_FILE_CREATE && kind != H5P_DATASET_ACCESS)
    checked(H5Pset_obj_track_times(list.get(), false), "leave out times");  // equal runs give equal bytes
  return list;
}

/// Keeps names in writing order inside their group; a separate index would grow at the end of the file and be
/// lost with it.
void keep_names_in_order(const Handle& creation, const std::string& path) {
  constexpr unsigned max_in_group = 10000;
  checked(H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          "keep the order of " + path);
  checked(H5Pset_link_phase_change(creation.get(), max_in_group, 0), "keep the names of " + path);
}

/// Returns the shape of a chunk; empty for contiguous data.
std::vector<hsize_t> chunk_of(const DataSetField& field, const std::vector<hsize_t>& dims,
                              const Sizes& sizes) {
  if (dims.empty() || std::ranges::count(dims, 0u) > 0) return {};
  std::vector<hsize_t> chunk = dims;
  const char symbol = extents(field).front().symbol;
  if (symbol == 'T' && field.shape.find('N') != std::string::npos)
    chunk[0] = 1;
  else if (symbol == 'M')
    chunk[0] = (dims[0] + sizes.at('T') - 1) / sizes.at('T');  // about one frame
  else if (symbol == 'R' || symbol == 'S')
    chunk[0] = std::min(dims[0], series_chunk);
  else
    return {};
  return chunk;
}

Handle creation_properties(ElementType type, const std::vector<hsize_t>& chunk) {
  Handle list = properties(H5P_DATASET_CREATE);
  if (type == ElementType::float32 || type == ElementType::float64) {
    const double nan = std::numeric_limits<double>::quiet_NaN();  // an unwritten value must not read as zero
    checked(H5Pset_fill_value(list.get(), H5T_NATIVE_DOUBLE, &nan), "set the fill value");
  }
  if (chunk.empty()) return list;
  checked(H5Pset_chunk(list.get(), static_cast<int>(chunk.size()), chunk.data()), "set the chunks");
  checked(H5Pset_shuffle(list.get()), "shuffle");
  checked(H5Pset_deflate(list.get(), deflate_level), "deflate");
  return list;
}

/// Sizes the chunk cache for the chunk being filled. Preceding chunks are then in the file, frame by frame,
/// and a truncated packed file keeps the frames before the cut.
Handle access_properties(ElementType type, const std::vector<hsize_t>& chunk) {
  std::size_t bytes = size_of(type);
  for (hsize_t extent : chunk) bytes *= extent;
  Handle access = properties(H5P_DATASET_ACCESS);
  checked(H5Pset_chunk_cache(access.get(), H5D_CHUNK_CACHE_NSLOTS_DEFAULT, bytes, 1.0),
          "size the chunk cache");
  return access;
}

}  // namespace

Writer::Writer(Sizes sizes, std::size_t user_block, Storage storage)
    : sizes_(std::move(sizes)), user_block_(user_block), storage_(storage) {
  set_library_policy();
  const Handle access = in_memory(growth);
  const Handle creation = properties(H5P_FILE_CREATE);
  checked(H5Pset_userblock(creation.get(), user_block), "keep a user block");
  keep_names_in_order(creation, "/");
  checked(H5Pset_est_link_info(creation.get(), 16, 12), "make room for groups");
  file_ =
      Handle(checked(H5Fcreate(memory_name("written").c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
                     "create a file"),
             H5Fclose);
}

Writer::Writer(Sizes sizes, std::size_t user_block, std::vector<std::byte> image, const std::string& name)
    : sizes_(std::move(sizes)), user_block_(user_block), name_(name) {
  const FileInUse in_use(name_);
  file_ = open_image(image, name, H5F_ACC_RDWR);
}

Writer::~Writer() {
  const FileInUse in_use(name_);
  open_.clear();
  file_ = Handle();
}

void Writer::create(const DataSetField& field) {
  const FileInUse in_use(name_);
  create_group(parent_of(field.path));
  DataSet set;
  const std::vector<std::uint64_t> shape = dimensions(field, sizes_);
  set.dims.assign(shape.begin(), shape.end());
  const std::vector<hsize_t> chunk =
      storage_ == Storage::compressed ? chunk_of(field, set.dims, sizes_) : std::vector<hsize_t>{};
  const Handle space = space_of(set.dims);
  const Handle creation = creation_properties(field.type, chunk);
  const Handle access = access_properties(field.type, chunk);
  set.id = Handle(checked(H5Dcreate2(file_.get(), field.path.c_str(), file_type(field.type), space.get(),
                                     H5P_DEFAULT, creation.get(), access.get()),
                          "create " + field.path),
                  H5Dclose);
  attach_text(set.id.get(), "unit", field.unit);
  contents_.append(field.path).append("\n");
  open_.insert_or_assign(field.path, std::move(set));
}

void Writer::write_rows(const DataSetField& field, std::uint64_t first_row,
                        std::span<const std::byte> values) {
  const FileInUse in_use(name_);
  const DataSet& set = open_.at(field.path);
  const std::size_t count = values.size() / size_of(field.type);
  std::vector<hsize_t> block = set.dims, start(set.dims.size(), 0);
  std::size_t row = 1;
  for (std::size_t d = 1; d < block.size(); ++d) row *= block[d];
  if (!block.empty()) {
    start[0] = first_row;
    block[0] = row > 0 ? count / row : 0;
  }
  const std::size_t expected = block.empty() ? 1 : block[0] * row;
  if (count != expected || (!block.empty() && start[0] + block[0] > set.dims[0]))
    throw Error(ExitCode::internal,
                fmt::format("{} values from row {} do not fit into {}", count, first_row, field.path));
  if (count == 0) return;
  const Handle space = space_of(set.dims), memory = space_of(block);
  if (!block.empty())
    checked(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr),
            "select rows of " + field.path);
  checked(
      H5Dwrite(set.id.get(), file_type(field.type), memory.get(), space.get(), H5P_DEFAULT, values.data()),
      "write " + field.path);
}

void Writer::write_bytes(const DataSetField& field, std::span<const std::byte> values, hid_t type) {
  const FileInUse in_use(name_);
  create(field);
  if (H5Tequal(type, file_type(field.type)) <= 0)
    throw Error(ExitCode::internal, "values whose type is not that of " + field.path);
  write_rows(field, 0, values);
  attach_hash(open_.at(field.path).id.get(), piece_hash(field.path, values));
}

Handle Writer::put_text(const std::string& path, const std::string& text, const std::string& unit) {
  const FileInUse in_use(name_);
  create_group(parent_of(path));
  const Handle type = text_type(text.size()), space = space_of({}), creation = properties(H5P_DATASET_CREATE);
  Handle set(checked(H5Dcreate2(file_.get(), path.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                creation.get(), H5P_DEFAULT),
                     "create " + path),
             H5Dclose);
  checked(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), "write " + path);
  attach_text(set.get(), "unit", unit);
  return set;
}

void Writer::write_text(const DataSetField& field, const std::string& bytes) {
  const FileInUse in_use(name_);
  const std::string text = utf8(bytes);
  const Handle set = put_text(field.path, text, field.unit);
  attach_hash(set.get(), piece_hash(field.path, std::as_bytes(std::span(text))));
  contents_.append(field.path).append("\n");
}

void Writer::write_help(const std::string& path, const std::string& text) {
  const FileInUse in_use(name_);
  put_text("/help" + path, text, "1");
}

void Writer::create_group(const std::string& path) {
  const FileInUse in_use(name_);
  if (path.empty()) return;
  create_group(parent_of(path));
  if (checked(H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT), "look for " + path) > 0) return;
  const Handle creation = properties(H5P_GROUP_CREATE);
  keep_names_in_order(creation, path);
  const Handle group(checked(H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                             "create " + path),
                     H5Gclose);
}

void Writer::link(const std::string& path, const std::string& second_path) {
  const FileInUse in_use(name_);
  checked(
      H5Lcreate_hard(file_.get(), path.c_str(), file_.get(), second_path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      "link " + second_path);
}

void Writer::set_attribute(const std::string& path, const char* name,
                           const std::vector<std::int32_t>& values) {
  const FileInUse in_use(name_);
  std::vector<hsize_t> dims;
  if (values.size() > 1) dims.push_back(values.size());
  attach(object_at(path).get(), name, H5T_STD_I32LE, dims, values.data());
}

void Writer::set_attribute(const std::string& path, const char* name, const std::vector<std::string>& texts) {
  const FileInUse in_use(name_);
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::string padded;
  for (const std::string& text : texts) padded += text + std::string(length - text.size(), '\0');
  attach(object_at(path).get(), name, text_type(length).get(), {texts.size()}, padded.data());
}

void Writer::set_attribute(const std::string& path, const char* name, const std::string& text) {
  const FileInUse in_use(name_);
  attach_text(object_at(path).get(), name, text);
}

Handle Writer::object_at(const std::string& path) {
  const FileInUse in_use(name_);
  create_group(path);
  return {checked(H5Oopen(file_.get(), path.c_str(), H5P_DEFAULT), "open " + path), H5Oclose};
}

void Writer::remove(const std::string& path) {
  const FileInUse in_use(name_);
  if (find(file_.get(), path) != PathTarget::nothing)
    checked(H5Ldelete(file_.get(), path.c_str(), H5P_DEFAULT), "remove " + path);
}

void Writer::write_contents() {
  const FileInUse in_use(name_);
  checked(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), "write values to a file");
  write_text("/contents", contents_);
}

std::vector<std::byte> Writer::image() {
  const FileInUse in_use(name_);
  checked(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), "complete a file");
  const ssize_t size = checked(H5Fget_file_image(file_.get(), nullptr, 0), "get the size of a file");
  std::vector<std::byte> bytes(user_block_ + static_cast<std::size_t>(size));
  checked(H5Fget_file_image(file_.get(), bytes.data() + user_block_, static_cast<std::size_t>(size)),
          "copy a file");
  return bytes;
}

}  // namespace talus::io::hdf5
