#pragma once
/// A frame that is measured and drawn by names: of a live run, or of a file.

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

/// What is measured, and by what it is judged.
struct FrameInput {
  Frame frame;
  RunStatics statics;  ///< of the grains of the frame
  analysis::AnalysisParameters parameters{};
  std::optional<double> theta_c{};     ///< rad; nothing while the slope has not failed
  std::optional<Frame> begin{};        ///< as the tilt began, from which motions are measured
  std::optional<ObservableRow> row{};  ///< of the same moment, or the last one before it
};

/// Values are made when they are first asked for. Names are those of the tables of quantities: Error(usage),
/// with what may have been meant, for any other.
class MeasuredFrame {
 public:
  explicit MeasuredFrame(FrameInput input) : input_(std::move(input)) {}

  const FrameInput& input() const { return input_; }
  BedFrame bed() const { return {input_.frame, input_.statics}; }

  /// A number of a frame or an observable, in SI units: "overloaded/fraction", "lc/mean[1]" at the second
  /// threshold, "kinetic_energy". While the slope has not failed and no gamma_c is given, Gamma_c is that of
  /// assumed_theta_c.
  double quantity(std::string_view name);
  /// A quantity of grains or of contacts, row by row, in SI units, at the first threshold.
  std::vector<double> grain_values(std::string_view name);
  std::vector<double> contact_values(std::string_view name) const;

  /// A map by its name, as `talus render --map` draws it; theta_c is that of the run or the assumed one
  /// unless it is given. Throws Error(usage), Error(unavailable).
  render::Image draw(const std::string& map, pictures::MapOptions options) const;

 private:
  const Frame& judged();  ///< with the gamma of neighbourhoods
  const analysis::FrameRecord& record();
  double theta_c() const;

  FrameInput input_;
  std::optional<Frame> judged_{};
  std::optional<analysis::FrameRecord> record_{};
  std::vector<double> factors_{};
};

/// Frame k of a run file, measured with these parameters ("l_min=0"). Throws as RunFile::open, and
/// Error(usage) where there is no such frame.
MeasuredFrame measured_frame(const std::string& path, std::size_t k,
                             const std::vector<std::string>& settings = {});

}  // namespace talus
