#include "session/analysis_run.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <mutex>

#include "core/errors.h"
#include "core/hash.h"
#include "core/trigonometry.h"
#include "session/analysis_frame.h"
#include "session/analysis_input.h"
#include "session/analysis_transition.h"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Frames are handed out one at a time: HDF5 reads for one thread only.
void analyse_frames(const RunFile& run, const AnalysisParameters& parameters, int threads,
                    const AnalysisProgress& progress, Analysis& analysis) {
  std::mutex reading;
  std::size_t next = 0, done = 0;
  const auto work = [&] {
    for (;;) {
      std::unique_lock lock(reading);
      if (next == run.frame_count()) return;
      const std::size_t k = next++;
      const Frame frame = analysed_frame(run, parameters, k);
      lock.unlock();
      analyse_frame(frame, run.header().statics, parameters, k, analysis);
      lock.lock();
      ++done;
      if (progress) progress(done);
    }
  };
  std::vector<std::future<void>> others;
  for (int t = 1; t < threads; ++t) others.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& other : others) other.get();
}

/// Series of frames that the run has observed already: of the last row not after the frame.
void take_observables(const std::vector<ObservableRow>& rows, std::span<const double> tilts,
                      Analysis& analysis) {
  const std::pair<const char*, Observable> series[] = {
      {"packing/volume_strain", Observable::volume_strain},
      {"packing/centre_of_mass_strain", Observable::centre_of_mass_strain},
      {"packing/solid_fraction", Observable::solid_fraction}};
  for (std::size_t k = 0; k < tilts.size(); ++k) {
    const auto after = std::ranges::upper_bound(
        rows, tilts[k], {}, [](const ObservableRow& row) { return at(row, Observable::tilt); });
    if (after == rows.begin()) continue;
    for (const auto& [name, field] : series) values<double>(analysis, name)[k] = at(*std::prev(after), field);
  }
}

void find_transitions(const std::vector<ObservableRow>& rows, std::span<const double> tilts,
                      double mean_diameter, Analysis& analysis) {
  const double theta_c = values<double>(analysis, "theta_c")[0];
  std::vector<double> row_tilts;
  for (const ObservableRow& row : rows) row_tilts.push_back(at(row, Observable::tilt));
  const Observable strains[] = {Observable::volume_strain, Observable::centre_of_mass_strain};
  for (std::size_t s = 0; s < std::size(strains); ++s) {
    std::vector<double> strain;
    for (const ObservableRow& row : rows) strain.push_back(at(row, strains[s]));
    const DilationOnset onset = dilation_onset(row_tilts, strain, theta_c, radians(dilation_window));
    values<double>(analysis, "theta_d/dilation")[s] = onset.tilt;
    values<double>(analysis, "theta_d/dilation_low")[s] = onset.low;
    values<double>(analysis, "theta_d/dilation_high")[s] = onset.high;
  }
  std::vector<double> displacement;
  for (const ObservableRow& row : rows) displacement.push_back(at(row, Observable::surface_displacement));
  values<double>(analysis, "first_slide")[0] =
      first_slide(row_tilts, displacement, slide_distance * mean_diameter, radians(slide_window));
  for (std::size_t f = 0; f < analysis.sizes.at('F'); ++f) {
    std::vector<double> lengths;
    std::vector<Index> spans;
    for (std::size_t k = 0; k < tilts.size(); ++k) {
      lengths.push_back(row<double>(analysis, "lc/max", k)[f]);
      spans.push_back(row<Index>(analysis, "clusters/spans_depth", k)[f]);
    }
    const LengthJump jump = length_jump(tilts, lengths, theta_c, values<double>(analysis, "lc/cut")[0]);
    values<double>(analysis, "theta_d/lc_jump")[f] = jump.tilt;
    values<double>(analysis, "theta_d/lc_jump_error")[f] = jump.error;
    values<double>(analysis, "theta_d/lc_jump_size")[f] = jump.size;
    const PercolationOnset onset = percolation_onset(tilts, spans, theta_c);
    values<double>(analysis, "theta_d/percolation")[f] = onset.tilt;
    values<double>(analysis, "theta_d/percolation_error")[f] = onset.error;
  }
}

}  // namespace

std::string analysis_key(const RunFile& run, const AnalysisParameters& parameters) {
  std::string text =
      hash_text(state_hash(run.checkpoint().world)) + "\n" + std::to_string(analysis_version) + "\n";
  for (const auto& [name, value] : as_facts(parameters)) text += name + "=" + value + "\n";
  return hash_text(hash_bytes(std::as_bytes(std::span(text))));
}

Analysis begin_analysis(const RunStatics& statics, const AnalysisParameters& parameters, double theta_c,
                        std::size_t frames) {
  const double gamma_c = parameters.gamma_c.value_or(std::isnan(theta_c) ? none : sine(theta_c));
  const std::size_t factors = std::isnan(gamma_c) ? 0 : parameters.threshold_factors.size();
  Analysis analysis = make_analysis({{'T', frames},
                                     {'N', statics.radius.size()},
                                     {'F', factors},
                                     {'X', parameters.sections},
                                     {'B', parameters.bins}});
  analysis.parameters = as_facts(parameters);
  values<double>(analysis, "theta_c")[0] = theta_c;
  values<double>(analysis, "gamma_c")[0] = gamma_c;
  const double cut = parameters.lc_cut ? *parameters.lc_cut * statics.mean_diameter
                                       : std::min(statics.depth, 0.5 * statics.length);
  values<double>(analysis, "lc/cut")[0] = std::max(parameters.l_min * statics.mean_diameter,
                                                   statics.periodic ? std::min(cut, statics.length) : cut);
  for (std::size_t f = 0; f < factors; ++f) {
    values<double>(analysis, "threshold_factor")[f] = parameters.threshold_factors[f];
    values<double>(analysis, "threshold")[f] = parameters.threshold_factors[f] * gamma_c;
    values<double>(analysis, "lc/end_ratio")[f] =
        parameters.lc_factor.value_or(parameters.threshold_factors[f]) * gamma_c;
  }
  set_axes(statics, parameters, analysis);
  return analysis;
}

Analysis analyse_run(const RunFile& run, const AnalysisParameters& parameters, int threads,
                     const AnalysisProgress& progress) {
  if (run.frame_count() == 0)
    throw Error(ExitCode::bad_data, "the run has no frames: its bed has not been tilted yet; let it go on");
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(none);
  Analysis analysis = begin_analysis(run.header().statics, parameters, theta_c, run.frame_count());
  analysis.key = analysis_key(run, parameters);
  analyse_frames(run, parameters, threads, progress, analysis);
  const std::vector<ObservableRow> rows = run.observables();
  take_observables(rows, run.frame_tilts(), analysis);
  find_transitions(rows, run.frame_tilts(), run.header().statics.mean_diameter, analysis);
  return analysis;
}

}  // namespace talus
