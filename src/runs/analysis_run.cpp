#include "runs/analysis_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <future>
#include <mutex>
#include <utility>

#include "analysis/deformation/deformation.h"
#include "analysis/failure/failure_distance.h"
#include "analysis/failure/transition.h"
#include "analysis/frame_analysis.h"
#include "analysis/free_grains.h"
#include "analysis/topology/topology.h"
#include "base/errors.h"
#include "base/hash.h"
#include "core/tensor.h"
#include "core/trigonometry.h"
#include "io/run_schema.h"
#include "runs/analysis_parameters.h"
#include "runs/event_catalogue.h"
#include "stress/stress.h"

namespace talus::runs {
namespace {

/// Returns the data of a frame that the comparison with the next frame needs.
Frame places_of(const Frame& frame) {
  Frame places;
  places.x = frame.x;
  places.y = frame.y;
  places.image = frame.image;
  return places;
}

/// Analyses all frames. They are read one at a time in order, because HDF5 is not thread-safe.
void analyse_frames(const io::RunFile& run, const analysis::AnalysisParameters& parameters, int threads,
                    const AnalysisProgress& progress, analysis::Analysis& analysis) {
  analysis.frames.resize(run.frame_count());
  std::vector<analysis::PersistenceDiagram> networks(run.frame_count());
  std::mutex reading;
  std::size_t next = 0, done = 0;
  Frame last;  ///< positions in the preceding frame
  const auto work = [&] {
    for (;;) {
      std::unique_lock lock(reading);
      if (next == run.frame_count()) return;
      const std::size_t k = next++;
      const Frame frame = analysed_frame(run, parameters, k);
      const Frame before = std::exchange(last, places_of(frame));
      lock.unlock();
      const BedFrame bed = {frame, run.header().statics};
      analysis::FrameRecord& record = analysis.frames[k];
      record = analysis::analyse_frame(bed, parameters, analysis);
      networks[k] = analysis::force_persistence(bed, record.mean_normal_force);
      analysis::measure_topology(networks[k], bed.statics.free_count, analysis.network_threshold, record);
      if (k > 0) analysis::measure_deformation(before, bed, record);
      lock.lock();
      ++done;
      if (progress) progress(done);
    }
  };
  std::vector<std::future<void>> others;
  for (int t = 1; t < threads; ++t) others.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& other : others) other.get();
  analysis::measure_network_changes(networks, run.header().statics.free_count, analysis.frames);
}

/// Copies the observables of the run into the frames, for each frame from the last row at or before its time.
/// Tilts cannot be compared because a command may hold the tilt.
void take_observables(const io::RunFile& run, const std::vector<ObservableRow>& rows,
                      analysis::Analysis& analysis) {
  const std::vector<double>& times = run.all_frame_times();
  for (std::size_t k = 0; k < analysis.frames.size(); ++k) {
    analysis::FrameRecord& frame = analysis.frames[k];
    const auto after = std::ranges::upper_bound(
        rows, times[k], {}, [](const ObservableRow& row) { return at(row, Observable::time); });
    if (after == rows.begin()) continue;
    const ObservableRow& row = *std::prev(after);
    frame.volume_strain = at(row, Observable::volume_strain);
    frame.centre_of_mass_strain = at(row, Observable::centre_of_mass_strain);
    frame.solid_fraction = at(row, Observable::solid_fraction);
  }
}

std::vector<double> column(const std::vector<ObservableRow>& rows, Observable field) {
  std::vector<double> values;
  for (const ObservableRow& row : rows) values.push_back(at(row, field));
  return values;
}

void find_dilation(const std::vector<ObservableRow>& rows, analysis::Analysis& analysis) {
  const std::vector<double> tilts = column(rows, Observable::tilt);
  const Observable strains[] = {Observable::volume_strain, Observable::centre_of_mass_strain};
  for (std::size_t s = 0; s < std::size(strains); ++s) {
    const analysis::DilationOnset onset = analysis::dilation_onset(
        tilts, column(rows, strains[s]), analysis.theta_c, radians(analysis::dilation_window));
    analysis.dilation[s] = onset.tilt;
    analysis.dilation_low[s] = onset.low;
    analysis.dilation_high[s] = onset.high;
  }
}

void find_failure_ratio(const std::vector<ObservableRow>& rows, analysis::Analysis& analysis) {
  const Statistics ratio =
      analysis::failure_ratio(column(rows, Observable::tilt), column(rows, Observable::sigma_t_over_n),
                              analysis.theta_c, radians(analysis::failure_window));
  analysis.failure_ratio = ratio.mean;
  analysis.failure_ratio_spread = ratio.deviation;
}

void find_transitions(analysis::Analysis& analysis) {
  const auto [first, frames, tilts, mirrored_slope] = analysis::last_rise(analysis.frames);
  for (std::size_t f = 0; f < analysis.thresholds.size(); ++f) {
    std::vector<double> lengths;
    std::vector<Index> spans;
    for (const analysis::FrameRecord* frame : frames) {
      lengths.push_back(frame->thresholds[f].lc_max);
      spans.push_back(frame->thresholds[f].spans_depth);
    }
    analysis::RunThreshold& threshold = analysis.thresholds[f];
    const analysis::LengthJump jump =
        analysis::length_jump(tilts, lengths, analysis.theta_c, analysis.lc_cut);
    threshold.lc_jump = jump.tilt;
    threshold.lc_jump_error = jump.error;
    threshold.lc_jump_size = jump.size;
    const analysis::PercolationOnset onset = analysis::percolation_onset(tilts, spans, analysis.theta_c);
    threshold.percolation = onset.tilt;
    threshold.percolation_error = onset.error;
  }
}

void find_growth(analysis::Analysis& analysis) {
  const auto [first, frames, tilts, mirrored_slope] = analysis::last_rise(analysis.frames);
  std::vector<double> means, weighted_means;
  for (const analysis::FrameRecord* frame : frames) {
    means.push_back(frame->critical_mean);
    weighted_means.push_back(frame->critical_weighted_mean);
  }
  const std::vector<double>* const sizes[] = {&means, &weighted_means};
  for (std::size_t s = 0; s < std::size(sizes); ++s) {
    const analysis::GrowthExponent growth =
        analysis::growth_exponent(tilts, *sizes[s], analysis.theta_c, radians(analysis::growth_window));
    analysis.critical_exponent[s] = growth.exponent;
    analysis.critical_exponent_error[s] = growth.error;
  }
}

}  // namespace

std::string analysis_key(const io::RunFile& run, const analysis::AnalysisParameters& parameters) {
  std::string text =
      fmt::format("{}\n{}\n", hash_text(state_hash(run.checkpoint().world)), io::analysis_version);
  for (const auto& [name, value] : as_facts(parameters)) text += fmt::format("{}={}\n", name, value);
  return text_hash(text);
}

analysis::Analysis analyse_run(const io::RunFile& run, const analysis::AnalysisParameters& parameters,
                               int threads, const AnalysisProgress& progress) {
  if (run.frame_count() == 0)
    throw Error(ExitCode::bad_data,
                "the run has no frames: its bed has not been tilted yet; let the run continue");
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  const RunStatics& statics = run.header().statics;
  analysis::Analysis analysis = analysis::begin_analysis(statics, parameters, theta_c);
  analysis.parameters = as_facts(parameters);
  analysis.key = analysis_key(run, parameters);
  analyse_frames(run, parameters, threads, progress, analysis);
  std::vector<ObservableRow> rows = run.observables();
  take_observables(run, rows, analysis);
  find_events(run, rows, parameters, analysis);
  rows = analysis::rows_of_last_rise(rows);
  find_dilation(rows, analysis);
  find_failure_ratio(rows, analysis);
  find_transitions(analysis);
  find_growth(analysis);
  analysis.first_slide = analysis::first_slide(
      column(rows, Observable::tilt), column(rows, Observable::surface_displacement),
      analysis::slide_distance * statics.mean_diameter, radians(analysis::slide_window));
  return analysis;
}

namespace {

/// Tolerance for the tilts of frames in a window; a tilt is a multiple of a step up to rounding.
constexpr double rounding = 1e-9;  // rad

void average_moments(const io::RunFile& run, double half_window, std::size_t k, Frame& frame) {
  const std::vector<double>& tilts = run.frame_tilts();
  const auto is_near = [&](std::size_t other) {
    return std::fabs(tilts[other] - tilts[k]) <= half_window + rounding;
  };
  std::size_t first = k, last = k;
  while (first > 0 && is_near(first - 1)) --first;
  while (last + 1 < tilts.size() && is_near(last + 1)) ++last;
  if (first == last) return;
  std::vector<Tensor2> sums(frame.internal_moment.size());
  for (std::size_t other = first; other <= last; ++other) {
    const std::vector<Tensor2> moments =
        other == k ? frame.internal_moment : run.frame(other).internal_moment;
    for (std::size_t i = 0; i < sums.size(); ++i) analysis::add_to(sums[i], moments[i]);
  }
  const double share = 1.0 / static_cast<double>(last - first + 1);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    frame.internal_moment[i] = tensor(share * matrix(sums[i]));
    frame.gamma[i] = stress::stress_state(frame.internal_moment[i]).ratio;
  }
}

}  // namespace

Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k,
                     Frame frame) {
  if (parameters.averaging > 0.0 && k < run.frame_count())
    average_moments(run, 0.5 * radians(parameters.averaging), k, frame);
  return analysis::with_analysed_gamma(std::move(frame), run.header().statics, parameters);
}

Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k) {
  return analysed_frame(run, parameters, k, run.frame(k));
}

}  // namespace talus::runs
