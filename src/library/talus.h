#pragma once
/// All of Talus as a library. docs/library.md shows how it is used.

#include "base/errors.h"
#include "base/version.h"
#include "library/measured_frame.h"
#include "library/simulation.h"
#include "render/png.h"
