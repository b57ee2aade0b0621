#include "export/vtp.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>
#include <string_view>
#include <vector>

#include "core/base64.h"
#include "core/version.h"
#include "export/fields.h"

namespace talus {
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

/// What a DataArray says of itself.
struct ArrayHead {
  std::string name;
  std::size_t components = 1;
  std::string_view unit = {};  ///< empty: none
};

/// The number of bytes, and the bytes.
template <typename Number>
std::string encoded(const std::vector<Number>& values) {
  const std::uint64_t size = values.size() * sizeof(Number);
  std::vector<std::byte> bytes(sizeof size + size);
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return base64(bytes);
}

template <typename Number>
std::string data_array(const ArrayHead& head, const std::vector<Number>& values) {
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

/// A number of the frame as a whole.
std::string field_datum(const char* type, std::string_view name, const std::string& value,
                        std::string_view unit) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">\n{}\n"
      "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>\n</DataArray>\n",
      type, name, value, unit);
}

std::string field_data(const ExportedFrame& frame) {
  return fmt::format("<FieldData>\n{}{}{}{}</FieldData>\n",
                     field_datum("Float64", "TimeValue", fmt::format("{}", frame.frame.time), "s"),
                     field_datum("Float64", "tilt", fmt::format("{}", frame.frame.tilt), "rad"),
                     field_datum("Int64", "frame", fmt::format("{}", frame.number), "1"),
                     field_datum("Int64", "step", fmt::format("{}", frame.frame.step), "1"));
}

/// In three dimensions: vectors end with a zero, tensors get a row and a column of zeros.
template <typename Number>
std::vector<Number> in_space(const FieldColumn& column) {
  std::vector<Number> values;
  const std::size_t width = components(column.field);
  for (std::size_t k = 0; k < column.values.size(); k += width) {
    const auto at = [&](std::size_t c) { return static_cast<Number>(column.values[k + c]); };
    const Number zero = 0;
    if (width == 1) values.push_back(at(0));
    if (width == 2) values.insert(values.end(), {at(0), at(1), zero});
    if (width == 4) values.insert(values.end(), {at(0), at(1), zero, at(2), at(3), zero, zero, zero, zero});
  }
  return values;
}

std::string column_array(const FieldColumn& column) {
  const std::size_t width = components(column.field);
  const ArrayHead head = {column.name(), width == 4 ? 9U : width == 2 ? 3U : 1U, column.field.unit};
  switch (column.field.number) {
    case FieldNumber::integer:
      return data_array(head, in_space<std::int32_t>(column));
    case FieldNumber::single:
      return data_array(head, in_space<float>(column));
    case FieldNumber::real:
      break;
  }
  return data_array(head, in_space<double>(column));
}

/// Cells of `size` points each, which follow each other.
std::string cells(std::string_view kind, std::size_t count, std::size_t size) {
  std::vector<std::int64_t> connectivity, offsets;
  for (std::size_t k = 0; k < count * size; ++k) connectivity.push_back(static_cast<std::int64_t>(k));
  for (std::size_t k = 1; k <= count; ++k) offsets.push_back(static_cast<std::int64_t>(k * size));
  return fmt::format("<{0}>\n{1}{2}</{0}>\n", kind, data_array({"connectivity"}, connectivity),
                     data_array({"offsets"}, offsets));
}

std::string poly_data(const ExportedFrame& frame, const std::string& piece) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- talus {}: SI units; masses, forces and moments are per metre of thickness. x is along the bed, y "
      "away from its floor. -->\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n"
      "<PolyData>\n{}{}</PolyData>\n</VTKFile>\n",
      version, byte_order, field_data(frame), piece);
}

std::string piece_head(std::size_t points, std::size_t vertices, std::size_t lines) {
  return fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      points, vertices, lines);
}

/// Centre of a, and where the line to b ends.
std::vector<double> line_ends(const ExportedFrame& of) {
  const Frame& frame = of.frame;
  const FrameContacts& contacts = frame.contacts;
  std::vector<double> ends;
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    const auto a = static_cast<std::size_t>(contacts.a[c]), b = static_cast<std::size_t>(contacts.b[c]);
    const bool is_grain = b < frame.x.size();
    const double x = is_grain ? frame.x[b] + contacts.shift[c] * of.run.statics.length : contacts.px[c];
    const double y = is_grain ? frame.y[b] : contacts.py[c];
    ends.insert(ends.end(), {frame.x[a], frame.y[a], 0.0, x, y, 0.0});
  }
  return ends;
}

}  // namespace

std::string grains_vtp(const ExportedFrame& frame) {
  const std::size_t count = frame.frame.x.size();
  std::vector<float> centres;
  for (std::size_t i = 0; i < count; ++i)
    centres.insert(centres.end(),
                   {static_cast<float>(frame.frame.x[i]), static_cast<float>(frame.frame.y[i]), 0.0F});
  std::string piece = piece_head(count, count, 0) + "<PointData>\n";
  for (const FieldColumn& column : grain_columns(frame)) piece += column_array(column);
  piece.append("</PointData>\n<Points>\n")
      .append(data_array({"Points", 3, "m"}, centres))
      .append("</Points>\n")
      .append(cells("Verts", count, 1))
      .append("</Piece>\n");
  return poly_data(frame, piece);
}

std::string contacts_vtp(const ExportedFrame& frame) {
  const FrameContacts& contacts = frame.frame.contacts;
  const std::size_t count = contacts.a.size();
  std::vector<float> force_at_ends;
  for (const double force : contacts.fn)
    force_at_ends.insert(force_at_ends.end(), 2, static_cast<float>(force));
  std::string piece = piece_head(2 * count, 0, count) + "<PointData>\n";
  piece.append(data_array({"normal_force", 1, "N/m"}, force_at_ends)).append("</PointData>\n<CellData>\n");
  for (const FieldColumn& column : contact_columns(frame)) piece += column_array(column);
  piece.append("</CellData>\n<Points>\n")
      .append(data_array({"Points", 3, "m"}, line_ends(frame)))
      .append("</Points>\n")
      .append(cells("Lines", count, 2))
      .append("</Piece>\n");
  return poly_data(frame, piece);
}

std::string pvd_text(std::span<const PvdEntry> entries) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- talus {}: the time of a frame is in s. -->\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"{}\">\n<Collection>\n",
      version, byte_order);
  for (const PvdEntry& entry : entries)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace talus
