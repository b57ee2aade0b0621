#pragma once
/// Frames as the text of a LAMMPS dump (custom style), for OVITO.

#include <string>
#include <string_view>

#include "analysis/frame_quantities.h"

namespace talus {

/// Before the first frame, and only there, as LAMMPS does: OVITO would not find the frames after a second
/// one.
inline constexpr std::string_view lammps_dump_head = "ITEM: UNITS\nsi\n";

/// A frame, to follow the one before in the same file: SI units (`units si`), without a column z, by which
/// OVITO knows that it is two-dimensional.
std::string lammps_dump_text(const GrainSource& frame);

}  // namespace talus
