#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/core.h>
#include <string_view>
#include <vector>

#include "base/errors.h"
#include "base/text.h"
#include "base/version.h"
#include "core/trigonometry.h"
#include "exports/writers.h"
#include "stress/stress.h"

namespace talus::exports {
namespace {

/// The description of an array.
struct VtkArray {
  std::string name;
  std::size_t components = 1;
  std::string_view unit = {};  ///< empty: none
};

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

/// Returns a binary DataArray of float, double, std::int32_t or std::int64_t.
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

/// Returns a DataArray of a field in its number type, extended to three dimensions as VTK requires: vectors
/// end with a zero, tensors get a row and a column of zeros.
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

/// Returns a file with a data set of a type, such as "PolyData", whose `attributes` begin with a blank, and a
/// piece of it; and with the time and the tilt of the frame.
std::string vtk_file(const analysis::GrainSource& frame, std::string_view type, const std::string& attributes,
                     const std::string& piece) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- talus {0}: SI units; masses, forces and moments are per metre of thickness. x is along the bed, "
      "y away from its floor. -->\n"
      "<VTKFile type=\"{1}\" version=\"1.0\" byte_order=\"{2}\" header_type=\"UInt64\">\n"
      "<{1}{3}>\n{4}{5}</{1}>\n</VTKFile>\n",
      version, type, byte_order, attributes, field_data(frame), piece);
}

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
      version, byte_order);
  for (const PvdEntry& entry : entries)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  return text + "</Collection>\n</VTKFile>\n";
}

namespace {

constexpr double points_across = 10.0;  // grid points per diameter of the coarse-graining function

using Values = std::vector<double>;
using Field = analysis::CoarseField;
using analysis::FieldShape;

void append(Values& values, double scalar) { values.push_back(scalar); }
void append(Values& values, const Vec2& vector) { values.insert(values.end(), {vector.x, vector.y}); }
void append(Values& values, const Tensor2& tensor) {
  values.insert(values.end(), {tensor.xx, tensor.xy, tensor.yx, tensor.yy});
}

constexpr auto all_grid_fields = std::to_array<GridField>({
    {"density", FieldShape::scalar, "kg/m^3", "mass of the free grains over area and thickness",
     [](Values& values, const Field& at, double) { append(values, at.density); }},
    {"solid_fraction", FieldShape::scalar, "1", "area of the free grains over area",
     [](Values& values, const Field& at, double material) { append(values, at.density / material); }},
    {"momentum", FieldShape::vector, "kg/(m^2 s)", "momentum of the free grains over area and thickness",
     [](Values& values, const Field& at, double) { append(values, at.momentum); }},
    {"velocity", FieldShape::vector, "m/s", "momentum over density; NaN without mass",
     [](Values& values, const Field& at, double) { append(values, at.velocity()); }},
    {"stress", FieldShape::tensor, "Pa", "contact_stress + kinetic_stress",
     [](Values& values, const Field& at, double) { append(values, at.stress()); }},
    {"contact_stress", FieldShape::tensor, "Pa",
     "stress of the contact forces along the branches between centres, at floor and walls from the centre to "
     "the contact; compression positive, the index of the branch first",
     [](Values& values, const Field& at, double) { append(values, at.contact_stress); }},
    {"kinetic_stress", FieldShape::tensor, "Pa", "stress of the velocities about the field velocity",
     [](Values& values, const Field& at, double) { append(values, at.kinetic_stress); }},
    {"pressure", FieldShape::scalar, "Pa", "P = s1 + s2 of the stress",
     [](Values& values, const Field& at, double) { append(values, stress::stress_state(at.stress()).mean); }},
    {"stress_ratio", FieldShape::scalar, "1", "Q/P of the stress; NaN unless P is positive",
     [](Values& values, const Field& at, double) {
       append(values, stress::stress_state(at.stress()).ratio);
     }},
    {"boundary_force", FieldShape::vector, "N/m^3",
     "force of floor and walls on the free grains over area and thickness",
     [](Values& values, const Field& at, double) { append(values, at.boundary_force); }},
    {"strain_rate", FieldShape::tensor, "1/s", "symmetric part of the gradient of the velocity",
     [](Values& values, const Field& at, double) {
       const Tensor2& g = at.velocity_gradient;
       append(values, Tensor2{g.xx, 0.5 * (g.xy + g.yx), 0.5 * (g.xy + g.yx), g.yy});
     }},
    {"shear_rate", FieldShape::scalar, "1/s", "difference of the principal values of the strain rate",
     [](Values& values, const Field& at, double) {
       append(values, analysis::shear_strain(at.velocity_gradient));
     }},
    {"vorticity", FieldShape::scalar, "1/s", "curl of the velocity, counter-clockwise positive",
     [](Values& values, const Field& at, double) {
       append(values, at.velocity_gradient.yx - at.velocity_gradient.xy);
     }},
    {"temperature", FieldShape::scalar, "m^2/s^2",
     "granular temperature, half the mean square of the velocities about a linear velocity field; NaN with "
     "fewer than four grains",
     [](Values& values, const Field& at, double) { append(values, at.temperature); }},
});

}  // namespace

std::span<const GridField> grid_fields() { return all_grid_fields; }

FieldGrid field_grid(const analysis::GrainSource& frame, double width) {
  const RunStatics& statics = frame.statics;
  const pictures::MapExtent bounds = bed_bounds(frame);
  const double spacing = width / points_across, margin = 0.5 * width;
  const double left = statics.periodic ? 0.0 : -margin;
  const double length = statics.length - 2.0 * left, height = bounds.y_max - bounds.y_min + 2.0 * margin;
  FieldGrid grid;
  grid.columns = std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-9)));
  grid.rows = std::max(1, static_cast<int>(std::ceil(height / spacing - 1e-9)));
  grid.dx = length / grid.columns;
  grid.dy = spacing;
  grid.x = left + 0.5 * grid.dx;
  grid.y = bounds.y_min - margin + 0.5 * grid.dy;
  return grid;
}

void check_field_width(const RunStatics& statics, double width) {
  if (!(width > 0.0 && width <= statics.length))
    throw Error(ExitCode::usage,
                "--set length={:.6g}: expected a diameter above 0, up to the length of the bed, {:.6g} D",
                width / statics.mean_diameter, statics.length / statics.mean_diameter);
}

std::string fields_vti(const analysis::GrainSource& frame, double width) {
  const RunStatics& statics = frame.statics;
  check_field_width(statics, width);
  const FieldGrid grid = field_grid(frame, width);
  const analysis::CoarseFields fields({frame.frame, statics}, 0.5 * width);
  const double material = statics.mass[0] / (pi * statics.radius[0] * statics.radius[0]);
  std::vector<std::vector<double>> values(all_grid_fields.size());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const analysis::CoarseField at = fields.at(grid.x + column * grid.dx, grid.y + row * grid.dy);
      for (std::size_t f = 0; f < values.size(); ++f) all_grid_fields[f].append(values[f], at, material);
    }
  const std::string extent = fmt::format("0 {} 0 {} 0 0", grid.columns - 1, grid.rows - 1);
  std::string piece = fmt::format("<Piece Extent=\"{}\">\n<PointData>\n", extent);
  for (std::size_t f = 0; f < values.size(); ++f) {
    const GridField& field = all_grid_fields[f];
    piece += vtk_field({std::string(field.name), 1, field.unit}, field.shape, analysis::FieldNumber::single,
                       values[f]);
  }
  piece += "</PointData>\n</Piece>\n";
  return vtk_file(frame, "ImageData",
                  fmt::format(" WholeExtent=\"{}\" Origin=\"{} {} 0\" Spacing=\"{} {} 1\"", extent, grid.x,
                              grid.y, grid.dx, grid.dy),
                  piece);
}

}  // namespace talus::exports
