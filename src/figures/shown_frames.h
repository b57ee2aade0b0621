#pragma once
/// Frames that a figure shows together, as named by `talus figures --at`.

#include <string>
#include <vector>

#include "figures/group_table.h"

namespace talus::figures {

/// Entries of pictures::frames_at: "10" (deg), "repose" or "frame42". Empty: the default frames of the
/// figure.
using FrameWords = std::vector<std::string>;

/// Frames of several runs, one for each run that has it.
struct ShownFrames {
  std::string name;   ///< for columns: "10", "repose", "start" for frame0, "frame42"
  std::string label;  ///< key, in gnuplot's enhanced text: "{/:Italic θ} = 10°", "before failure"
  std::string text;   ///< text for captions: "at 10 deg", "in the last frame before failure"
  FramesAtAngle at;
};

/// Returns the frames of `at` or, if it is empty, those of `usual`; a default angle is shown only for the
/// runs that reach it. Throws Error(usage) if an entry of `at` is invalid, and Error(bad_data) if no run has
/// its frame.
std::vector<ShownFrames> shown_frames(const RunChoice& runs, const FrameWords& at, const FrameWords& usual);

/// Sets the labels of the frames in the script of a figure as said_1, said_2, ..., and the names of their
/// columns as `shown`, and adds them to its caption.
void set_shown_frames(Figure& figure, std::span<const ShownFrames> shown);

/// Returns the frames of `at` for one run, ascending. Throws as pictures::frames_at does.
std::vector<std::size_t> frames_of_run(const runs::RunView& run, const FrameWords& at);

/// Returns the mean tilt of frames of runs, rad.
double mean_tilt(const FramesAtAngle& at);

}  // namespace talus::figures
