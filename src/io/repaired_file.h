#pragma once
/// A run file made of the pieces that are whole of a damaged one. Private to this room.

#include "io/run_pieces.h"

namespace talus {

/// Makes pieces that a run file can be made of: what hangs together is kept whole or left out, what can be
/// made again is; what was lost is noted. Of the series a column that is lost becomes NaN; one that the
/// others cannot do without (step, time, tilt, phase) takes its table with it. Throws Error(bad_data), naming
/// `path`, where what a run cannot do without is lost.
void mend(RunPieces& pieces, const std::string& path);

/// The same for the series of a segment alone.
void mend_series(RunPieces& pieces);

/// "/steps/residual, frames 3 to 5": all that was lost.
std::string lost_text(const RunPieces& pieces);

/// "frames 3 to 5, at 0.750 to 1.250 deg": those that follow each other together.
std::vector<std::string> lost_frame_lines(const RunPieces& pieces);

/// The bytes of the run file, sealed.
std::vector<std::byte> file_of(const RunPieces& pieces);

}  // namespace talus
