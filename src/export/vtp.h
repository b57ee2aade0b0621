#pragma once
/// Frames as XML PolyData of VTK, for ParaView.

#include <span>
#include <string>

#include "analysis/frame_quantities.h"

namespace talus {

/// Grains as points (vertices), m, with their fields as point data.
std::string grains_vtp(const GrainSource& frame);

/// Contacts as lines, m, each with end points of its own: from the centre of a to that of b, or to the
/// contact point where b is a plane. Across the periodic edge a line goes on to the image of b. Fields are
/// cell data, and normal forces point data too, as filters that draw tubes want them.
std::string contacts_vtp(const GrainSource& frame);

/// A file of a series.
struct PvdEntry {
  double time = 0.0;  ///< s
  std::string file;   ///< seen from the .pvd
};

/// A .pvd: files over time.
std::string pvd_text(std::span<const PvdEntry> entries);

}  // namespace talus
