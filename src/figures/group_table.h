#pragma once
/// Figures with one table for each group of runs, and the variables for their scripts.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "figures/figure.h"
#include "figures/run_group.h"
#include "figures/run_means.h"

namespace talus::figures {

/// The runs of a group that enter a figure.
using RunChoice = std::vector<const runs::RunView*>;

/// Return all runs of a group, those with a threshold and hence overloaded grains, and those that have
/// failed.
RunChoice all_runs(const RunGroup& group);
RunChoice runs_with_threshold(const RunGroup& group);
RunChoice failed_runs(const RunGroup& group);

/// Returns the runs whose files are available, for data that an ensemble file lacks.
RunChoice with_files(RunChoice runs);
/// Returns the runs whose frames are available as well; an ensemble may store a run without its frames.
RunChoice with_frames(RunChoice runs);

/// Returns the runs with known distributions; ensemble.h5 stores only their means.
RunChoice with_distributions(RunChoice runs);

/// The runs that reach a tilt (rad) before failure, and the nearest frame of each.
struct FramesAtAngle {
  RunChoice runs;
  std::vector<std::size_t> frames;
};
/// Returns the runs that reach a tilt (rad), and the nearest frame of each.
FramesAtAngle frames_at_angle(const RunChoice& runs, double tilt);

/// Returns a sentence for captions with the neighbourhood of a grain to which gamma refers.
std::string reading_caption(const runs::RunView& run);

/// Returns the name of the table of a group: its label as a part of a file name.
std::string table_name(const RunGroup& group);

/// Adds the table of a group, named after its label, before any other table. In the script its file is
/// data_g, with label_g for the key and every_g for the number of rows between symbols. `groups` is the
/// number of groups, and theta_max the largest angle (deg) in the columns "theta" or "angle_left". The key
/// has room for the labels and one further entry.
void add_group_table(Figure& figure, const RunGroup& group, const RunChoice& runs,
                     std::vector<Column> columns);

/// Adds the means of these columns over the runs of a group as a function of an angle, as add_group_table
/// does. If there are several runs, a further table contains the single runs; in the script its file is
/// runs_g, and drawn_g their number. `spread` is 1 if any group has such a table: then the key explains bands
/// and thin lines.
void add_group_curves(Figure& figure, const RunGroup& group, const RunChoice& runs,
                      std::span<const FrameColumn> columns, Abscissa abscissa = Abscissa::tilt);

/// Sets or replaces a variable of the script.
void set_variable(Figure& figure, const std::string& name, const std::string& value);
void set_variable(Figure& figure, const std::string& name, double value);

/// Returns a text in quotes for gnuplot, with the control characters of enhanced text escaped.
std::string gnuplot_quoted(std::string_view text);

/// Returns a text in quotes that is plain or already enhanced text.
std::string gnuplot_string(std::string_view text);

/// Returns the number of runs as text: "4 runs", "1 run".
std::string runs_text(std::size_t count);

}  // namespace talus::figures
