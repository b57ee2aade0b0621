#pragma once
/// The first grains of a run that move by a given distance.

#include <cstddef>
#include <vector>

#include "io/run_file.h"

namespace talus::runs {

/// A free grain in the first frame in which its displacement since the first frame of the run, at the start
/// of the tilt, reaches a given distance. Displacements are relative to the bed and do not include its
/// rotation.
struct FirstMove {
  Index grain = 0;
  std::size_t frame = 0;      ///< number of the frame, counted from 0
  double time = 0.0;          ///< time of the frame, s
  double tilt = 0.0;          ///< rad
  double x = 0.0, y = 0.0;    ///< centre of the grain in this frame, m
  double depth = 0.0;         ///< depth below the mean free surface, V / L, of this frame, m
  double displacement = 0.0;  ///< m
};

/// Returns the first move of each grain that moves by `distance` (m), by frame, and within a frame in
/// descending order of displacement. The flow after failure is included. Motion that reverses within the
/// interval between two frames is not detected. Throws as RunFile::positions does.
std::vector<FirstMove> first_moves(const io::RunFile& run, double distance);

}  // namespace talus::runs
