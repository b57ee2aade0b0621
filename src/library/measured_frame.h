#pragma once
/// A frame of a live run or of a file whose quantities are measured and drawn by name.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "core/bed_frame.h"
#include "core/observables.h"
#include "core/snapshot.h"
#include "pictures/map_options.h"
#include "render/image.h"

namespace talus {

/// Input of the measurements.
struct FrameInput {
  Frame frame;
  RunStatics statics;  ///< data of the grains of the frame
  analysis::AnalysisParameters parameters{};
  std::optional<double> theta_c{};     ///< rad; empty if the slope has not failed
  std::optional<Frame> begin{};        ///< frame at the start of the tilt, the reference of displacements
  std::optional<ObservableRow> row{};  ///< observables at the same time, or the last ones before it
};

/// Measures a frame on demand. Names are those of the tables of quantities; any other name throws
/// Error(usage) with a suggestion.
class MeasuredFrame {
 public:
  explicit MeasuredFrame(FrameInput input) : input_(std::move(input)) {}

  const FrameInput& input() const { return input_; }
  BedFrame bed() const { return {input_.frame, input_.statics}; }

  /// Returns a quantity of the frame or an observable, in SI units: "overloaded/fraction", "lc/mean[1]" at
  /// the second threshold, "kinetic_energy". If the slope has not failed and no gamma_c is given, Gamma_c is
  /// that of assumed_theta_c.
  double quantity(std::string_view name);
  /// Return a quantity of grains or of contacts, row by row, in SI units, at the first threshold.
  std::vector<double> grain_values(std::string_view name);
  std::vector<double> contact_values(std::string_view name) const;

  /// Draws a map by name as `talus render --map` does. Unless it is given, theta_c is that of the run or the
  /// assumed one. Throws Error(usage) and Error(unavailable).
  render::Image draw(const std::string& map, pictures::MapOptions options) const;

 private:
  const Frame& judged();  ///< the frame with the gamma of neighbourhoods
  const analysis::FrameRecord& record();
  double theta_c() const;

  FrameInput input_;
  std::optional<Frame> judged_{};
  std::optional<analysis::FrameRecord> record_{};
  std::vector<double> factors_{};
};

/// Returns frame k of a run file, measured with these parameters of the analysis ("l_min=0"). Throws as
/// RunFile::open does, and Error(usage) if the frame does not exist.
MeasuredFrame measured_frame(const std::string& path, std::size_t k,
                             const std::vector<std::string>& settings = {});

}  // namespace talus
