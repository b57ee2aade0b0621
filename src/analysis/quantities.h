#pragma once
/// Analysis measures frames and runs. analyse_frame (frame_analysis.h) makes a FrameRecord of a frame, a
/// Quantity of the table below names each number of it, and an Analysis (record.h) holds all of a run. Each
/// folder is one subject of measurement.
///
/// Table of all quantities of an analysis: the member that holds each quantity, its storage, its definition,
/// and its display. The run file, JSON, plots, traces and figures use this table; a test compares
/// docs/analysis.md with it. In the code a quantity is identified by its member; names are for files and
/// users.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "analysis/record.h"
#include "core/observables.h"

namespace talus::analysis {

/// The member of an Analysis that holds a quantity. The type of the record determines whether the quantity
/// belongs to a run, a threshold, a frame, a frame at a threshold, or an event.
using QuantityMember =
    std::variant<double Analysis::*, std::array<double, 2> Analysis::*, std::vector<double> Analysis::*,
                 double RunThreshold::*, double FrameRecord::*, Index FrameRecord::*,
                 std::array<double, 2> FrameRecord::*, std::array<double, 3> FrameRecord::*,
                 std::array<double, 4> FrameRecord::*, std::vector<double> FrameRecord::*,
                 double FrameThreshold::*, Index FrameThreshold::*, std::array<Index, 2> FrameThreshold::*,
                 std::array<double, 2> FrameThreshold::*, std::vector<float> FrameThreshold::*,
                 std::vector<Index> FrameThreshold::*, double EventRecord::*, Index EventRecord::*,
                 std::array<double, 2> EventRecord::*>;

/// Display of a quantity in curves; empty if no curve shows it.
struct Display {
  std::string symbol;  ///< "p_o": short, for a legend
  std::string title;   ///< "p_o, share of overloaded grains"
  bool percent = false;
  std::optional<Observable> observable =
      std::nullopt;  ///< the same quantity as a run records it, more often than in frames
};

/// A row of the table of quantities.
struct Quantity {
  QuantityMember member;
  std::string name;             ///< "lc/mean": below /analysis in a file, and in JSON
  std::string shape;            ///< "T F": letters are sizes (docs/analysis.md); empty for a single number
  std::string unit;             ///< SI, or "1"
  std::string definition;       ///< one sentence or phrase
  std::string parameters = {};  ///< names of the parameters that it depends on, separated by blanks
  Display display{};
};

/// Returns the table, in the order of storage.
const std::vector<Quantity>& quantities();

/// Returns the row of a member. Throws Error(internal) if the table has none.
const Quantity& quantity_of(const QuantityMember& member);

/// Values of a quantity in the order of its shape: by frame, then by threshold, then within each.
using Values = std::variant<std::vector<double>, std::vector<float>, std::vector<Index>>;
/// Returns all values of a quantity.
Values values_of(const Quantity& quantity, const Analysis& analysis);

/// Sets the values of a quantity, an equal number for each frame and threshold; these records must exist.
void set_values(const Quantity& quantity, const Values& values, Analysis& analysis);

/// Returns a scalar quantity of a frame, at threshold f if it depends on one; NaN for any other quantity.
double number_of(const Quantity& quantity, const FrameRecord& frame, std::size_t f = 0);

/// Sets a scalar quantity of a frame, rounded if it is an integer; has no effect on any other quantity.
void set_number(const Quantity& quantity, double value, FrameRecord& frame, std::size_t f = 0);

/// Whether the quantity is a scalar of a frame, or of each threshold of a frame.
bool is_number_of_frame(const Quantity& quantity);

/// Whether the quantity is a scalar of a run, or one for each threshold or strain: no frames, bins or edges.
bool is_number_of_run(const Quantity& quantity);

/// Whether the quantity is a short list in a frame, or in each threshold of a frame (a distribution, a
/// correlation, the components of a tensor; no list of grains), or such a list in a run (edges of bins).
bool is_list_of_frame(const Quantity& quantity);
bool is_list_of_run(const Quantity& quantity);

/// Returns the list of a frame, at threshold f if it depends on one; empty for any other quantity.
std::vector<double> list_of(const Quantity& quantity, const FrameRecord& frame, std::size_t f = 0);

/// Returns element k of all values of a quantity as a double; NaN if there are fewer.
double number_of(const Quantity& quantity, const Analysis& analysis, std::size_t k);

/// Whether the quantity depends on the threshold. It has no values in an analysis without thresholds.
bool needs_threshold(const Quantity& quantity);

/// Whether the quantity has a value for each event. It has no values in an analysis without events.
bool is_of_events(const Quantity& quantity);

/// Converts from the unit of the table of quantities to that of tables for users: lengths from m to mean
/// diameters, angles from rad to degrees; other values are unchanged.
double scaled(std::string_view unit, double value, double mean_diameter);
/// Returns "D", "deg", or the unit itself.
std::string scaled_unit(std::string_view unit);

/// Returns the title of an axis, rich text with its unit: "θ (°)", "t (s)"; the text alone if the unit is
/// "1".
std::string axis_title(std::string_view text, std::string_view unit);

/// Return the value in the unit of curves, which is that of tables except that small shares are in percent,
/// and the title with this unit: "Volume strain ΔV/V (%)".
double shown(const Quantity& quantity, double value, double mean_diameter);
std::string shown_title(const Quantity& quantity);

/// Returns the quantities of all events together, then those of each event.
std::vector<Quantity> event_quantities();

}  // namespace talus::analysis
