#pragma once
/// What the writers of all formats make of a frame.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/deformation/coarse_fields.h"
#include "analysis/frame_quantities.h"
#include "core/observables.h"
#include "exports/fields.h"

namespace talus::exports {

// bounds.cpp
// The box around a bed, as formats of molecular dynamics want one.

/// m. Along x the period, or from wall to wall; along y from the lowest to the highest point of the grains of
/// the frame; across the plane, where nothing is, a mean diameter.
struct BedBounds {
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0, z_low = 0.0, z_high = 0.0;
};
BedBounds bed_bounds(const analysis::GrainSource& frame);

// csv.cpp
// Frames and observables as tables. The first line names columns, with their units in brackets: "time (s)".
// A number that is none is an empty field.

/// Rows of a frame, and what they are called.
struct CsvRows {
  std::string head, rows;
};

/// A row for the frame: its number, step, time and tilt.
CsvRows frame_csv(const analysis::GrainSource& frame);
/// A row for each grain, and for each contact; the first column is the number of the frame.
CsvRows grains_csv(const analysis::GrainSource& frame);
CsvRows contacts_csv(const analysis::GrainSource& frame);

/// All of a series.
std::string observables_csv(std::span<const ObservableRow> rows);

// xyz.cpp
// Frames as extended XYZ, for OVITO and ASE.

/// A frame, to follow the one before in the same file. Lengths are in mean diameters, all else is SI: OVITO
/// takes coordinates that all lie between 0 and 1 for shares of the box, as those of a bed shorter than a
/// metre would. The line of the box has the mean diameter in m.
std::string xyz_text(const analysis::GrainSource& frame);

// lammps_dump.cpp
// Frames as the text of a LAMMPS dump (custom style), for OVITO.

/// Before the first frame, and only there, as LAMMPS does: OVITO would not find the frames after a second
/// one.
inline constexpr std::string_view lammps_dump_head = "ITEM: UNITS\nsi\n";

/// A frame, to follow the one before in the same file: SI units (`units si`), without a column z, by which
/// OVITO knows that it is two-dimensional.
std::string lammps_dump_text(const analysis::GrainSource& frame);

// graphml.cpp
// The contact network of a frame as GraphML, for networkx and the like.

/// An undirected graph: grains, and planes that something touches, are nodes with their ids; contacts are
/// edges, from a to b. Two grains of a short periodic bed may touch twice.
std::string graphml_text(const analysis::GrainSource& frame);

// vtp.cpp
// Frames as XML PolyData of VTK, for ParaView.

/// Grains as points (vertices), m, with their fields as point data.
std::string grains_vtp(const analysis::GrainSource& frame);

/// Contacts as lines, m, each with end points of its own: from the centre of a to that of b, or to the
/// contact point where b is a plane. Across the periodic edge a line goes on to the image of b. Fields are
/// cell data, and normal forces point data too, as filters that draw tubes want them.
std::string contacts_vtp(const analysis::GrainSource& frame);

/// A file of a series.
struct PvdEntry {
  double time = 0.0;  ///< s
  std::string file;   ///< seen from the .pvd
};

/// A .pvd: files over time.
std::string pvd_text(std::span<const PvdEntry> entries);

// vti.cpp
// Coarse-grained fields of frames on a grid, as XML ImageData of VTK, for ParaView.

/// A field of the bed as a continuum; docs/export.md is compared with their table by a test.
struct GridField {
  std::string_view name;
  analysis::FieldShape shape = analysis::FieldShape::scalar;
  std::string_view unit;        ///< SI, or "1"
  std::string_view definition;  ///< one sentence
  /// Appends its components at a point. `material`: density of the grains, kg/m^3.
  void (*append)(std::vector<double>& values, const analysis::CoarseField& at, double material) = nullptr;
};
std::span<const GridField> grid_fields();

/// Points in rows, from the lowest row up and along x in each, m. Around the bed they go on for the cutoff of
/// the coarse-graining function, beyond which nothing is: a sum over all of them, times dx dy, is an integral
/// over the bed. Around a period they go once.
struct FieldGrid {
  double x = 0.0, y = 0.0, dx = 1.0, dy = 1.0;
  int columns = 0, rows = 0;
};
/// `width`: diameter of the support of the coarse-graining function, m. Points are a tenth of it apart, or a
/// little less along x, as a whole number goes around the period.
FieldGrid field_grid(const analysis::GrainSource& frame, double width);

/// Throws Error(usage) where `width` is not in (0, length of the bed].
void check_field_width(const RunStatics& statics, double width);

/// Throws as check_field_width.
std::string fields_vti(const analysis::GrainSource& frame, double width);

}  // namespace talus::exports
