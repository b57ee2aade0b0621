#pragma once
/// Lines of progress that fit a terminal: one that is too long wraps, and its rewriting scrolls.

#include <optional>
#include <string>
#include <vector>

namespace talus {

/// "8 s", "2 min 05 s", "3 h 10 min".
std::string duration_text(double seconds);

/// A part of a line. Of a line that is too long, those of the highest rank go first; those of rank 0 stay.
struct ProgressField {
  std::string text;
  int rank = 0;
};

/// The fields two blanks apart, in at most `width` columns; without a width all of them. Cut where even those
/// of rank 0 are longer. ASCII.
std::string fitted_line(const std::vector<ProgressField>& fields, std::optional<int> width);

/// "[#####---------------]", 22 columns; `share` in [0, 1].
std::string progress_bar(double share);

/// Where a run is.
struct RunShown {
  enum class Stage { deposition, tilt, flow } stage = Stage::deposition;
  double time = 0.0;                ///< s, of the model
  double tilt = 0.0;                ///< deg
  double tilt_end = 0.0;            ///< deg, where the tilt ends, or a slope is expected to fail
  bool end_expected = false;        ///< the latter
  std::optional<double> remaining;  ///< s, until then
  double residual = 0.0;
  double kinetic_energy = 0.0;  ///< J
  double velocity = 0.0;        ///< rms, over g h
  int contacts = 0;
  double seconds = 0.0;  ///< since this process began
};

/// "tilt 12.345 deg  [############--------]  61 %  ETA 45 s  (1 min 20 s)", and what else there is room for.
/// Of `width` columns for a terminal, without a bar where there is no width.
std::string run_progress_text(const RunShown& shown, std::optional<int> width);

/// Columns that a line on stderr can fill without wrapping; 79 where they cannot be told.
int terminal_columns();

}  // namespace talus
