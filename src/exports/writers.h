#pragma once
/// Frames as text in all export formats.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/deformation/deformation.h"
#include "analysis/frame_quantities.h"
#include "analysis/record.h"
#include "core/observables.h"
#include "core/types.h"
#include "io/run_file.h"
#include "pictures/maps.h"

namespace talus::exports {

// The quantities of a frame (frame_quantities.h) as columns, in the order of their table, which all writers
// follow; and the names that other programs use for some of them. Centres of grains are excluded, because
// each format stores them in its own place.

/// A quantity of a frame.
struct FieldColumn {
  analysis::FrameQuantity field;
  std::string ending;          ///< suffix of its threshold, if it has one: "_1_5" for 1.5
  std::vector<double> values;  ///< one entry per row

  std::string name() const { return std::string(field.name) + ending; }
};

/// Number of columns of grains, id and type, that precede the centre in tables.
inline constexpr std::size_t columns_before_centre = 2;

/// Returns the columns of all grains, floor included, in the order of their ids.
std::vector<FieldColumn> grain_columns(const analysis::GrainSource& frame);
/// Returns the columns of all contacts, in the order of their keys.
std::vector<FieldColumn> contact_columns(const analysis::GrainSource& frame);

/// Returns the names of a column's components in tables: "velocity_x", "velocity_y", "lc_1_5".
std::vector<std::string> component_names(const FieldColumn& column);

/// Returns the box, m. Along x it is the period, or reaches from wall to wall; along y it reaches from the
/// lowest to the highest point of the grains in the frame. Along z it is one mean diameter thick.
pictures::MapExtent bed_bounds(const analysis::GrainSource& frame);

// Frames and observables as tables. The first line names columns, with their units in brackets: "time (s)". A
// missing number is an empty field.

/// Rows of a frame, and their header.
struct CsvRows {
  std::string head, rows;
};

/// Returns a row for the frame: its number, step, time and tilt.
CsvRows frame_csv(const analysis::GrainSource& frame);
/// Return a row for each grain or contact; the first column is the number of the frame.
CsvRows grains_csv(const analysis::GrainSource& frame);
CsvRows contacts_csv(const analysis::GrainSource& frame);

/// Returns a table of all observables.
std::string observables_csv(std::span<const ObservableRow> rows);

// Frames as extended XYZ, for OVITO and ASE.

/// Returns a frame, to be appended to the preceding one in the same file. Lengths are in mean diameters, and
/// everything else is in SI units: OVITO interprets coordinates that all lie between 0 and 1 as fractions of
/// the box, which would happen for a bed shorter than a metre. The line of the box has the diameter, m.
std::string xyz_text(const analysis::GrainSource& frame);

// Frames as the text of a LAMMPS dump (custom style), for OVITO.

/// Written only before the first frame, as LAMMPS does: OVITO would not find frames after a second one.
inline constexpr std::string_view lammps_dump_head = "ITEM: UNITS\nsi\n";

/// Returns a frame, to be appended to the preceding one in the same file: SI units (`units si`), and no
/// column z, which shows OVITO that the frame is two-dimensional.
std::string lammps_dump_text(const analysis::GrainSource& frame);

// Frames as VTK XML PolyData, for ParaView.

/// Returns grains as points (vertices), m, with their fields as point data.
std::string grains_vtp(const analysis::GrainSource& frame);

/// Returns contacts as lines, m, each with its own end points: from the centre of a to that of b, or to the
/// contact point if b is a plane. Across the periodic edge a line continues to the image of b. Fields are
/// cell data; normal forces are also point data, which filters that draw tubes require.
std::string contacts_vtp(const analysis::GrainSource& frame);

/// A file of a series.
struct PvdEntry {
  double time = 0.0;  ///< s
  std::string file;   ///< path relative to the .pvd
};

/// Returns a .pvd: files over time.
std::string pvd_text(std::span<const PvdEntry> entries);

// Coarse-grained fields of frames on a grid, as VTK XML ImageData, for ParaView.

/// A field of the bed as a continuum; a test compares docs/export.md with the table of these.
struct GridField {
  std::string_view name;
  analysis::FieldShape shape = analysis::FieldShape::scalar;
  std::string_view unit;        ///< SI, or "1"
  std::string_view definition;  ///< one sentence
  /// Appends its components at a point. `material`: density of the grains, kg/m^3.
  void (*append)(std::vector<double>& values, const analysis::CoarseField& at, double material) = nullptr;
};
std::span<const GridField> grid_fields();

/// Points in rows, from the lowest row upwards and along x in each, m. They extend beyond the bed by the
/// cutoff of the coarse-graining function, beyond which all fields vanish, so that a sum over all points,
/// times dx dy, is an integral over the bed. They cover a period once.
struct FieldGrid {
  double x = 0.0, y = 0.0, dx = 1.0, dy = 1.0;
  int columns = 0, rows = 0;
};
/// Returns the grid for a coarse-graining function whose support has diameter `width`, m. Points are a tenth
/// of it apart, or slightly less along x, because a whole number must fit the length.
FieldGrid field_grid(const analysis::GrainSource& frame, double width);

/// Throws Error(usage) if `width` is not in (0, length of the bed].
void check_field_width(const RunStatics& statics, double width);

/// Returns the file of a frame. Throws the errors of check_field_width.
std::string fields_vti(const analysis::GrainSource& frame, double width);

// A run as a single self-contained HTML page, readable without Talus: maps, time line, curves and texts.
// docs/export.md describes the page; its source is in assets/page.

/// Returns the page of these frames (indices in the run, ascending) of the run file at `path`, whose name is
/// in the title; `analysis` is that of the entire run. The same run, frames and analysis give the same bytes.
/// Throws Error(stopped) if it was stopped, and the errors of RunFile::frame.
std::string run_page(const io::RunFile& file, const std::string& path, const analysis::Analysis& analysis,
                     const std::vector<std::size_t>& frames, const Watch& watch);

}  // namespace talus::exports
