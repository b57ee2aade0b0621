#pragma once
/// Selects the frames of a run to be drawn, and names their files.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace talus::pictures {

/// Indices of frames, ascending and unique: into `tilts` (rad, in the order of time, not empty), with the
/// frames of the flow after failure behind them. Tilts ascend unless the run has a programme.
using FrameChoice = std::vector<std::size_t>;

/// Returns the frames nearest to the listed angles: degrees, or "repose" for the last frame with tilt <=
/// theta_c (rad, NaN while the slope has not failed). If the tilt goes up and down, an angle refers to the
/// first frame that reaches it, and "repose" to the last rise. "frame42" is the frame of that number, and
/// "frame0-frame10" a range of frames; `count` includes the frames of the flow after failure, which have no
/// angle here (without it, there are those of the tilt). Throws Error(usage) for any other entry, and
/// Error(bad_data) if no frame lies within half the frame spacing, a number is too large, or the angle of
/// repose is unknown.
FrameChoice frames_at(const std::vector<double>& tilts, const std::vector<std::string>& entries,
                      double theta_c, std::optional<std::size_t> count = std::nullopt);

/// Returns the frame of a choice that has one. Throws Error(usage) if `entry`, a range, names several.
std::size_t single_frame(const FrameChoice& choice, const std::string& entry);

/// Returns the frame nearest to a tilt (rad; NaN: none), however far away.
std::optional<std::size_t> nearest_frame(const std::vector<double>& tilts, double tilt);

/// Returns the frame from which motion up to frame k is measured: the preceding one, or `since` if given;
/// none if that does not precede k.
std::optional<std::size_t> reference_frame(std::size_t k, std::optional<std::size_t> since);

/// Returns the first frame nearest to a tilt (rad) within half the frame spacing, if there is one.
std::optional<std::size_t> frame_near(const std::vector<double>& tilts, double tilt);

/// Returns the frames nearest to 0, `every`, 2 `every`, ... degrees; all frames if `every` is below their
/// spacing. If the tilt goes up and down, this applies to each rise and fall, with the turning points.
FrameChoice frames_every(const std::vector<double>& tilts, double every);

/// Returns the last frame with tilt <= theta_c (rad): the slope just before it failed, in its last_rise.
std::size_t frame_at_repose(const std::vector<double>& tilts, double theta_c);

/// Returns an angle (rad) in degrees, "012.00", so that file names sort by angle.
std::string angle_name(double tilt, int decimals);

/// Returns the number of decimals, at least two, with which angle_name distinguishes the chosen frames (those
/// that have a tilt). Throws Error(bad_data) if no number does.
int angle_decimals(const std::vector<double>& tilts, const FrameChoice& choice);

}  // namespace talus::pictures
