#pragma once
/// The frames that a figure shows together, as `talus figures --at` names them.

#include <string>
#include <vector>

#include "figures/group_table.h"

namespace talus::figures {

/// Entries of pictures::frames_at: "10" (deg), "repose" or "frame42". Empty: the frames of the figure's own.
using FrameWords = std::vector<std::string>;

/// Frames of some runs, one of each that has it.
struct ShownFrames {
  std::string name;   ///< for columns: "10", "repose", "start" of frame0, "frame42"
  std::string label;  ///< for the key, gnuplot's enhanced text: "{/:Italic θ} = 10°", "before failure"
  std::string text;   ///< for captions: "at 10 deg", "in the last frame before failure"
  FramesAtAngle at;
};

/// Those of `at`; where it is empty those of `usual`, an angle of which is shown of the runs that stand
/// there. Throws Error(usage) where an entry of `at` is none, and Error(bad_data) where no run has its frame.
std::vector<ShownFrames> shown_frames(const RunChoice& runs, const FrameWords& at, const FrameWords& usual);

/// Says to the script of a figure how they are called, as said_1, said_2, ..., and `shown`, the names of
/// their columns; and to its caption.
void set_shown_frames(Figure& figure, std::span<const ShownFrames> shown);

/// The frames of `at` of one run, ascending. Throws as pictures::frames_at does.
std::vector<std::size_t> frames_of_run(const runs::RunView& run, const FrameWords& at);

/// The mean tilt of frames of runs, rad.
double mean_tilt(const FramesAtAngle& at);

}  // namespace talus::figures
