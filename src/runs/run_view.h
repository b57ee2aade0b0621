#pragma once
/// Runs looks at runs that exist. A RunView is an opened file with its scenario and its analysis, which is
/// computed (analysis_run.h) if it is not stored; or the values that an ensemble has stored of it. Read next:
/// analysis_parameters.h, event_catalogue.h.

#include <algorithm>
#include <optional>
#include <string>
#include <thread>

#include "analysis/record.h"
#include "core/types.h"
#include "io/run_file.h"
#include "scenario/scenario.h"

namespace talus::runs {

/// A run with its scenario and analysis.
struct RunView {
  std::string path;  ///< path of the file, or "FOLDER/ensemble.h5#seed-7" for the values of a member
  std::optional<io::RunFile> file;  ///< frames and observables; empty if only values exist
  RunStatics statics;               ///< for values alone only mean_diameter is set
  analysis::Analysis analysis;
  scenario::Scenario scenario;
  std::string scenario_text;   ///< resolved text with all keys
  std::string state_hash;      ///< hash of its last state
  double theta_r = not_known;  ///< angle at rest after failure, rad
  std::string kept;            ///< "analysis read from the file", "analysis not stored: ..."
  bool is_kept = false;        ///< whether the file contains the analysis
};

/// Returns the scenario of a stored run from its header; `name` is its name in messages. Throws as
/// parse_scenario does.
scenario::Scenario stored_scenario(const io::RunHeader& header, const std::string& name);

/// Returns the version of Talus that computed a run, with its git hash, from its provenance: "0.1.0 (abc)".
std::string version_of(const Facts& provenance);

/// Returns the view of a run file. Throws Error(bad_data) if its scenario cannot be read.
RunView view_of_run(const std::string& path, io::RunFile file, analysis::Analysis analysis);

/// Options for computing and storing an analysis.
struct AnalysisOptions {
  int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 2u));
  bool force = false;       ///< recompute a stored, valid analysis
  CountDone progress = {};  ///< number of completed frames
};

/// Returns a run with its analysis, which is read from the file if it is stored and valid, and otherwise
/// computed and stored. The analysis is not stored if the run is incomplete or write-protected, or if its
/// folder is. Throws as RunFile::open, view_of_run, analyse_run and store_analysis do.
RunView analysed_run(const std::string& path, const analysis::AnalysisParameters& parameters,
                     const AnalysisOptions& options);

}  // namespace talus::runs
