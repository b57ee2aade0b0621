#pragma once
/// The rearrangements of a run as text.

#include <cstddef>
#include <string>
#include <vector>

#include "runs/first_moves.h"
#include "runs/run_view.h"

namespace talus::app {

/// What the distributions say, in lines: count, sizes, waiting angles, share that dilates; and why where
/// there is no number.
std::string event_summary(const runs::RunView& run);

/// A table of the events, lengths in mean diameters, angles in degrees, energies in m g D; and the summary.
/// `largest`: so many events by their energy, in the order of the run; 0 for all.
std::string events_text(const runs::RunView& run, std::size_t largest);

/// Numbers of the run, and its events, under the names of the table of quantities; SI units, radians.
std::string events_json(const runs::RunView& run);

/// A line for each event, with the columns of the table of quantities; SI units, radians, empty where there
/// is no value. The line of their titles, with units, is the same for all runs.
std::string events_csv(const runs::RunView& run, bool titles);

/// The first grains of a run that moved so far (runs/first_moves.h), as a table of the first of them; all of
/// them as JSON, and as lines of CSV. Units as above.
struct MovedGrains {
  std::string path;
  RunStatics statics;
  double displacement = 0.0;  ///< D
  std::vector<runs::FirstMove> moves;
};
std::string moves_text(const MovedGrains& grains);
std::string moves_json(const MovedGrains& grains);
std::string moves_csv(const MovedGrains& grains, bool titles);

}  // namespace talus::app
