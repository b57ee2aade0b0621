#pragma once
/// HDF5 files of named arrays that no schema need know: what is read with h5py rather than by Talus.

#include <cstddef>
#include <cstdint>
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

}  // namespace talus
