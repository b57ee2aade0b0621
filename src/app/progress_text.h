#pragma once
/// The text of lines of progress, cut to the width of a terminal.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "session/estimate.h"
#include "session/schedule.h"

namespace talus {

/// A part of a line. Where the line is too long, the fields of the highest rank are left out first; those of
/// rank 0 stay.
struct ProgressField {
  std::string text;
  int rank = 0;
};

/// The fields, two blanks apart, in at most `width` columns; all of them where no width is given. The line is
/// cut where even the fields of rank 0 are too long. ASCII.
std::string fitted_line(const std::vector<ProgressField>& fields, std::optional<int> width);

/// "[#####---------]", 16 columns; `share` in [0, 1].
std::string progress_bar(double share);

/// How far a piece of work is: its bar on a terminal, the percentage, the time since it began and the time
/// that it will still take. Without a share, or where it has passed 1 and so promises nothing, only the
/// elapsed time.
std::vector<ProgressField> progress_fields(std::optional<double> share, double elapsed,
                                           std::optional<double> remaining, bool bar);

/// "rendering 12/48", and how far that is.
std::string count_progress_text(const std::string& label, std::size_t done, std::size_t count, double elapsed,
                                std::optional<int> width);

/// Where a run is.
struct RunShown {
  Phase phase = Phase::deposition;       ///< not done
  double time = 0.0;                     ///< s, of the model
  double tilt = 0.0;                     ///< deg
  std::optional<double> share;           ///< of this phase that is done
  std::optional<double> repose_assumed;  ///< deg, where the share assumes that the slope fails
  std::optional<double> remaining;       ///< s, until the end of this phase
  double residual = 0.0;
  double kinetic_energy = 0.0;  ///< J
  double velocity = 0.0;        ///< rms, over g h
  int contacts = 0;
  double seconds = 0.0;  ///< since this process began
};

/// "tilt 12.345 deg  [########------]  61 %  elapsed 1 min 20 s  ETA 45 s", and whatever else there is room
/// for. Without a width, as in a log, the line has no bar.
std::string run_progress_text(const RunShown& shown, std::optional<int> width);

}  // namespace talus
