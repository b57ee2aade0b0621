#pragma once
/// Library is Talus for other programs, in C++ and Python. A Simulation is a run that the program steps and
/// steers; a MeasuredFrame measures and draws one of its states, or a frame of a file. This header includes
/// all of it; docs/library.md shows how to use it.

#include "base/errors.h"
#include "base/version.h"
#include "library/measured_frame.h"
#include "library/simulation.h"
#include "render/png.h"
#include "scenario/scenario.h"

namespace talus {

using analysis::AnalysisParameters;
using analysis::FrameRecord;
using pictures::MapOptions;
using render::encode_png;
using render::Image;
using render::write_png;
using scenario::parse_scenario;
using scenario::read_scenario;
using scenario::resolved_toml;
using scenario::Scenario;
using session::Phase;

}  // namespace talus
