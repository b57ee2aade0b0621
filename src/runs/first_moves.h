#pragma once
/// The first grains of a run that moved so far.

#include <cstddef>
#include <vector>

#include "io/run_file.h"

namespace talus::runs {

/// A free grain in the first frame in which it is a given distance or more from where it was in the first
/// frame of the run, as the tilt began; in the frame of the bed, not counting the turn of the bed.
struct FirstMove {
  Index grain = 0;
  std::size_t frame = 0;      ///< counted from 0
  double time = 0.0;          ///< s, of the frame
  double tilt = 0.0;          ///< rad
  double x = 0.0, y = 0.0;    ///< m, its centre in that frame
  double depth = 0.0;         ///< m below the mean free surface, V / L, of that frame
  double displacement = 0.0;  ///< m
};

/// Of each grain that moves `distance` (m), by frame, and within a frame the farthest first. The flow after
/// failure counts. A grain that comes back in less than a frame is not seen. Throws as RunFile::positions
/// does.
std::vector<FirstMove> first_moves(const io::RunFile& run, double distance);

}  // namespace talus::runs
