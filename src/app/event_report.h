#pragma once
/// Reports of the rearrangements of a run.

#include <cstddef>
#include <string>
#include <vector>

#include "runs/first_moves.h"
#include "runs/run_view.h"

namespace talus::app {

/// Returns lines on the distributions of events: count, sizes, waiting angles, fraction that dilates the bed;
/// or the reason why a number is missing.
std::string event_summary(const runs::RunView& run);

/// Returns a table of the events (lengths in mean diameters, angles in degrees, energies in m g D) and the
/// summary. `largest`: number of events shown, those of largest energy, in the order of the run; 0 for all.
std::string events_text(const runs::RunView& run, std::size_t largest);

/// Returns the scalars of the run and its events, under the names of the table of quantities; SI units,
/// radians.
std::string events_json(const runs::RunView& run);

/// Returns a line for each event, with the columns of the table of quantities; SI units, radians, empty for
/// missing values. The title line, with units, is the same for all runs.
std::string events_csv(const runs::RunView& run, bool titles);

/// Grains of a run that moved by at least `displacement`, in order (runs/first_moves.h). The text report
/// shows the first of them, JSON and CSV all of them, in the units given above.
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
