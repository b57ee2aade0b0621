#pragma once
/// The frames of a page, one after the other, and the properties that they share.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "core/watch.h"
#include "io/run_file.h"
#include "pictures/maps.h"

namespace talus::exports {

struct PageRun {
  const io::RunFile& file;
  const analysis::Analysis& analysis;       ///< analysis of the same run
  std::vector<std::size_t> frames;          ///< frames on the page: indices in the run, ascending
  analysis::AnalysisParameters parameters;  ///< parameters of the analysis
  pictures::MapSettings settings;  ///< settings of all maps, with empty layers; theta_c is assumed if unknown
  pictures::MapExtent extent;      ///< extent of all frames of the run, as in its pictures

  const RunStatics& statics() const { return file.header().statics; }
  /// Whether overloaded grains are defined; an analysis without threshold has none.
  bool has_threshold() const { return !analysis.thresholds.empty(); }
  /// Whether a page of this run has the map. Some maps need a threshold, or a bed that is larger than its
  /// neighbourhoods.
  bool shows(pictures::MapKind kind) const;
};

/// Reads the frames once to find the extent, and the ranges of motion that fit the frames on the page. Throws
/// the errors of RunFile::frame.
PageRun begin_page(const io::RunFile& file, const analysis::Analysis& analysis,
                   std::vector<std::size_t> frames);

/// A frame on the page.
struct PageFrame {
  std::size_t column;           ///< index on the page, from 0
  const Frame& frame;           ///< frame as its analysis sees it
  const Frame* reference;       ///< preceding frame of the run, null for the first
  analysis::Clusters clusters;  ///< clusters of its overloaded grains; empty without a threshold
  std::vector<pictures::ClusterColour>
      colours;            ///< colours of the clusters, consistent over all frames of the run
  std::vector<float> lc;  ///< m, for each grain; empty without a threshold

  /// Returns the input of the maps.
  pictures::MapFrame mapped(const PageRun& run) const;
};

/// Calls `use` with each frame of the page, in order. Throws Error(stopped) if it was stopped, and the errors
/// of RunFile::frame.
void for_each_frame(const PageRun& run, const Watch& watch, const std::function<void(const PageFrame&)>& use);

}  // namespace talus::exports
