#include <algorithm>
#include <limits>

#include "base/errors.h"
#include "base/text.h"
#include "io/hdf5_file.h"

namespace talus::io::hdf5 {
namespace {

/// Returns the result of HDF5 unless it failed; in memory, the cause of a failure is lack of memory.
template <typename Result>
Result checked(Result result, const std::string& action) {
  if (result >= 0) return result;
  throw Error(ExitCode::out_of_memory,
              "out of memory: HDF5 cannot {} in memory; use a smaller bed (bed.length, bed.depth)", action);
}

std::string parent_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

Handle text_type(std::size_t length) {
  Handle type(checked(H5Tcopy(H5T_C_S1), "copy a type"), H5Tclose);
  checked(H5Tset_size(type.get(), std::max<std::size_t>(1, length)), "set the length of a text");
  checked(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "set the padding of a text");
  checked(H5Tset_cset(type.get(), H5T_CSET_UTF8), "set the character set of a text");
  return type;
}

Handle space_of(const Shape& dims) { return {checked(create_space(dims), "create a shape"), H5Sclose}; }

void attach(hid_t object, const char* name, hid_t type, const Shape& dims, const void* data) {
  const Handle space = space_of(dims);
  const Handle attribute(checked(H5Acreate2(object, name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                                 std::string("create attribute ") + name),
                         H5Aclose);
  checked(H5Awrite(attribute.get(), type, data), std::string("write attribute ") + name);
}

void attach_text(hid_t object, const char* name, const std::string& text) {
  attach(object, name, text_type(text.size()).get(), {}, text.c_str());
}

void attach_hash(hid_t set, const std::string& path, std::span<const std::byte> values) {
  const std::uint64_t hash = piece_hash(path, values);
  attach(set, hash_attribute, H5T_STD_U64LE, {}, &hash);
}

Handle properties(hid_t kind) {
  Handle list(checked(H5Pcreate(kind), "create properties"), H5Pclose);
  if (kind != H5P_FILE_CREATE && kind != H5P_DATASET_ACCESS)
    checked(H5Pset_obj_track_times(list.get(), false), "leave out times");  // equal runs give equal bytes
  return list;
}

/// Keeps names in writing order inside their group; an index at the end of the file could be lost.
void keep_names_in_order(const Handle& creation, const std::string& path) {
  constexpr unsigned max_in_group = 10000;
  checked(H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          "keep the order of " + path);
  checked(H5Pset_link_phase_change(creation.get(), max_in_group, 0), "keep the names of " + path);
}

Handle creation_properties(ElementType type, const Shape& chunk) {
  constexpr unsigned deflate_level = 4;
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
Handle access_properties(ElementType type, const Shape& chunk) {
  std::size_t bytes = H5Tget_size(file_type(type));
  for (hsize_t extent : chunk) bytes *= extent;
  Handle access = properties(H5P_DATASET_ACCESS);
  checked(H5Pset_chunk_cache(access.get(), H5D_CHUNK_CACHE_NSLOTS_DEFAULT, bytes, 1.0),
          "size the chunk cache");
  return access;
}

/// Returns the shape of a chunk: single frames, long pieces of series and tables, and else empty.
Shape chunk_of(const DataSetField& field, Shape dims, const Sizes& sizes) {
  constexpr hsize_t series = 1 << 16;  // rows
  if (dims.empty() || std::ranges::count(dims, 0u) > 0) return {};
  const char symbol = field.shape[0];
  const bool is_table = dims.size() > 1 && symbol >= '0' && symbol <= '9';
  if (symbol == 'T' && field.shape.find('N') != std::string::npos)
    dims[0] = 1;
  else if (symbol == 'M')
    dims[0] = std::min(dims[0], (dims[0] + sizes.at('T') - 1) / sizes.at('T'));  // about one frame
  else if (symbol == 'R' || symbol == 'S' || is_table)
    dims[0] = std::min(dims[0], series);
  else
    return {};
  return dims;
}

Handle create_file(std::size_t user_block) {
  set_library_policy();
  const MemoryFile file = in_memory("written");
  const Handle creation = properties(H5P_FILE_CREATE);
  checked(H5Pset_userblock(creation.get(), user_block), "keep a user block");
  keep_names_in_order(creation, "/");
  checked(H5Pset_est_link_info(creation.get(), 16, 12), "make room for groups");
  return {checked(H5Fcreate(file.path.c_str(), H5F_ACC_TRUNC, creation.get(), file.access.get()),
                  "create a file"),
          H5Fclose};
}

}  // namespace

Writer::Writer(Sizes sizes, std::size_t user_block)
    : file_(create_file(user_block)), sizes_(std::move(sizes)), user_block_(user_block) {}

Writer::Writer(Sizes sizes, std::size_t user_block, std::vector<std::byte> image, const std::string& name)
    : file_(open_image(image, name, H5F_ACC_RDWR)), sizes_(std::move(sizes)), user_block_(user_block) {}

void Writer::create(const DataSetField& field) {
  const std::string& path = field.path;
  const std::vector<std::uint64_t> shape = dimensions(field, sizes_);
  DataSet set{{}, {}, Shape(shape.begin(), shape.end()), path};
  const Shape chunk = user_block_ > 0 ? chunk_of(field, set.dims, sizes_) : Shape();
  const Handle space = space_of(set.dims), creation = creation_properties(field.type, chunk),
               access = access_properties(field.type, chunk);
  create_group(parent_of(path));
  set.id = Handle(checked(H5Dcreate2(file_.get(), path.c_str(), file_type(field.type), space.get(),
                                     H5P_DEFAULT, creation.get(), access.get()),
                          "create " + path),
                  H5Dclose);
  set.type = Handle(checked(H5Dget_type(set.id.get()), "get the type of " + path), H5Tclose);
  attach_text(set.id.get(), "unit", field.unit);
  contents_.append(path).append("\n");
  open_.insert_or_assign(path, std::move(set));
}

void Writer::write_rows(const std::string& path, std::uint64_t first_row, std::span<const std::byte> values) {
  const DataSet& set = open_.at(path);
  const std::size_t count = values.size() / H5Tget_size(set.type.get());
  Shape block = set.dims, start(set.dims.size(), 0);
  std::size_t row = 1;
  for (std::size_t d = 1; d < block.size(); ++d) row *= block[d];
  if (!block.empty()) {
    start[0] = first_row;
    block[0] = row > 0 ? count / row : 0;
  }
  const std::size_t expected = block.empty() ? 1 : block[0] * row;
  if (count != expected || (!block.empty() && start[0] + block[0] > set.dims[0]))
    throw Error(ExitCode::internal, "{} values from row {} do not fit into {}", count, first_row, path);
  if (count == 0) return;
  const Handle space = space_of(set.dims), memory = space_of(block);
  checked(select(space.get(), start, block) ? 0 : -1, "select rows of " + path);
  checked(H5Dwrite(set.id.get(), set.type.get(), memory.get(), space.get(), H5P_DEFAULT, values.data()),
          "write " + path);
}

void Writer::write_all(const std::string& path, ElementType type, std::span<const std::byte> values) {
  const DataSet& set = open_.at(path);
  if (H5Tequal(set.type.get(), file_type(type)) <= 0)
    throw Error(ExitCode::internal, "values whose type is not that of " + path);
  write_rows(path, 0, values);
  attach_hash(set.id.get(), path, values);
}

Handle Writer::put_text(const std::string& path, const std::string& text, const std::string& unit) {
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
  const std::string text = utf8(bytes);
  const Handle set = put_text(field.path, text, field.unit);
  attach_hash(set.get(), field.path, std::as_bytes(std::span(text)));
  contents_.append(field.path).append("\n");
}

void Writer::write_help(const std::vector<DataSetField>& schema) {
  for (const DataSetField& field : schema)
    if (!field.path.ends_with("/*")) put_text("/help" + field.path, field.help, "1");
}

void Writer::create_group(const std::string& path) {
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
  checked(
      H5Lcreate_hard(file_.get(), path.c_str(), file_.get(), second_path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      "link " + second_path);
}

void Writer::set_attribute(const std::string& path, const char* name,
                           const std::vector<std::int32_t>& values) {
  attach(object_at(path).get(), name, H5T_STD_I32LE, values.size() > 1 ? Shape{values.size()} : Shape(),
         values.data());
}

void Writer::set_attribute(const std::string& path, const char* name, const std::vector<std::string>& texts) {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::string padded;
  for (const std::string& text : texts) padded += text + std::string(length - text.size(), '\0');
  attach(object_at(path).get(), name, text_type(length).get(), {texts.size()}, padded.data());
}

void Writer::set_attribute(const std::string& path, const char* name, const std::string& text) {
  attach_text(object_at(path).get(), name, text);
}

Handle Writer::object_at(const std::string& path) {
  create_group(path);
  return {checked(H5Oopen(file_.get(), path.c_str(), H5P_DEFAULT), "open " + path), H5Oclose};
}

void Writer::remove(const std::string& path) {
  if (find(file_.get(), path) != PathTarget::nothing)
    checked(H5Ldelete(file_.get(), path.c_str(), H5P_DEFAULT), "remove " + path);
}

void Writer::write_contents() {
  checked(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), "write values to a file");
  write_text(field_of("/contents"), contents_);
}

std::vector<std::byte> Writer::image() {
  checked(H5Fflush(file_.get(), H5F_SCOPE_LOCAL), "complete a file");
  const auto size =
      static_cast<std::size_t>(checked(H5Fget_file_image(file_.get(), nullptr, 0), "get the size of a file"));
  std::vector<std::byte> bytes(user_block_ + size);
  checked(H5Fget_file_image(file_.get(), bytes.data() + user_block_, size), "copy a file");
  return bytes;
}

}  // namespace talus::io::hdf5
