#pragma once
/// Frames as extended XYZ, for OVITO and ASE.

#include <string>

#include "analysis/frame_quantities.h"

namespace talus {

/// A frame, to follow the one before in the same file. Lengths are in mean diameters, all else is SI: OVITO
/// takes coordinates that all lie between 0 and 1 for shares of the box, as those of a bed shorter than a
/// metre would. The line of the box has the mean diameter in m.
std::string xyz_text(const GrainSource& frame);

}  // namespace talus
