#include "app/analysis_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <initializer_list>

#include "analysis/failure/last_rise.h"
#include "app/event_report.h"
#include "base/text.h"
#include "base/text_table.h"
#include "core/trigonometry.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

constexpr std::size_t table_rows = 11;

std::string degree_text(double angle) { return degrees_text(angle, 2); }

/// Returns frames spaced evenly over the run, including the first and the last.
std::vector<std::size_t> shown_frames(std::size_t count) {
  std::vector<std::size_t> frames;
  const std::size_t rows = std::min(count, table_rows);
  for (std::size_t r = 0; r < rows; ++r)
    frames.push_back(rows > 1 ? (r * (count - 1) + (rows - 1) / 2) / (rows - 1) : 0);
  return frames;
}

std::string heading(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  const double theta_c = analysis.theta_c, gamma_c = analysis.gamma_c;
  const std::vector<analysis::FrameRecord>& frames = analysis.frames;
  const auto [lowest, highest] = std::ranges::minmax_element(frames, {}, &analysis::FrameRecord::tilt);
  std::string text =
      fmt::format("{}  ({})\n{}, {} to {} deg; ", run.path, run.kept, counted(frames.size(), "frame"),
                  degree_text(lowest->tilt), degree_text(highest->tilt));
  if (const analysis::FramesOfRise rise = analysis::last_rise(frames); rise.frames.size() < frames.size())
    text += fmt::format("theta_c, theta_d and the first slide refer to the last rise, from {} deg; ",
                        degree_text(frames[rise.first].tilt));
  text += std::isnan(theta_c) ? "the slope has not failed"
                              : fmt::format("theta_c = {} deg", degree_text(theta_c));
  if (std::isnan(gamma_c))
    return text + ": overloaded grains need a threshold; set one with --set gamma_c=0.3\n";
  const double diameter = run.statics.mean_diameter;
  const double l_min = runs::from_facts(analysis.parameters).l_min;
  text += fmt::format("; Gamma_c = {:.4f}; l_c cut at {:.4g} D\n", gamma_c, analysis.lc_cut / diameter);
  return text +
         (l_min > 0.0
              ? fmt::format("gamma of each grain together with its neighbours within {:.4g} D\n", 0.5 * l_min)
              : std::string("gamma of single grains\n"));
}

std::string span_text(const analysis::FrameThreshold& at) {
  const bool depth = at.spans_depth != 0, length = at.spans_length != 0;
  return std::string(depth ? "H" : "") + (length ? "L" : depth ? "" : "-");
}

TextTable series_table(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  TextTable table{{{"theta", true}, {"Gamma", true}, {"sT/sN", true}, {"z", true}, {"dV/V (%)", true}}, {}};
  for (const analysis::RunThreshold& threshold : analysis.thresholds) {
    const std::string limit =
        fmt::format("gamma >= {:.4g} Gamma_c = {:.4f}", threshold.factor, threshold.gamma);
    table.columns.push_back({"p_o", true, "", limit});
    for (const char* title : {"mean", "max", "largest", "spans"}) table.columns.push_back({title, true});
  }
  for (const std::size_t k : shown_frames(analysis.frames.size())) {
    const analysis::FrameRecord& frame = analysis.frames[k];
    auto& row = table.rows.emplace_back();
    row = {{degree_text(frame.tilt)},
           {number_cell("{:.4f}", frame.stress_ratio)},
           {number_cell("{:.4f}", frame.sigma_t_over_n)},
           {number_cell("{:.3f}", frame.coordination_number)},
           {number_cell("{:+.4f}", 100.0 * frame.volume_strain)}};
    const double diameter = run.statics.mean_diameter;
    for (const analysis::FrameThreshold& at : frame.thresholds)
      row.insert(row.end(), {{number_cell("{:.3f}", at.overloaded_fraction)},
                             {number_cell("{:.2f}", at.lc_mean / diameter)},
                             {number_cell("{:.1f}", at.lc_max / diameter)},
                             {number_cell("{:.3f}", at.largest_share)},
                             {span_text(at)}});
  }
  return table;
}

/// Returns "8.25 +- 0.25 deg", or "<= 0.00 deg" if no frame precedes the angle.
std::string onset_text(double angle, double error) {
  if (std::isnan(angle)) return "none";
  if (std::isnan(error)) return fmt::format("<= {} deg", degree_text(angle));
  return fmt::format("{} +- {} deg", degree_text(angle), degree_text(error));
}

std::string line(const std::string& name, const std::initializer_list<std::string> texts) {
  std::string text = fmt::format("  {:<34}", name);
  for (const std::string& each : texts) text += fmt::format("{:<24}", each);
  return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string dilation_text(const analysis::Analysis& analysis, std::size_t s) {
  const double angle = analysis.dilation[s];
  if (std::isnan(angle)) return "none";
  return fmt::format("{} deg, {} to {}", degree_text(angle), degree_text(analysis.dilation_low[s]),
                     degree_text(analysis.dilation_high[s]));
}

std::string first_slide_text(const analysis::Analysis& analysis) {
  const double angle = analysis.first_slide;
  if (std::isnan(angle)) return "none";
  const bool late = angle > analysis.theta_c;
  return degree_text(angle) + " deg" +
         (late ? ", after theta_c: tilting continued while the flow that began there gathered speed" : "");
}

std::string transition_table(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  std::string text = line("first slide of the surface layer", {first_slide_text(analysis)}) + "theta_d by\n";
  for (const analysis::RunThreshold& threshold : analysis.thresholds) {
    const std::string at = fmt::format(", {:.4g} Gamma_c", threshold.factor);
    const double size = threshold.lc_jump_size / run.statics.mean_diameter;
    text += line("jump of l_c max" + at, {onset_text(threshold.lc_jump, threshold.lc_jump_error),
                                          std::isnan(size) ? "" : fmt::format("by {:.1f} D", size)});
    text += line("percolation" + at, {onset_text(threshold.percolation, threshold.percolation_error)});
  }
  return text + line("dilation, volume", {dilation_text(analysis, 0)}) +
         line("dilation, centre of mass", {dilation_text(analysis, 1)});
}

}  // namespace

std::string beyond_repose(double theta_c, double tilt) {
  if (!(degrees(tilt - theta_c) > 1.0)) return "";
  return fmt::format(
      "; tilting continued to {} deg while this flow gathered speed, so the first slide may come after "
      "theta_c (for a smaller difference, lower tilt.rate)",
      degree_text(tilt));
}

std::string analysis_text(const runs::RunView& run) {
  return fmt::format("{}\n{}{}\n{}{}", heading(run), aligned_text(series_table(run), 1),
                     !run.analysis.thresholds.empty()
                         ? "l_c in D; largest: share of the overloaded grains in the largest cluster; spans: "
                           "H from floor to surface, L along the bed\n"
                         : "",
                     transition_table(run), event_summary(run));
}

}  // namespace talus::app
