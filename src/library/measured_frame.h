#pragma once
/// A frame of a live run or of a file whose quantities are measured and drawn by name.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/record.h"
#include "core/observables.h"
#include "core/snapshot.h"
#include "pictures/map_options.h"
#include "render/image.h"

namespace talus::analysis {
struct FrameQuantity;
}
namespace talus::render {
struct FrameView;
}

namespace talus {

/// Measures a frame on demand. `Error(bad_data)` is thrown at once if a parameter of the analysis is
/// impossible. A name of a quantity may end with its threshold: "cluster[1]" and "cluster_2" are at the
/// second threshold, 2 Gamma_c, and "cluster" is at the first. Names are those of the tables of quantities;
/// any other name throws Error(usage) with a suggestion.
class MeasuredFrame {
 public:
  /// `statics` has the data of the grains of the frame; `theta_c` is empty if the slope has not failed;
  /// `begin` is the frame at the start of the tilt, the reference of displacements; `row` has the observables
  /// at the same time, or the last ones before it.
  MeasuredFrame(Frame frame, RunStatics statics, analysis::AnalysisParameters parameters = {},
                std::optional<double> theta_c = {}, std::optional<Frame> begin = {},
                std::optional<ObservableRow> row = {});

  BedFrame bed() const { return {frame_, statics_}; }

  /// Returns a quantity of the frame or an observable, in SI units: "overloaded/fraction", "lc/mean[1]" at
  /// the second threshold, "kinetic_energy"; "tilt" in deg. If the slope has not failed and no gamma_c is
  /// given, Gamma_c is that of assumed_theta_c.
  double quantity(std::string_view name);
  /// Return a quantity of grains or of contacts, row by row, in SI units.
  std::vector<double> grain_values(std::string_view name);
  std::vector<double> contact_values(std::string_view name) const;

  /// Return all names of quantities of the frame, of grains and of contacts.
  std::vector<std::string> quantities() const;
  std::vector<std::string> grain_quantities() const;
  std::vector<std::string> contact_quantities() const;
  /// Return the row of a quantity (analysis/frame_quantities.h), with its components and its type.
  analysis::FrameQuantity grain_quantity(std::string_view name) const;
  analysis::FrameQuantity contact_quantity(std::string_view name) const;

  /// Draws a map as `talus render --map` does, or one of own values, on a scale that fits those of the frame.
  /// Unless it is given, theta_c is that of the run or the assumed one. Throws Error(usage) if an option is
  /// out of the range that it has on the command line, or has no effect here, and Error(unavailable).
  render::Image draw(const pictures::MapChoice& what, const pictures::MapOptions& options) const;
  /// Returns that map before it is drawn, for panels and movies.
  render::FrameView map(const pictures::MapChoice& what, const pictures::MapOptions& options) const;

 private:
  const Frame& judged();  ///< the frame with the gamma of neighbourhoods
  const analysis::FrameRecord& record();
  double theta_c() const;

  Frame frame_;
  RunStatics statics_;
  analysis::AnalysisParameters parameters_;
  std::optional<double> theta_c_;  ///< rad
  std::optional<Frame> begin_;
  std::optional<ObservableRow> row_;
  std::optional<Frame> judged_{};
  std::optional<analysis::FrameRecord> record_{};
};

/// Returns frame k of a run file, measured with these parameters of the analysis ("l_min=0"). Throws as
/// RunFile::open does, and Error(usage) if the frame does not exist.
MeasuredFrame measured_frame(const std::string& path, std::size_t k,
                             const std::vector<std::string>& settings = {});

/// Returns what was done to a run file that its scenario does not say (session::departures). Throws as
/// RunFile::open does.
std::vector<std::string> departures(const std::string& path);

}  // namespace talus
