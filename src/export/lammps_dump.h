#pragma once
/// Frames as the text of a LAMMPS dump (custom style), for OVITO.

#include <string>

#include "export/exported_frame.h"

namespace talus {

/// A frame, to follow the one before in the same file: SI units (`units si`), without a column z, by which
/// OVITO knows that it is two-dimensional.
std::string lammps_dump_text(const ExportedFrame& frame);

}  // namespace talus
