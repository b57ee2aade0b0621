#include "reliability/hostile_file.h"

#include <hdf5.h>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "base/hash.h"
#include "io/durable_file.h"
#include "io/hdf5_file.h"

namespace talus::hostile {
namespace {

using io::hdf5::Handle;

constexpr hsize_t huge_size = hsize_t{1} << 40;

constexpr std::array<const char*, harm_count> names = {"missing",        "group_instead",
                                                       "as_float64",     "as_int64",
                                                       "as_text",        "as_text_of_variable_length",
                                                       "as_compound",    "one_rank_more",
                                                       "scalar",         "empty",
                                                       "one_row_more",   "huge",
                                                       "huge_attribute", "values_in_another_file",
                                                       "external_link",  "one_value",
                                                       "all_values"};

double real_of(std::uint64_t bits) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr std::array<double, 12> troublesome = {nan,    inf, -inf, 0.0,    -1.0, 1e300,
                                                  -1e300, 1e9, -1e9, 1e-300, 0.5,  3e38};
  if (bits < troublesome.size()) return troublesome[bits];
  if (bits < 32) return static_cast<double>(bits);
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::int64_t integer_of(std::uint64_t bits) {
  constexpr std::array<std::int64_t, 10> troublesome = {-1,
                                                        std::numeric_limits<std::int64_t>::max(),
                                                        std::numeric_limits<std::int64_t>::min(),
                                                        2147483647,
                                                        -2147483648LL,
                                                        1 << 20,
                                                        127,
                                                        -128,
                                                        2,
                                                        1};
  if (bits < troublesome.size()) return troublesome[bits];
  return static_cast<std::int64_t>(bits);
}

Handle copy_of(hid_t type) { return {H5Tcopy(type), H5Tclose}; }

Handle type_for(const Spoil& spoil, hid_t own) {
  switch (spoil.harm) {
    case Harm::as_float64:
      return copy_of(H5T_IEEE_F64LE);
    case Harm::as_int64:
      return copy_of(H5T_STD_I64BE);
    case Harm::as_text:
    case Harm::as_text_of_variable_length: {
      Handle type = copy_of(H5T_C_S1);
      H5Tset_size(type.get(), spoil.harm == Harm::as_text ? 1 << 20 : H5T_VARIABLE);
      return type;
    }
    case Harm::as_compound: {
      Handle type(H5Tcreate(H5T_COMPOUND, 16), H5Tclose);
      H5Tinsert(type.get(), "x", 0, H5T_NATIVE_DOUBLE);
      H5Tinsert(type.get(), "y", 8, H5T_NATIVE_DOUBLE);
      return type;
    }
    default:
      return copy_of(own);
  }
}

std::vector<hsize_t> shape_for(const Spoil& spoil, std::vector<hsize_t> own) {
  if (spoil.harm == Harm::one_rank_more) own.push_back(1);
  if (spoil.harm == Harm::scalar) own.clear();
  if (own.empty() && spoil.harm != Harm::scalar && spoil.harm >= Harm::empty && spoil.harm <= Harm::huge)
    own.push_back(1);
  if (spoil.harm == Harm::empty) own[0] = 0;
  if (spoil.harm == Harm::one_row_more) ++own[0];
  if (spoil.harm == Harm::huge) own.assign(own.size(), huge_size >> (8 * (own.size() - 1)));
  return own;
}

Handle space_of(const std::vector<hsize_t>& shape) {
  return {shape.empty() ? H5Screate(H5S_SCALAR)
                        : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
          H5Sclose};
}

void recreate(hid_t file, const Spoil& spoil, const Handle& type, const std::vector<hsize_t>& shape) {
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (spoil.harm == Harm::values_in_another_file)
    H5Pset_external(creation.get(), "/proc/self/maps", 0, H5F_UNLIMITED);
  if (spoil.harm == Harm::huge) {  // allocated late, chunk by chunk: nominally huge, but without data
    const std::vector<hsize_t> chunk(shape.size(), 1);
    H5Pset_chunk(creation.get(), static_cast<int>(shape.size()), chunk.data());
  }
  const Handle space = space_of(shape);
  const Handle set(
      H5Dcreate2(file, spoil.path.c_str(), type.get(), space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
      H5Dclose);
}

void add_huge_attribute(hid_t set) {
  const Handle type = copy_of(H5T_C_S1);
  H5Tset_size(type.get(), 60000);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Adelete(set, "unit");
  const Handle attribute(H5Acreate2(set, "unit", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  H5Awrite(attribute.get(), type.get(), std::vector<char>(60000, 'x').data());
}

/// Writes any type of number through doubles or 64-bit integers; texts are not written byte by byte.
void overwrite(hid_t set, const Spoil& spoil) {
  const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  const auto count = static_cast<hsize_t>(H5Sget_simple_extent_npoints(space.get()));
  const H5T_class_t kind = H5Tget_class(type.get());
  if (count == 0 || count > (1U << 20) || (kind != H5T_FLOAT && kind != H5T_INTEGER)) return;
  const std::size_t first = spoil.harm == Harm::all_values ? 0 : spoil.index % count;
  const std::size_t end = spoil.harm == Harm::all_values ? count : first + 1;
  if (kind == H5T_FLOAT) {
    std::vector<double> values(count);
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    for (std::size_t k = first; k < end; ++k) values[k] = real_of(spoil.bits);
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  } else {
    std::vector<std::int64_t> values(count);
    H5Dread(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    for (std::size_t k = first; k < end; ++k) values[k] = integer_of(spoil.bits);
    H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
}

void spoil_one(hid_t file, const Spoil& spoil) {
  const char* path = spoil.path.c_str();
  Handle set(H5Dopen2(file, path, H5P_DEFAULT), H5Dclose);
  if (set.get() < 0) return;  // already damaged
  if (spoil.harm == Harm::one_value || spoil.harm == Harm::all_values) return overwrite(set.get(), spoil);
  if (spoil.harm == Harm::huge_attribute) return add_huge_attribute(set.get());
  const Handle own(H5Dget_type(set.get()), H5Tclose), space(H5Dget_space(set.get()), H5Sclose);
  std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get())));
  H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  set = Handle();
  H5Ldelete(file, path, H5P_DEFAULT);
  if (spoil.harm == Harm::group_instead) {
    const Handle group(H5Gcreate2(file, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  } else if (spoil.harm == Harm::external_link) {
    H5Lcreate_external(spoil.elsewhere.c_str(), path, file, path, H5P_DEFAULT, H5P_DEFAULT);
  } else if (spoil.harm != Harm::missing) {
    recreate(file, spoil, type_for(spoil, own.get()), shape_for(spoil, shape));
  }
}

/// Returns the kind of seal that a file has; empty if it has none.
std::string_view kind_of_seal(const Bytes& file) {
  for (const std::string_view kind : {io::run_seal, io::averages_seal})
    if (file.size() > io::seal_size && std::memcmp(file.data(), kind.data(), kind.size()) == 0) return kind;
  return {};
}

/// Returns the image of an open file; HDF5 omits the seal in front of it.
Bytes image_of(hid_t file, std::size_t before) {
  H5Fflush(file, H5F_SCOPE_LOCAL);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  Bytes image(before + static_cast<std::size_t>(size));
  H5Fget_file_image(file, image.data() + before, static_cast<std::size_t>(size));
  return image;
}

herr_t note_data_set(hid_t, const char* name, const H5O_info_t* info, void* found) {
  if (info->type == H5O_TYPE_DATASET)
    static_cast<std::vector<std::string>*>(found)->push_back(std::string("/").append(name));
  return 0;
}

}  // namespace

std::string name_of(Harm harm) { return names.at(static_cast<std::size_t>(harm)); }

std::vector<std::string> data_sets(const Bytes& file) {
  Bytes bytes = file;
  const Handle open = io::hdf5::open_image(bytes, "listed", H5F_ACC_RDONLY);
  std::vector<std::string> found;
#if H5_VERSION_GE(1, 12, 0)
  H5Ovisit(open.get(), H5_INDEX_NAME, H5_ITER_INC, note_data_set, &found, H5O_INFO_BASIC);
#else
  H5Ovisit(open.get(), H5_INDEX_NAME, H5_ITER_INC, note_data_set, &found);
#endif
  return found;
}

std::uint64_t values_hash(const Bytes& file) {
  Bytes bytes = file;
  const Handle open = io::hdf5::open_image(bytes, "hashed", H5F_ACC_RDONLY);
  Hasher hasher;
  for (const std::string& path : data_sets(file)) {
    const Handle set(H5Dopen2(open.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set.get()), H5Tclose), space(H5Dget_space(set.get()), H5Sclose);
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get()));
    Bytes values(count * H5Tget_size(type.get()));
    H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    hasher.add_array(path);
    hasher.add_array(values);
  }
  return hasher.value();
}

std::vector<Spoil> spoils_of_chance(Random& random, std::span<const std::string> paths,
                                    const std::string& elsewhere) {
  std::vector<Spoil> spoils(1 + random.below(2));
  for (Spoil& spoil : spoils)
    spoil = {paths[random.below(static_cast<std::uint32_t>(paths.size()))],
             static_cast<Harm>(random.below(harm_count)), random.next(), random.below(40), elsewhere};
  return spoils;
}

Bytes spoilt(const Bytes& file, std::span<const Spoil> spoils) {
  Bytes bytes = file;
  const Handle open = io::hdf5::open_image(bytes, "spoilt", H5F_ACC_RDWR);
  for (const Spoil& spoil : spoils) spoil_one(open.get(), spoil);
  const std::string_view kind = kind_of_seal(file);
  return kind.empty() ? image_of(open.get(), 0) : io::sealed(image_of(open.get(), io::seal_size), kind);
}

Bytes read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

void write_bytes(const std::string& path, std::span<const std::byte> bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace talus::hostile
