#include "exports/page/page_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "analysis/frame_analysis.h"
#include "analysis/packing/packing.h"
#include "base/errors.h"
#include "core/trigonometry.h"
#include "pictures/motion.h"
#include "runs/analysis_input.h"
#include "runs/analysis_parameters.h"

namespace talus::exports {
namespace {

/// Sets the angle that scales maps: the angle of repose, or the angle of the threshold that was given
/// instead.
void take_angle(pictures::MapSettings& settings, const analysis::Analysis& analysis) {
  if (std::isfinite(analysis.theta_c)) {
    settings.theta_c = analysis.theta_c;
  } else if (std::isfinite(analysis.gamma_c) && analysis.gamma_c < 1.0) {
    settings.theta_c = std::asin(analysis.gamma_c);
  } else {
    settings.theta_c = radians(pictures::assumed_theta_c);
    settings.theta_c_assumed = true;
  }
}

pictures::MapSettings settings_of(const analysis::Analysis& analysis,
                                  const analysis::AnalysisParameters& parameters) {
  pictures::MapSettings settings;
  take_angle(settings, analysis);
  // With an explicit Gamma_c, the first threshold is another multiple of sin(theta_c).
  if (!analysis.thresholds.empty())
    settings.threshold_factor = std::isfinite(analysis.theta_c) && parameters.gamma_c
                                    ? analysis.thresholds.front().gamma / sine(settings.theta_c)
                                    : analysis.thresholds.front().factor;
  settings.l_min = parameters.l_min;
  settings.joined_by_neighbours = parameters.joining == analysis::Joining::neighbours;
  return settings;
}

Frame seen_frame(const PageRun& run, std::size_t k) {
  // Moments are averaged only over frames of the tilt.
  return k < run.file.frame_count()
             ? runs::analysed_frame(run.file, run.parameters, k)
             : analysis::with_analysed_gamma(run.file.frame(k), run.statics(), run.parameters);
}

std::vector<float> lengths_of(const PageRun& run, const BedFrame& bed, std::size_t k) {
  if (!run.has_threshold()) return {};
  if (k < run.analysis.frames.size()) return run.analysis.frames[k].thresholds.front().lc;
  return analysis::analyse_thresholds(bed, run.parameters, run.analysis, analysis::frame_volume(bed))
      .front()
      .lc;
}

bool is_on_page(const PageRun& run, std::size_t k) { return std::ranges::binary_search(run.frames, k); }

}  // namespace

bool PageRun::shows(pictures::MapKind kind) const {
  if (kind == pictures::MapKind::overloaded || kind == pictures::MapKind::clusters) return has_threshold();
  return kind != pictures::MapKind::coarse || settings.length * statics().mean_diameter <= statics().length;
}

PageRun begin_page(const io::RunFile& file, const analysis::Analysis& analysis,
                   std::vector<std::size_t> frames) {
  if (file.has_program() || !std::ranges::is_sorted(file.frame_tilts()))
    throw Error(
        ExitCode::bad_data,
        fmt::format("the tilt of this run {}, but a page shows runs whose tilt does not fall; open it "
                    "with talus view, or export it to another format",
                    file.has_program() ? "follows a programme (tilt.program)"
                                       : "was turned by a command (tilt_rate)"));
  const analysis::AnalysisParameters parameters = runs::from_facts(analysis.parameters);
  PageRun run{file, analysis, std::move(frames), parameters, settings_of(analysis, parameters), {}};
  run.extent = pictures::bed_extent(run.statics());
  pictures::MotionSample sample({pictures::MapKind::displacement, pictures::MapKind::rotation});
  Frame before;
  for (std::size_t k = 0; k < file.all_frame_tilts().size(); ++k) {
    Frame frame = file.frame(k);
    const BedFrame bed{frame, run.statics()};
    pictures::extend(run.extent, bed);
    if (k > 0 && is_on_page(run, k)) sample.add({bed, &before, true});
    before = std::move(frame);
  }
  run.settings.motion = sample.ranges();
  return run;
}

pictures::MapFrame PageFrame::mapped(const PageRun& run) const {
  return {{frame, run.statics()}, reference, true, colours, nullptr, {}};
}

void for_each_frame(const PageRun& run, const Watch& watch,
                    const std::function<void(const PageFrame&)>& use) {
  pictures::ClusterColours tracker;
  Frame before;
  std::size_t column = 0;
  for (std::size_t k = 0; column < run.frames.size(); ++k) {
    if (watch.stopped && watch.stopped())
      throw Error(ExitCode::stopped, "stopped before the page was complete; repeat the command");
    Frame frame = seen_frame(run, k);
    const BedFrame bed{frame, run.statics()};
    analysis::Clusters clusters =
        run.has_threshold() ? pictures::overloaded_clusters(bed, run.settings) : analysis::Clusters();
    std::vector<pictures::ClusterColour> colours = tracker.next(clusters);
    if (run.frames[column] == k) {
      use({column, frame, k > 0 ? &before : nullptr, std::move(clusters), std::move(colours),
           lengths_of(run, bed, k)});
      ++column;
      if (watch.progress) watch.progress(column, run.frames.size());
    }
    before = std::move(frame);
  }
}

}  // namespace talus::exports
