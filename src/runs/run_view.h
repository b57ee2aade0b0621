#pragma once
/// A run that is there to be looked at: opened, with its scenario and its analysis; or told by the values
/// that an ensemble has kept of it.

#include <algorithm>
#include <optional>
#include <string>
#include <thread>

#include "analysis/failure/last_rise.h"
#include "analysis/parameters.h"
#include "analysis/record.h"
#include "core/watch.h"
#include "io/run_file.h"
#include "scenario/scenario.h"

namespace talus::runs {

struct RunView {
  std::string path;                 ///< its own, or "FOLDER/ensemble.h5#seed-7" of the values of a member
  std::optional<io::RunFile> file;  ///< frames and observables; nothing where there are only values
  RunStatics statics;               ///< of values: mean_diameter alone
  analysis::Analysis analysis;
  scenario::Scenario scenario;
  std::string scenario_text;   ///< with every key, as the run has it
  std::string state_hash;      ///< of its last state
  double theta_r = not_known;  ///< angle at rest after failure, rad
  std::string kept;            ///< "analysis read from the file", "analysis not stored: ..."
  bool is_kept = false;        ///< the file holds the analysis
};

/// The scenario of a stored run, from its header; `name` is what messages call it. Throws as parse_scenario
/// does.
scenario::Scenario stored_scenario(const io::RunHeader& header, const std::string& name);

/// The version that computed a run, with its git hash, from its provenance: "0.1.0 (abc)".
std::string version_of(const Facts& provenance);

/// Of a run file. Throws Error(bad_data) where its scenario cannot be read.
RunView view_of_run(const std::string& path, io::RunFile file, analysis::Analysis analysis);

struct AnalysisOptions {
  int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 2u));
  bool force = false;       ///< compute again what is stored and valid
  CountDone progress = {};  ///< frames that are done
};

/// A run with its analysis, read from the file where it is stored and valid, else computed and stored. A run
/// that is not complete is analysed, not stored; nor is one that is write-protected, or in a folder that may
/// not be written. Throws as RunFile::open, view_of_run, analyse_run and store_analysis do.
RunView analysed_run(const std::string& path, const analysis::AnalysisParameters& parameters,
                     const AnalysisOptions& options);

/// The last rise of a run, all of it where its tilt does not fall.
inline analysis::FramesOfRise last_rise_of(const RunView& run) {
  return analysis::last_rise(run.analysis.frames);
}

}  // namespace talus::runs
