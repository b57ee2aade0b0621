#pragma once
/// Whether what a run file holds can be: its series in order, its numbers finite, its grains apart, its
/// forces those that the contact law and Newton's law allow, its stresses those of its forces.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "io/run_file.h"

namespace talus::session {

struct RunCheck {
  /// What is wrong, one sentence each with the data set or the frame; at most `most_faults`, and how many
  /// more.
  std::vector<std::string> faults;
  std::size_t changed = 0;  ///< data sets and frames that do not agree with their hashes
  std::size_t frames = 0, rows = 0, steps = 0, commands = 0, frames_at_rest = 0;
  double largest_overlap = 0.0;       ///< D, of two grains in a frame
  double largest_mobilisation = 0.0;  ///< |f_t| / (mu f_n) in a frame; 1: friction is fully mobilised
  double largest_imbalance = 0.0;  ///< m g, rms over the grains of a frame at rest: sum of forces and weight
  double largest_moment_error = 0.0;  ///< of an internal moment, over the largest of its frame
};
inline constexpr std::size_t most_faults = 20;

/// What is still right, for a frame as it is stored (single precision).
inline constexpr double overlap_limit = 0.5;         ///< D; more where the guards of the run let it go on
inline constexpr double mobilisation_limit = 1.001;  ///< the solver's tolerance, and single precision
/// m g: twice what rest allows a velocity to change in h, by the usual deposition.rest_velocity; a larger one
/// allows more.
inline constexpr double imbalance_limit = 0.02;
inline constexpr double moment_error_limit = 1e-5;

/// Reads all of a run. Of one that was repaired (RunFile::lost) the series may lack rows and values.
/// `progress` is called after each frame with how many there were; may be empty. Frames that cannot be read
/// are faults. Throws as RunFile where the run itself cannot be read.
RunCheck check_run(const io::RunFile& run, const std::function<void(std::size_t)>& progress);

}  // namespace talus::session
