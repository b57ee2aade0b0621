#pragma once
/// A figure with one table for each group of runs, and what its script has to know of them.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "figures/figure.h"
#include "figures/run_group.h"
#include "figures/run_means.h"

namespace talus::figures {

/// Runs of a group that a figure is made from.
using RunChoice = std::vector<const runs::RunView*>;

/// All runs of a group; those that have overloaded grains, which need a threshold; those that have failed.
RunChoice all_runs(const RunGroup& group);
RunChoice runs_with_threshold(const RunGroup& group);
RunChoice failed_runs(const RunGroup& group);

/// Those of some runs whose files are there: for what values of an ensemble do not tell.
RunChoice with_files(RunChoice runs);
/// Those of which frames are there as well: an ensemble may keep a run without them.
RunChoice with_frames(RunChoice runs);

/// Those of some runs whose distributions are known: ensemble.h5 has no more than means of them.
RunChoice with_distributions(RunChoice runs);

/// Those of some runs that stand at a tilt (rad), and the frame of each that is nearest to it.
struct FramesAtAngle {
  RunChoice runs;
  std::vector<std::size_t> frames;
};
FramesAtAngle frames_at_angle(const RunChoice& runs, double tilt);

/// How the analysis of a run reads gamma, as a sentence for captions: of which neighbourhood of a grain.
std::string reading_caption(const runs::RunView& run);

/// The name of the table of a group: its label as a part of a file name.
std::string table_name(const RunGroup& group);

/// Adds the table of a group, called after its label, before any other table. The script knows its file as
/// data_g, with label_g for the key and every_g, rows from one symbol to the next; `groups` is their number,
/// and theta_max the largest angle (deg) of their columns "theta" or "angle_left". The key has room for the
/// labels and one entry more.
void add_group_table(Figure& figure, const RunGroup& group, const RunChoice& runs,
                     std::vector<Column> columns);

/// Adds the means of these columns over the runs of a group, over an angle, as add_group_table does; and,
/// where there are several runs, the runs themselves, drawn_g in number, in a table that the script knows as
/// runs_g. `spread` is
/// 1 where any group has them: then the key has to say what bands and thin lines are.
void add_group_curves(Figure& figure, const RunGroup& group, const RunChoice& runs,
                      std::span<const FrameColumn> columns, Abscissa abscissa = Abscissa::tilt);

/// Sets a variable of the script, or replaces it.
void set_variable(Figure& figure, const std::string& name, const std::string& value);
void set_variable(Figure& figure, const std::string& name, double value);

/// A text for gnuplot, in quotes; what its enhanced text would take for a command stands for itself.
std::string gnuplot_quoted(std::string_view text);

/// A text that means itself or is enhanced text already, in quotes.
std::string gnuplot_string(std::string_view text);

/// "4 runs", "1 run".
std::string runs_text(std::size_t count);

}  // namespace talus::figures
