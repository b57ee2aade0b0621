#pragma once
/// A run with its analysis, read from the file where it is stored and valid, else computed and stored.

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "core/snapshot.h"

namespace talus {

/// What a report needs beside the analysis.
struct AnalysedRun {
  std::string path;
  std::string state;     ///< "stored", "read from the file", "not stored: ..."
  bool is_kept = false;  ///< the file holds the analysis
  RunStatics statics;
  Analysis analysis;
};

struct AnalysisOptions {
  int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 2u));
  bool force = false;  ///< compute again what is stored and valid
  bool quiet = false;  ///< show no progress
};

/// Analyses a run, with its progress on stderr. A run that is not complete is analysed, not stored; nor is
/// one that is write-protected, or in a folder that may not be written. Throws as RunFile::open, analyse_run
/// and store_analysis do.
AnalysedRun analysed_run(const std::string& path, const AnalysisParameters& parameters,
                         const AnalysisOptions& options);

}  // namespace talus
