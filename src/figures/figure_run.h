#pragma once
/// A run as figures know it: opened and analysed, or told by the values that an ensemble has kept of it.

#include <optional>
#include <string>
#include <vector>

#include "analysis/last_rise.h"
#include "analysis/record.h"
#include "ensemble/averages.h"
#include "io/run_file.h"
#include "scenario/scenario.h"

namespace talus {

struct FigureRun {
  std::string path;             ///< its own, or "FOLDER/ensemble.h5#seed-7" of the values of a member
  std::optional<RunFile> file;  ///< frames and observables; nothing where there are only values
  Analysis analysis;
  Scenario scenario;
  std::string scenario_text;   ///< with every key, as the run has it
  std::string state_hash;      ///< of its last state
  double mean_diameter = 0.0;  ///< D, m
  double theta_r = not_known;  ///< angle at rest after failure, rad
};

/// Of a run file. Throws Error(bad_data) where its scenario cannot be read.
FigureRun run_of_file(const std::string& path, RunFile file, Analysis analysis);

/// Of the values of a member. Throws Error(bad_data) where the scenario cannot be read.
FigureRun run_of_values(const std::string& path, const MemberResult& member,
                        const std::string& scenario_text);

/// The last rise of a run, all of it where its tilt does not fall.
inline FramesOfRise last_rise_of(const FigureRun& run) { return last_rise(run.analysis.frames); }

}  // namespace talus
