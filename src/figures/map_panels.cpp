#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>

#include "base/text.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "pictures/picture_series.h"
#include "runs/analysis_input.h"
#include "runs/analysis_parameters.h"
#include "stress/overload.h"

namespace talus::figures {
namespace {

constexpr double paper_tilts[] = {0.0, 5.0, 10.0, 15.0};  // deg

/// The frames of the panels and their pictures.
struct Panels {
  pictures::FrameChoice choice;
  std::vector<Frame> frames;
  pictures::PictureSeries pictures;
};

/// Returns the settings of a map whose Gamma_c is that of the analysis, which may differ from sin(theta_c),
/// times `factor`.
pictures::MapSettings map_of(const runs::RunView& run, pictures::MapKind kind, double factor) {
  pictures::MapSettings settings;
  settings.layers = {kind};
  settings.theta_c = theta_c_of(run);
  settings.threshold_factor = factor * (run.analysis.gamma_c / sine(settings.theta_c));
  if (std::abs(run.analysis.gamma_c / sine(settings.theta_c) - 1.0) > 1e-9)
    settings.range_high = 2.0 * run.analysis.gamma_c;
  return settings;
}

Panels read_panels(const runs::RunView& run, std::vector<pictures::MapSettings> maps, const FrameWords& at) {
  Panels panels;
  if (at.empty()) {
    const analysis::FramesOfRise rise = runs::last_rise_of(run);
    panels.choice = panel_frames(rise.tilts, theta_c_of(run));
    for (std::size_t& frame : panels.choice) frame += rise.first;
  } else {
    panels.choice = frames_of_run(run, at);
  }
  panels.pictures.run = run.file->header();
  panels.pictures.plan.maps = std::move(maps);
  panels.pictures.extent = pictures::bed_extent(panels.pictures.run.statics);
  for (const std::size_t k : panels.choice) {
    panels.frames.push_back(runs::analysed_frame(*run.file, runs::from_facts(run.analysis.parameters), k));
    pictures::extend(panels.pictures.extent, {panels.frames.back(), panels.pictures.run.statics});
  }
  return panels;
}

/// Returns the share of the grains that carry something with gamma at or above this value.
double share_from(const BedFrame& bed, double gamma) {
  return stress::count_overloaded(bed, gamma).fraction();
}

/// Returns the angles of the panels, deg.
std::string listed(const Panels& panels, const char* separator) {
  return joined(panels.frames, separator, [](const Frame& frame) { return angle_text(frame.tilt); });
}

/// Returns the common end of both captions.
std::string bed_text(const FailedGroup& failed, const Panels& panels, bool of_paper) {
  const double theta_c = theta_c_of(failed.first());
  std::string text =
      fmt::format("; {}. From top to bottom theta = {} deg, {}theta_c = {} deg", first_run_text(failed),
                  listed(panels, ", "), of_paper ? "the last of them the frame before failure at " : "",
                  angle_text(theta_c));
  std::string beyond;
  for (const double tilt : paper_tilts)
    if (of_paper && radians(tilt) >= theta_c)
      beyond.append(beyond.empty() ? "" : " and ").append(rounded_text(tilt, 0));
  if (!beyond.empty()) text += fmt::format("; the paper's {} deg lies beyond it and is left out", beyond);
  return fmt::format(
      "{}. The bed is shown in its own frame, with the direction of gravity; hatched grains are the floor. "
      "{}",
      text, reading_caption(failed.first()));
}

/// Returns a figure with a row of maps for each panel.
Figure panel_figure(const FailedGroup& failed, const Panels& panels) {
  Figure figure;
  figure.runs = {failed.first().path};
  figure.wide = true;
  for (std::size_t k = 0; k < panels.frames.size(); ++k) {
    std::vector<render::FrameView>& row = figure.maps.emplace_back();
    for (std::size_t map = 0; map < panels.pictures.plan.maps.size(); ++map)
      row.push_back(pictures::picture(panels.pictures, k, panels.frames[k], nullptr, map));
  }
  return figure;
}

Column tilt_column(const Panels& panels) {
  Column column{"theta", "deg", "tilt of the panel", {}};
  for (const Frame& frame : panels.frames) column.values.push_back(degrees(frame.tilt));
  return column;
}

/// Returns the values at one threshold for each panel.
std::vector<Column> threshold_columns(const analysis::Analysis& analysis, const Panels& panels,
                                      std::size_t f) {
  const std::string factor = rounded_text(analysis.thresholds[f].factor, 3);
  std::vector<Column> columns;
  for (const auto& [name, member] : {std::pair<std::string, analysis::QuantityMember>(
                                         "p_o_", &analysis::FrameThreshold::overloaded_fraction),
                                     std::pair<std::string, analysis::QuantityMember>(
                                         "largest_share_", &analysis::FrameThreshold::largest_share),
                                     std::pair<std::string, analysis::QuantityMember>(
                                         "spans_depth_", &analysis::FrameThreshold::spans_depth)}) {
    const analysis::Quantity& quantity = analysis::quantity_of(member);
    columns.push_back({name + factor,
                       quantity.unit,
                       fmt::format("{}, threshold {} Gamma_c", quantity.definition, factor),
                       {}});
    for (const std::size_t k : panels.choice)
      columns.back().values.push_back(analysis::number_of(quantity, analysis.frames.at(k), f));
  }
  return columns;
}

}  // namespace

pictures::FrameChoice panel_frames(const std::vector<double>& tilts, double theta_c) {
  const std::size_t last = pictures::frame_at_repose(tilts, theta_c);
  pictures::FrameChoice choice;
  for (const double tilt : paper_tilts)
    if (const auto frame = pictures::frame_near(tilts, radians(tilt)); frame && radians(tilt) < theta_c)
      choice.push_back(std::min(*frame, last));  // the nearest may lie beyond the last
  choice.push_back(last);
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

std::optional<Figure> gamma_maps(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_failed_group(groups);
  if (!failed) return std::nullopt;
  const double gamma_c = failed->first().analysis.gamma_c;
  const Panels panels =
      read_panels(failed->first(), {map_of(failed->first(), pictures::MapKind::gamma, 1.0)}, at);
  Figure figure = panel_figure(*failed, panels);
  figure.name = "fig10-stress-ratio-maps";
  figure.title = "Maps of the stress ratio of each grain (paper, Fig. 10)";
  figure.caption = fmt::format(
      "Stress ratio gamma of each grain: white below {}, black from 2 Gamma_c = {} upwards, linear gray "
      "between{}",
      rounded_text(pictures::white_below, 2), rounded_text(2.0 * gamma_c, 3),
      bed_text(*failed, panels, at.empty()));
  Column mean{"gamma_mean", "1", analysis::quantity_of(&analysis::FrameRecord::gamma_mean).definition, {}};
  Column share_white{"white", "1", "share of these grains that are white", {}};
  Column share_black{"black", "1", "share of them that are black", {}};
  for (std::size_t k = 0; k < panels.frames.size(); ++k) {
    const BedFrame bed{panels.frames[k], panels.pictures.run.statics};
    mean.values.push_back(failed->first().analysis.frames.at(panels.choice[k]).gamma_mean);
    share_white.values.push_back(1.0 - share_from(bed, pictures::white_below));
    share_black.values.push_back(share_from(bed, 2.0 * gamma_c));
  }
  figure.tables = {{"", {tilt_column(panels), mean, share_white, share_black}}};
  return figure;
}

std::optional<Figure> overload_maps(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_failed_group(groups);
  if (!failed) return std::nullopt;
  const analysis::Analysis& analysis = failed->first().analysis;
  const std::vector<analysis::RunThreshold>& thresholds = analysis.thresholds;
  std::vector<pictures::MapSettings> maps;
  for (const analysis::RunThreshold& threshold : thresholds)
    maps.push_back(map_of(failed->first(), pictures::MapKind::overloaded, threshold.factor));
  const Panels panels = read_panels(failed->first(), std::move(maps), at);
  Figure figure = panel_figure(*failed, panels);
  figure.name = "fig13-overloaded-maps";
  figure.title = "Maps of the overloaded grains (paper, Fig. 13)";
  figure.caption = "Overloaded grains in black, with a column for each threshold of gamma" +
                   bed_text(*failed, panels, at.empty());
  figure.tables = {{"", {tilt_column(panels)}}};
  for (std::size_t f = 0; f < thresholds.size(); ++f)
    for (Column& column : threshold_columns(analysis, panels, f))
      figure.tables[0].columns.push_back(std::move(column));
  return figure;
}

}  // namespace talus::figures
