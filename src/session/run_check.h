#pragma once
/// Physical and formal checks of a run file: series in order, finite numbers, grains apart, forces allowed by
/// the contact law and Newton's law, stresses consistent with the forces.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "io/run_file.h"

namespace talus::session {

struct RunCheck {
  /// Faults, one sentence each with the data set or the frame; at most `max_faults`, then their number.
  std::vector<std::string> faults;
  std::size_t changed = 0;  ///< number of data sets and frames that do not match their hashes
  std::size_t frames = 0, rows = 0, steps = 0, commands = 0, frames_at_rest = 0;
  double largest_overlap = 0.0;       ///< D, largest overlap of two grains in a frame
  double largest_mobilisation = 0.0;  ///< |f_t| / (mu f_n) in a frame; 1: friction is fully mobilised
  double largest_imbalance = 0.0;  ///< m g, rms over the grains of a frame at rest: sum of forces and weight
  double largest_moment_error = 0.0;  ///< error of an internal moment, over the largest moment of its frame
};
inline constexpr std::size_t max_faults = 20;

/// Tolerances for a frame as stored (single precision).
inline constexpr double overlap_limit = 0.5;         ///< D; larger if the guards of the run allow more
inline constexpr double mobilisation_limit = 1.001;  ///< margin for solver and single precision
/// m g: twice the change of velocity in a step that rest allows with the default deposition.rest_velocity; a
/// larger rest_velocity allows more.
inline constexpr double imbalance_limit = 0.02;
inline constexpr double moment_error_limit = 1e-5;

/// Reads an entire run and checks it. The series of a repaired run (RunFile::lost) may lack rows and values.
/// `progress` is called after each frame with the number checked; it may be empty. Frames that cannot be read
/// are faults. Throws as RunFile does if the run itself cannot be read.
RunCheck check_run(const io::RunFile& run, const std::function<void(std::size_t)>& progress);

}  // namespace talus::session
