#pragma once
/// HDF5 files of named arrays that no schema need know: what is read with h5py rather than by Talus.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// An array of doubles, or of whole numbers.
struct PlainArray {
  std::string path;                          ///< "/variants/0/over_tilt/theta"
  std::vector<std::size_t> shape;            ///< one or two dimensions
  std::string unit;                          ///< "deg", "1"
  std::string definition;                    ///< one sentence
  std::vector<double> values = {};           ///< row by row
  std::vector<std::uint64_t> integers = {};  ///< in place of them, where there are no values
};

/// An attribute of a group or of an array: a text, or a list of texts.
struct PlainTexts {
  std::string path;  ///< "/", "/variants/0"
  std::string name;
  std::vector<std::string> texts;
  bool is_list = false;
};

/// Writes a file that is whole or absent, with groups made as they are needed. Arrays have the attributes
/// `unit` and `definition`. Throws as write_durably does.
void write_plain_file(const std::string& path, const std::vector<PlainArray>& arrays,
                      const std::vector<PlainTexts>& texts);

/// What is in such a file.
struct PlainFile {
  std::vector<PlainArray> arrays;  ///< all arrays of numbers, without their definitions
  std::vector<PlainTexts> texts;   ///< the attributes of groups, and of arrays all but unit and definition
};

/// Reads all that is in such a file. Links to other places are passed over. HDF5 sees the file in a child
/// process only. Throws Error(missing_input) where it cannot be opened, and Error(bad_data) where it is no
/// HDF5 file, or an array is not what its hash says.
PlainFile read_plain_file(const std::string& path);

/// The same to bytes and back. `decode_plain` throws Error(bad_data), naming `path`, for what `encode` never
/// makes.
std::vector<std::byte> encode(const PlainFile& file);
PlainFile decode_plain(std::span<const std::byte> bytes, const std::string& path);

}  // namespace talus
