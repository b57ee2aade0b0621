#include "exports/vtk_xml.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>

#include "base/base64.h"
#include "base/version.h"

namespace talus::exports {
namespace {

constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

template <typename Number>
constexpr const char* type_name = "";
template <>
constexpr const char* type_name<float> = "Float32";
template <>
constexpr const char* type_name<double> = "Float64";
template <>
constexpr const char* type_name<std::int32_t> = "Int32";
template <>
constexpr const char* type_name<std::int64_t> = "Int64";

/// Returns the number of bytes followed by the bytes, encoded.
template <typename Number>
std::string encoded(const std::vector<Number>& values) {
  const std::uint64_t size = values.size() * sizeof(Number);
  std::vector<std::byte> bytes(sizeof size + size);
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return base64(bytes);
}

/// Returns a scalar of the entire frame.
std::string field_datum(const char* type, std::string_view name, const std::string& value,
                        std::string_view unit) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">\n{}\n"
      "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n</DataArray>\n",
      type, name, value, unit);
}

std::string field_data(const analysis::GrainSource& frame) {
  return fmt::format("<FieldData>\n{}{}{}{}</FieldData>\n",
                     field_datum("Float64", "TimeValue", fmt::format("{}", frame.frame.time), "s"),
                     field_datum("Float64", "tilt", fmt::format("{}", frame.frame.tilt), "rad"),
                     field_datum("Int64", "frame", fmt::format("{}", frame.number), "1"),
                     field_datum("Int64", "step", fmt::format("{}", frame.frame.step), "1"));
}

template <typename Number>
std::vector<Number> in_space(const std::vector<double>& plane, std::size_t width) {
  std::vector<Number> values;
  for (std::size_t k = 0; k < plane.size(); k += width) {
    const auto at = [&](std::size_t c) { return static_cast<Number>(plane[k + c]); };
    const Number zero = 0;
    if (width == 1) values.push_back(at(0));
    if (width == 2) values.insert(values.end(), {at(0), at(1), zero});
    if (width == 4) values.insert(values.end(), {at(0), at(1), zero, at(2), at(3), zero, zero, zero, zero});
  }
  return values;
}

}  // namespace

template <typename Number>
std::string vtk_array(const VtkArray& head, const std::vector<Number>& values) {
  const std::string unit =
      head.unit.empty()
          ? ""
          : fmt::format(
                "\n<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>",
                head.unit);
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n{}{}\n</DataArray>\n",
      type_name<Number>, head.name, head.components, encoded(values), unit);
}

template std::string vtk_array(const VtkArray&, const std::vector<float>&);
template std::string vtk_array(const VtkArray&, const std::vector<double>&);
template std::string vtk_array(const VtkArray&, const std::vector<std::int32_t>&);
template std::string vtk_array(const VtkArray&, const std::vector<std::int64_t>&);

std::string vtk_field(const VtkArray& head, analysis::FieldShape shape, analysis::FieldNumber number,
                      const std::vector<double>& values) {
  const auto width = static_cast<std::size_t>(shape);
  const VtkArray in_three = {head.name, width == 4 ? 9U : width == 2 ? 3U : 1U, head.unit};
  switch (number) {
    case analysis::FieldNumber::integer:
      return vtk_array(in_three, in_space<std::int32_t>(values, width));
    case analysis::FieldNumber::single:
      return vtk_array(in_three, in_space<float>(values, width));
    case analysis::FieldNumber::real:
      break;
  }
  return vtk_array(in_three, in_space<double>(values, width));
}

std::string vtk_file(const analysis::GrainSource& frame, std::string_view type, const std::string& attributes,
                     const std::string& piece) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- talus {0}: SI units; masses, forces and moments are per metre of thickness. x is along the bed, "
      "y "
      "away from its floor. -->\n"
      "<VTKFile type=\"{1}\" version=\"1.0\" byte_order=\"{2}\" header_type=\"UInt64\">\n"
      "<{1}{3}>\n{4}{5}</{1}>\n</VTKFile>\n",
      version, type, byte_order, attributes, field_data(frame), piece);
}

std::string_view vtk_byte_order() { return byte_order; }

}  // namespace talus::exports
