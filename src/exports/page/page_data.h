#pragma once
/// The contents of a page, collected frame by frame, as JSON and as tables.

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/record.h"
#include "core/trigonometry.h"
#include "core/types.h"
#include "exports/page/tables.h"
#include "io/run_file.h"
#include "pictures/layers.h"
#include "pictures/maps.h"

namespace talus::exports {

using Json = nlohmann::ordered_json;

/// The run of a page: the properties that its frames share.
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
  /// Returns a moment on the axis of the page: its tilt, deg, or, if the run goes by time, its time, s.
  double place(double tilt, double time) const {
    return file.goes_by_time() ? time - file.all_frame_times().front() : degrees(tilt);
  }
  double place(std::size_t k) const { return place(file.all_frame_tilts()[k], file.all_frame_times()[k]); }
  /// Whether a page of this run has the map. Some maps need a threshold, or a larger bed.
  bool shows(pictures::MapKind kind) const;
};

/// Reads the frames once to find the extent, and the ranges of motion that fit the frames on the page. Throws
/// the errors of RunFile::frame.
PageRun begin_page(const io::RunFile& file, const analysis::Analysis& analysis,
                   std::vector<std::size_t> frames);

/// Receives a frame of the page as its analysis sees it, with the preceding one of the run; the frames of the
/// run so far; and, empty without a threshold, the clusters of its overloaded grains and l_c of each grain,
/// m.
using UseFrame = std::function<void(const analysis::GrainSource& frame, const pictures::SeenFrames& seen,
                                    const analysis::Clusters& clusters, const std::vector<float>& lc)>;

/// Calls `use` with each frame of the page, in order. Throws Error(stopped), and as RunFile::frame.
void for_each_frame(const PageRun& run, const Watch& watch, const UseFrame& use);

/// Returns a number with as many digits as its format ("{:.5g}") prints; null if it is not finite.
Json rounded(double value, const char* format);
Json rounded(const std::vector<double>& values, const char* format);

/// Entries of frames, most of which are equal; each distinct entry is stored once.
struct DistinctEntries {
  Json kinds = Json::array(), of = Json::array();  ///< the entries, and the index of each frame's entry

  void add(const Json& entry);
  Json json() const { return {{"kinds", kinds}, {"of", of}}; }
};

/// A scalar of each grain in each frame.
struct GrainField {
  std::string name;   ///< for example "gamma": name in the page, and of the map that shows it
  std::string label;  ///< rich text, for example "γ, l = 3 D"
  std::string unit;   ///< rich text, empty for a dimensionless number
  int digits = 3;     ///< significant digits shown
  Quantum quantum;
  CodeTable codes;

  void set(std::size_t grain, std::size_t column, double value) {
    codes.at(grain, column) = code_of(quantum, value);
  }
};

/// One map over all frames: its texts and colours, identical to the pictures of `talus render`.
struct PageMap {
  pictures::MapKind kind;
  DistinctEntries titles, legends, scales, looks;  ///< scales if grains are coloured by a value, else looks
  Json ramp;                                       ///< fills and rims from end to end of a scale
};

/// Lines between grains or at contacts: titles, and legends for each colour (over a map or outlines).
struct PageLines {
  pictures::MapKind kind;
  DistinctEntries titles;
  Json legends;
};

/// Returns the maps that fill grains, in the order in which they are listed to users.
std::vector<pictures::MapKind> filling_maps(const PageRun& run);

/// Collects the frames of a page.
class PageData {
 public:
  explicit PageData(const PageRun& run);
  /// Adds the next frame; see UseFrame.
  void add(const analysis::GrainSource& frame, const pictures::SeenFrames& seen,
           const analysis::Clusters& clusters, const std::vector<float>& lc);
  /// Returns all data of the page except its tables.
  Json json() const;
  /// Returns the tables and their names.
  std::vector<std::pair<std::string, CodeTable>> tables() const;

 private:
  /// A contact in a frame.
  struct Touch {
    std::size_t column = 0;
    std::uint32_t force = 0, sliding = 0;
  };
  using Pair = std::tuple<Index, Index, std::int8_t>;  ///< a, b and shift

  void add_map(PageMap& map, const analysis::GrainSource& frame, const pictures::SeenFrames& seen,
               const analysis::Clusters& clusters);
  void add_contacts(const Frame& frame);
  std::size_t column() const { return captions_.size(); }  ///< index of the frame that is added
  void add_lengths(const analysis::Clusters& clusters, const std::vector<float>& lc);
  GrainField& field(std::string_view name);

  const PageRun& run_;
  Quantum x_places_, y_places_, radius_places_;
  CodeTable x_, y_;  ///< positions of all grains, floor included
  std::vector<GrainField> fields_;
  std::vector<PageMap> maps_;
  std::vector<PageLines> lines_;
  std::vector<pictures::OverColour> over_;  ///< colours of lines: over outlines, and over the maps
  Json captions_ = Json::array();
  std::map<Pair, std::vector<Touch>> touches_;
  std::map<Index, std::array<double, 2>> planes_;  ///< planes that grains touch, and the normal towards them
};

/// Returns {"rows": places of the observables (PageRun::place); "tilts": their tilts, deg; "frames": the
/// places of all frames of the tilt; "quantities": all known scalar quantities of a frame, in the order of
/// the table, each with its title, definition and curves: one, or one for each threshold}. The curve of a
/// quantity that the run also records uses the recorded values.
Json curves_json(const PageRun& run);

/// Returns the events of the time line (view/timeline.h) between the frames of the page, with positions.
Json events_json(const PageRun& run);

/// Return the sources of a page, assets/page, which are embedded in the binary: the document, with {{name}}
/// as placeholders; its style; and all scripts in sequence, in one function that keeps their names local.
std::string_view page_template();
std::string_view page_style();
std::string page_script();

}  // namespace talus::exports
