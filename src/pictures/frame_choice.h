#pragma once
/// Which frames of a run are drawn, and what their files are called.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace talus::pictures {

/// Indices into `tilts` (rad, in the order of time, not empty), ascending and without doubles. Tilts ascend
/// but for a run with a programme.
using FrameChoice = std::vector<std::size_t>;

/// The frames nearest to the angles listed: degrees, or "repose" for the last frame with tilt <= theta_c
/// (rad, NaN while the slope has not failed). Where the tilt goes up and down, an angle is that of the first
/// frame that reaches it, and "repose" belongs to the last rise. "frame42" is the frame of that number.
/// Throws Error(usage) where an entry is neither, Error(bad_data) where no frame lies within half the spacing
/// of the frames, or where the angle of repose is not known.
FrameChoice frames_at(const std::vector<double>& tilts, const std::vector<std::string>& entries,
                      double theta_c);

/// The frames with the numbers listed, of `count`: "7", or "0-10" for a range. Throws Error(usage) where an
/// entry is neither, Error(bad_data) where there is no such frame.
FrameChoice frames_listed(const std::vector<std::string>& entries, std::size_t count);

/// The frame nearest to a tilt (rad; NaN: none), however far away.
std::optional<std::size_t> nearest_frame(const std::vector<double>& tilts, double tilt);

/// The frame that motion up to frame k is measured from: the one before, or `since` where there is one; none
/// where that does not come before k.
std::optional<std::size_t> reference_frame(std::size_t k, std::optional<std::size_t> since);

/// The frame nearest to a tilt (rad), if there is one within half the spacing of the frames; the first time
/// that the tilt comes there.
std::optional<std::size_t> frame_near(const std::vector<double>& tilts, double tilt);

/// The frames nearest to 0, `every`, 2 `every`, ... degrees; all frames where `every` is below their spacing.
/// Where the tilt goes up and down, those of each way up, of each way down, and the turns between them.
FrameChoice frames_every(const std::vector<double>& tilts, double every);

/// The last frame with tilt <= theta_c (rad): the slope just before it failed, in its last_rise.
std::size_t frame_at_repose(const std::vector<double>& tilts, double theta_c);

/// "012.00": an angle (rad) in degrees, as names of files have it that sort by angle.
std::string angle_name(double tilt, int decimals);

/// With how many decimals, at least two, angle_name tells the chosen frames apart, as far as they have a
/// tilt. Throws Error(bad_data) where none does.
int angle_decimals(const std::vector<double>& tilts, const FrameChoice& choice);

}  // namespace talus::pictures
