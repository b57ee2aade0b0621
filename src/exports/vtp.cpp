#include <cstdint>
#include <fmt/core.h>
#include <string_view>
#include <vector>

#include "base/version.h"
#include "exports/fields.h"
#include "exports/vtk_xml.h"
#include "exports/writers.h"

namespace talus::exports {
namespace {

std::string column_array(const FieldColumn& column) {
  return vtk_field({column.name(), 1, column.field.unit}, column.field.shape, column.field.number,
                   column.values);
}

/// Returns cells of `size` consecutive points each.
std::string cells(std::string_view kind, std::size_t count, std::size_t size) {
  std::vector<std::int64_t> connectivity, offsets;
  for (std::size_t k = 0; k < count * size; ++k) connectivity.push_back(static_cast<std::int64_t>(k));
  for (std::size_t k = 1; k <= count; ++k) offsets.push_back(static_cast<std::int64_t>(k * size));
  return fmt::format("<{0}>\n{1}{2}</{0}>\n", kind, vtk_array({"connectivity"}, connectivity),
                     vtk_array({"offsets"}, offsets));
}

std::string poly_data(const analysis::GrainSource& frame, const std::string& piece) {
  return vtk_file(frame, "PolyData", "", piece);
}

std::string piece_head(std::size_t points, std::size_t vertices, std::size_t lines) {
  return fmt::format(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      points, vertices, lines);
}

/// Returns for each contact the centre of a and the end point of the line to b.
std::vector<double> line_ends(const analysis::GrainSource& source) {
  const Frame& frame = source.frame;
  const FrameContacts& contacts = frame.contacts;
  std::vector<double> ends;
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    const auto a = static_cast<std::size_t>(contacts.a[c]), b = static_cast<std::size_t>(contacts.b[c]);
    const bool is_grain = b < frame.x.size();
    const double x = is_grain ? frame.x[b] + contacts.shift[c] * source.statics.length : contacts.px[c];
    const double y = is_grain ? frame.y[b] : contacts.py[c];
    ends.insert(ends.end(), {frame.x[a], frame.y[a], 0.0, x, y, 0.0});
  }
  return ends;
}

}  // namespace

std::string grains_vtp(const analysis::GrainSource& frame) {
  const std::size_t count = frame.frame.x.size();
  std::vector<float> centres;
  for (std::size_t i = 0; i < count; ++i)
    centres.insert(centres.end(),
                   {static_cast<float>(frame.frame.x[i]), static_cast<float>(frame.frame.y[i]), 0.0F});
  std::string piece = piece_head(count, count, 0) + "<PointData>\n";
  for (const FieldColumn& column : grain_columns(frame)) piece += column_array(column);
  piece.append("</PointData>\n<Points>\n")
      .append(vtk_array({"Points", 3, "m"}, centres))
      .append("</Points>\n")
      .append(cells("Verts", count, 1))
      .append("</Piece>\n");
  return poly_data(frame, piece);
}

std::string contacts_vtp(const analysis::GrainSource& frame) {
  const FrameContacts& contacts = frame.frame.contacts;
  const std::size_t count = contacts.a.size();
  std::vector<float> force_at_ends;
  for (const double force : contacts.fn)
    force_at_ends.insert(force_at_ends.end(), 2, static_cast<float>(force));
  std::string piece = piece_head(2 * count, 0, count) + "<PointData>\n";
  piece.append(vtk_array({"normal_force", 1, "N/m"}, force_at_ends)).append("</PointData>\n<CellData>\n");
  for (const FieldColumn& column : contact_columns(frame)) piece += column_array(column);
  piece.append("</CellData>\n<Points>\n")
      .append(vtk_array({"Points", 3, "m"}, line_ends(frame)))
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
      version, vtk_byte_order());
  for (const PvdEntry& entry : entries)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace talus::exports
