#include <filesystem>
#include <fmt/core.h>
#include <system_error>

#include "core/errors.h"
#include "io/byte_code.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/hdf5_handle.h"
#include "io/plain_file.h"

namespace talus {
namespace {

using Bytes = std::vector<std::byte>;
using hdf5::Handle;

[[noreturn]] void refuse(const std::string& path, const std::string& item, const std::string& problem) {
  throw Error(ExitCode::bad_data, fmt::format("{}: {} {}", path, item, problem));
}

std::vector<hsize_t> dimensions_of(const Handle& space) {
  const int rank = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> dims(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  if (!dims.empty()) H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr);
  return dims;
}

/// The file as the child has it: open in memory.
struct OpenPlainFile {
  std::string path;
  hsize_t size;  ///< bytes
  Handle file;
  PlainFile found = {};
};

/// The texts of an attribute of fixed length; nothing where it holds something else.
std::vector<std::string> attribute_texts(const OpenPlainFile& open, hid_t object, const std::string& item,
                                         const std::string& name, bool& is_list) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) return {};
  const std::size_t length = H5Tget_size(type.get());
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (length == 0 || count < 1) return {};
  if (length > open.size || static_cast<hsize_t>(count) > open.size / length)
    refuse(open.path, item, fmt::format("has an attribute {} of an impossible size", name));
  std::string padded(length * static_cast<std::size_t>(count), '\0');
  if (H5Aread(attribute.get(), type.get(), padded.data()) < 0)
    refuse(open.path, item, fmt::format("has an attribute {} that cannot be read", name));
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < padded.size(); k += length) {
    texts.push_back(padded.substr(k, length));
    texts.back().resize(std::min(texts.back().find('\0'), length));
  }
  is_list = H5Sget_simple_extent_ndims(space.get()) > 0;
  return texts;
}

std::vector<std::string> attribute_names(hid_t object) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* all) -> herr_t {
    static_cast<std::vector<std::string>*>(all)->emplace_back(name);
    return 0;
  };
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  return names;
}

/// Adds all texts of an object; returns its unit.
std::string take_texts(OpenPlainFile& open, hid_t object, const std::string& item) {
  std::string unit;
  for (const std::string& name : attribute_names(object)) {
    bool is_list = false;
    std::vector<std::string> texts = attribute_texts(open, object, item, name, is_list);
    if (texts.empty() || name == "definition") continue;
    if (name == "unit")
      unit = texts.front();
    else
      open.found.texts.push_back({item, name, std::move(texts), is_list});
  }
  return unit;
}

/// Whether an array has the values that were hashed when it was written; one without a hash is not asked.
template <typename T>
bool has_its_hash(hid_t set, const std::string& item, const std::vector<T>& values) {
  if (H5Aexists(set, hdf5::hash_attribute) <= 0) return true;
  const Handle attribute(H5Aopen(set, hdf5::hash_attribute, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  std::uint64_t hash = 0;
  return H5Sget_simple_extent_npoints(space.get()) == 1 &&
         H5Aread(attribute.get(), H5T_NATIVE_UINT64, &hash) >= 0 &&
         hash == hdf5::piece_hash(item, std::as_bytes(std::span(values)));
}

template <typename T>
std::vector<T> numbers_of(const OpenPlainFile& open, hid_t set, const std::string& item, std::size_t count) {
  std::vector<T> values(count);
  if (count > 0 && H5Dread(set, hdf5::memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    refuse(open.path, item, "cannot be read");
  if (!has_its_hash(set, item, values)) refuse(open.path, item, "was changed since talus wrote it");
  return values;
}

void take_array(OpenPlainFile& open, hid_t set, const std::string& item) {
  const Handle type(H5Dget_type(set), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) return;
  if (!hdf5::is_stored_within(set)) refuse(open.path, item, "has its values in another file");
  const Handle space(H5Dget_space(set), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0 || !hdf5::can_hold(open.size, static_cast<hsize_t>(count)))
    refuse(open.path, item, "has an impossible size");
  PlainArray array{item, {}, take_texts(open, set, item), "", {}, {}};
  for (const hsize_t extent : dimensions_of(space)) array.shape.push_back(extent);
  if (kind == H5T_FLOAT)
    array.values = numbers_of<double>(open, set, item, static_cast<std::size_t>(count));
  else
    array.integers = numbers_of<std::uint64_t>(open, set, item, static_cast<std::size_t>(count));
  open.found.arrays.push_back(std::move(array));
}

void take_object(OpenPlainFile& open, const std::string& item) {
  const Handle object(H5Oopen(open.file.get(), item.c_str(), H5P_DEFAULT), H5Oclose);
  if (object.get() < 0) refuse(open.path, item, "cannot be opened");
  const H5I_type_t kind = H5Iget_type(object.get());
  if (kind == H5I_GROUP) take_texts(open, object.get(), item);
  if (kind == H5I_DATASET) take_array(open, object.get(), item);
}

PlainFile all_of(OpenPlainFile& open) {
  if (open.file.get() < 0) throw Error(ExitCode::bad_data, open.path + ": is not an HDF5 file");
  struct Found {
    std::vector<std::string> items = {"/"}, links;
  } found;
  const auto add = [](hid_t, const char* name, const H5L_info_t* link, void* all) -> herr_t {
    Found& into = *static_cast<Found*>(all);
    (link->type == H5L_TYPE_HARD ? into.items : into.links).push_back(std::string("/") + name);
    return 0;
  };
  if (H5Lvisit(open.file.get(), H5_INDEX_NAME, H5_ITER_NATIVE, add, &found) < 0)
    refuse(open.path, "/", "cannot be listed");
  if (!found.links.empty())
    refuse(open.path, found.links.front(), "is a link to another place, which is not followed");
  for (const std::string& item : found.items) take_object(open, item);
  return std::move(open.found);
}

void append_strings(Bytes& bytes, const std::vector<std::string>& texts) {
  append_number(bytes, texts.size());
  for (const std::string& text : texts) append_counted(bytes, text);
}

std::vector<std::string> take_strings(ByteSource& source) {
  std::vector<std::string> texts;
  for (std::uint64_t left = source.number(); left > 0 && !source.at_end(); --left)
    texts.push_back(source.counted<std::string>());
  return texts;
}

}  // namespace

Bytes encode(const PlainFile& file) {
  Bytes bytes;
  append_number(bytes, file.texts.size());
  for (const PlainTexts& texts : file.texts) {
    append_strings(bytes, {texts.path, texts.name});
    append_strings(bytes, texts.texts);
    append_number(bytes, texts.is_list ? 1 : 0);
  }
  for (const PlainArray& array : file.arrays) {
    append_strings(bytes, {array.path, array.unit});
    append_counted(bytes, array.shape);
    append_counted(bytes, array.values);
    append_counted(bytes, array.integers);
  }
  return bytes;
}

PlainFile decode_plain(std::span<const std::byte> bytes, const std::string& path) {
  ByteSource source(bytes);
  PlainFile file;
  std::uint64_t texts_left = source.number();
  bool makes_sense = true;
  for (; makes_sense && texts_left > 0 && !source.at_end(); --texts_left) {
    const std::vector<std::string> names = take_strings(source);
    std::vector<std::string> texts = take_strings(source);
    makes_sense = names.size() == 2 && !texts.empty();
    if (makes_sense) file.texts.push_back({names[0], names[1], std::move(texts), source.number() != 0});
  }
  makes_sense = makes_sense && texts_left == 0;
  while (makes_sense && !source.at_end()) {
    const std::vector<std::string> names = take_strings(source);
    makes_sense = names.size() == 2;
    if (!makes_sense) break;
    PlainArray array{names[0], source.counted<std::vector<std::size_t>>(), names[1], "", {}, {}};
    array.values = source.counted<std::vector<double>>();
    array.integers = source.counted<std::vector<std::uint64_t>>();
    file.arrays.push_back(std::move(array));
  }
  if (!makes_sense || !source.succeeded())
    throw Error(ExitCode::bad_data, path + ": cannot be read: HDF5 reads nonsense from it");
  return file;
}

PlainFile read_plain_file(const std::string& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown))
    throw Error(ExitCode::missing_input, path + " is a folder; expected an HDF5 file");
  Bytes bytes = read_file(path);
  if (bytes.empty()) throw Error(ExitCode::bad_data, path + ": is empty");
  const auto work = [&] {
    OpenPlainFile open{path, bytes.size(), hdf5::open_image(bytes, path, H5F_ACC_RDONLY)};
    return encode(all_of(open));
  };
  return decode_plain(in_child_process(path, bytes.size(), work), path);
}

}  // namespace talus
