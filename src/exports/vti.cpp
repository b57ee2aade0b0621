#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "exports/vtk_xml.h"
#include "exports/writers.h"
#include "stress/stress_state.h"

namespace talus::exports {
namespace {

constexpr double points_across = 10.0;  // grid points per diameter of the coarse-graining function

void append(std::vector<double>& values, const Vec2& vector) {
  values.insert(values.end(), {vector.x, vector.y});
}

void append(std::vector<double>& values, const Tensor2& tensor) {
  values.insert(values.end(), {tensor.xx, tensor.xy, tensor.yx, tensor.yy});
}

constexpr auto all_grid_fields = std::to_array<GridField>({
    {"density", analysis::FieldShape::scalar, "kg/m^3", "mass of the free grains over area and thickness",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       values.push_back(at.density);
     }},
    {"solid_fraction", analysis::FieldShape::scalar, "1", "area of the free grains over area",
     [](std::vector<double>& values, const analysis::CoarseField& at, double material) {
       values.push_back(at.density / material);
     }},
    {"momentum", analysis::FieldShape::vector, "kg/(m^2 s)",
     "momentum of the free grains over area and thickness",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       append(values, at.momentum);
     }},
    {"velocity", analysis::FieldShape::vector, "m/s", "momentum over density; NaN without mass",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       append(values, at.velocity());
     }},
    {"stress", analysis::FieldShape::tensor, "Pa", "contact_stress + kinetic_stress",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       append(values, at.stress());
     }},
    {"contact_stress", analysis::FieldShape::tensor, "Pa",
     "stress of the contact forces along the branches between centres, at floor and walls from the centre to "
     "the contact; compression positive, the index of the branch first",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       append(values, at.contact_stress);
     }},
    {"kinetic_stress", analysis::FieldShape::tensor, "Pa",
     "stress of the velocities about the field velocity",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       append(values, at.kinetic_stress);
     }},
    {"pressure", analysis::FieldShape::scalar, "Pa", "P = s1 + s2 of the stress",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       values.push_back(stress::stress_state(at.stress()).mean);
     }},
    {"stress_ratio", analysis::FieldShape::scalar, "1", "Q/P of the stress; NaN unless P is positive",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       values.push_back(stress::stress_state(at.stress()).ratio);
     }},
    {"boundary_force", analysis::FieldShape::vector, "N/m^3",
     "force of floor and walls on the free grains over area and thickness",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       append(values, at.boundary_force);
     }},
    {"strain_rate", analysis::FieldShape::tensor, "1/s", "symmetric part of the gradient of the velocity",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       const Tensor2& g = at.velocity_gradient;
       append(values, Tensor2{g.xx, 0.5 * (g.xy + g.yx), 0.5 * (g.xy + g.yx), g.yy});
     }},
    {"shear_rate", analysis::FieldShape::scalar, "1/s",
     "difference of the principal values of the strain rate",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       values.push_back(analysis::shear_rate(at.velocity_gradient));
     }},
    {"vorticity", analysis::FieldShape::scalar, "1/s", "curl of the velocity, counter-clockwise positive",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       values.push_back(at.velocity_gradient.yx - at.velocity_gradient.xy);
     }},
    {"temperature", analysis::FieldShape::scalar, "m^2/s^2",
     "granular temperature, half the mean square of the velocities about a linear velocity field; NaN "
     "with fewer than four grains",
     [](std::vector<double>& values, const analysis::CoarseField& at, double) {
       values.push_back(at.temperature);
     }},
});

}  // namespace

std::span<const GridField> grid_fields() { return all_grid_fields; }

FieldGrid field_grid(const analysis::GrainSource& frame, double width) {
  const RunStatics& statics = frame.statics;
  const BedBounds bounds = bed_bounds(frame);
  const double spacing = width / points_across, margin = 0.5 * width;
  const double left = statics.periodic ? 0.0 : -margin;
  const double length = statics.length - 2.0 * left, height = bounds.y_high - bounds.y_low + 2.0 * margin;
  FieldGrid grid;
  grid.columns = std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-9)));
  grid.rows = std::max(1, static_cast<int>(std::ceil(height / spacing - 1e-9)));
  grid.dx = length / grid.columns;
  grid.dy = spacing;
  grid.x = left + 0.5 * grid.dx;
  grid.y = bounds.y_low - margin + 0.5 * grid.dy;
  return grid;
}

void check_field_width(const RunStatics& statics, double width) {
  if (!(width > 0.0 && width <= statics.length))
    throw Error(ExitCode::usage,
                fmt::format("--length {:.6g}: expected a diameter above 0, up to the length of the bed, "
                            "{:.6g} D",
                            width / statics.mean_diameter, statics.length / statics.mean_diameter));
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
