#pragma once
/// All quantities of an analysis in one table: the member that holds each, how it is stored, what it means
/// and how it is shown. The file of a run, JSON, plots, traces and figures go by it; docs/analysis.md is
/// compared with it by a test. Whoever wants a quantity names its member; strings are for files and users.

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

/// Where a quantity is found in an Analysis. The type of the record says what it is one of: a run, a
/// threshold, a frame, a frame at a threshold, or an event.
using QuantityMember =
    std::variant<double Analysis::*, std::array<double, 2> Analysis::*, std::vector<double> Analysis::*,
                 double RunThreshold::*, double FrameRecord::*, Index FrameRecord::*,
                 std::array<double, 2> FrameRecord::*, std::array<double, 3> FrameRecord::*,
                 std::array<double, 4> FrameRecord::*, std::vector<double> FrameRecord::*,
                 double FrameThreshold::*, Index FrameThreshold::*, std::array<Index, 2> FrameThreshold::*,
                 std::array<double, 2> FrameThreshold::*, std::vector<float> FrameThreshold::*,
                 std::vector<Index> FrameThreshold::*, double EventRecord::*, Index EventRecord::*,
                 std::array<double, 2> EventRecord::*>;

/// How a quantity is shown beside others; empty for one that no curve shows.
struct Display {
  std::string symbol;  ///< "p_o": short, for a legend
  std::string title;   ///< "p_o, share of overloaded grains"
  bool percent = false;
  std::optional<Observable> observable =
      std::nullopt;  ///< where a run records it as well, more often than in frames
};

struct Quantity {
  QuantityMember member;
  std::string name;        ///< "lc/mean": below /analysis in a file, and in JSON
  std::string shape;       ///< "T F": letters are sizes (docs/analysis.md); empty for a single number
  std::string unit;        ///< SI, or "1"
  std::string definition;  ///< one sentence
  std::string parameters;  ///< names of those that it depends on, with blanks between; may be empty
  Display display{};
};

/// In the order in which they are stored.
const std::vector<Quantity>& quantities();

/// The row of a member. Throws Error(internal) where the table has none.
const Quantity& quantity_of(const QuantityMember& member);

/// All values of a quantity in the order of its shape: by frame, then by threshold, then within.
using Values = std::variant<std::vector<double>, std::vector<float>, std::vector<Index>>;
Values values_of(const Quantity& quantity, const Analysis& analysis);

/// Sets them, each frame and threshold to an equal part; these must be there.
void set_values(const Quantity& quantity, const Values& values, Analysis& analysis);

/// A single number of a frame, at threshold f where it depends on one; NaN for a quantity that is no such
/// number.
double number_of(const Quantity& quantity, const FrameRecord& frame, std::size_t f = 0);

/// Sets it, rounded where it counts something; leaves a quantity that is no such number.
void set_number(const Quantity& quantity, double value, FrameRecord& frame, std::size_t f = 0);

/// Whether there is one number of it in a frame, or one for each threshold of a frame.
bool is_number_of_frame(const Quantity& quantity);

/// Whether there is one number of it in a run, or one for each threshold or strain: no frames, bins or edges.
bool is_number_of_run(const Quantity& quantity);

/// Whether there is a short list of it in a frame, or one for each threshold of a frame: a distribution, a
/// correlation, the components of a tensor; no grains. And whether it is such a list of a run: edges of bins.
bool is_list_of_frame(const Quantity& quantity);
bool is_list_of_run(const Quantity& quantity);

/// The numbers of such a list of a frame, at threshold f where it depends on one; none for other quantities.
std::vector<double> list_of(const Quantity& quantity, const FrameRecord& frame, std::size_t f = 0);

/// Element k of a quantity in doubles, among all its values; NaN where there are fewer.
double number_of(const Quantity& quantity, const Analysis& analysis, std::size_t k);

/// Whether it depends on the threshold: there is none of it in an analysis without thresholds.
bool needs_threshold(const Quantity& quantity);

/// Whether there is one of it for each event: there is none of it in an analysis without events.
bool is_of_events(const Quantity& quantity);

/// From a unit of the table of quantities to that of tables for users: lengths in mean diameters (m), angles
/// in degrees, all else as it is.
double scaled(std::string_view unit, double value, double mean_diameter);
/// And back.
double unscaled(std::string_view unit, double value, double mean_diameter);
/// "D", "deg", or the unit itself.
std::string scaled_unit(std::string_view unit);

/// In the unit of curves, which is that of tables but for small shares, in percent; and its title with the
/// unit: "Volume strain ΔV/V in %".
double shown(const Quantity& quantity, double value, double mean_diameter);
std::string shown_title(const Quantity& quantity);

}  // namespace talus::analysis
