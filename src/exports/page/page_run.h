#pragma once
/// What all frames of a page have in common, and the frames themselves, one after the other.

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
  const analysis::Analysis& analysis;       ///< of the same run
  std::vector<std::size_t> frames;          ///< which are on the page: numbers in the run, ascending
  analysis::AnalysisParameters parameters;  ///< those of the analysis
  pictures::MapSettings
      settings;  ///< of all maps, whose layers are empty; theta_c is assumed where it is not known
  pictures::MapExtent extent;  ///< of all frames of the run, as in its pictures

  const RunStatics& statics() const { return file.header().statics; }
  /// Whether there are overloaded grains: an analysis without threshold has none.
  bool has_threshold() const { return !analysis.thresholds.empty(); }
  /// Whether a page of this run has the map: a bed can be shorter than its neighbourhoods, and have no
  /// threshold.
  bool shows(pictures::MapKind kind) const;
};

/// Reads the frames once: for the extent, and for ranges that fit how grains have moved in those on the page.
/// Throws as RunFile::frame does.
PageRun begin_page(const io::RunFile& file, const analysis::Analysis& analysis,
                   std::vector<std::size_t> frames);

/// A frame on the page.
struct PageFrame {
  std::size_t column;           ///< on the page, counted from 0
  const Frame& frame;           ///< as its analysis sees it
  const Frame* reference;       ///< the frame of the run before it, null for the first
  analysis::Clusters clusters;  ///< of its overloaded grains; empty where there is no threshold
  std::vector<pictures::ClusterColour>
      colours;            ///< of the clusters, which keep them over all frames of the run
  std::vector<float> lc;  ///< m, of each grain; empty where there is no threshold

  /// What maps are made from.
  pictures::MapFrame mapped(const PageRun& run) const;
};

/// Calls `use` with each frame of the page, in their order. Throws Error(stopped) where it was stopped, and
/// as RunFile::frame does.
void for_each_frame(const PageRun& run, const Watch& watch, const std::function<void(const PageFrame&)>& use);

}  // namespace talus::exports
