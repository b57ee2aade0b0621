#include "io/plain_file.h"

#include <algorithm>
#include <fmt/core.h>

#include "io/durable_file.h"
#include "io/hdf5_writer.h"

namespace talus {
namespace {

/// The letter of a dimension along which arrays are stored in compressed chunks, of size 0: "S+50" has 50.
constexpr char compressed = 'S';

std::string shape_text(const PlainArray& array) {
  std::string text;
  for (std::size_t d = 0; d < array.shape.size(); ++d)
    text += fmt::format("{}{}{}", d == 0 ? "" : " ", d == 0 && array.shape.size() > 1 ? "S+" : "",
                        array.shape[d]);
  return text;
}

}  // namespace

void write_plain_file(const std::string& path, const std::vector<PlainArray>& arrays,
                      const std::vector<PlainTexts>& texts) {
  hdf5::Writer writer({{compressed, 0}});
  for (const PlainArray& array : arrays) {
    const ElementType type = array.integers.empty() ? ElementType::float64 : ElementType::uint64;
    const DataSetField field{array.path, type, shape_text(array), array.unit, array.definition};
    if (array.integers.empty())
      writer.write(field, array.values);
    else
      writer.write(field, array.integers);
    writer.set_attribute(array.path, "definition", array.definition);
  }
  for (const PlainTexts& attribute : texts) {
    if (attribute.is_list && !attribute.texts.empty())
      writer.set_attribute(attribute.path, attribute.name.c_str(), attribute.texts);
    else if (!attribute.is_list)
      writer.set_attribute(attribute.path, attribute.name.c_str(), attribute.texts.front());
  }
  write_durably(path, writer.image());
}

}  // namespace talus
