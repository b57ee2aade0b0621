#include "ensemble/member_series.h"

#include <cmath>
#include <fmt/core.h>

#include "analysis/last_rise.h"
#include "analysis/quantities.h"
#include "core/text_stream.h"
#include "core/trigonometry.h"
#include "ensemble/member_numbers.h"
#include "ensemble/plan.h"
#include "scenario/text.h"

namespace talus {
namespace {

std::string head_of(const NamedSeries& series) { return fmt::format("{} ({})", series.name, series.unit); }

/// "name (unit)" taken apart.
NamedSeries series_of_head(const std::string& head, const std::string& path) {
  const std::size_t bracket = head.rfind(" (");
  if (bracket == std::string::npos || head.back() != ')') refuse_table(path);
  return {head.substr(0, bracket), head.substr(bracket + 2, head.size() - bracket - 3), {}};
}

}  // namespace

std::vector<const FrameRecord*> frames_to_failure(const Analysis& analysis) {
  std::vector<const FrameRecord*> frames;
  for (const FrameRecord* frame : last_rise(analysis.frames).frames)
    if (!(std::abs(frame->tilt) > analysis.theta_c) &&
        (frames.empty() || std::abs(frame->tilt) > std::abs(frames.back()->tilt)))
      frames.push_back(frame);
  return frames;
}

MemberSeries member_series(const Analysis& analysis, double mean_diameter) {
  const std::vector<const FrameRecord*> frames = frames_to_failure(analysis);
  const bool other_side = last_rise(analysis.frames).other_side;
  MemberSeries found;
  for (const FrameRecord* frame : frames) found.theta.push_back(degrees(std::abs(frame->tilt)));
  for (const Quantity& quantity : quantities()) {
    if (!is_number_of_frame(quantity)) continue;
    const std::size_t count = needs_threshold(quantity) ? analysis.thresholds.size() : 1;
    for (std::size_t f = 0; f < count; ++f) {
      NamedSeries series{element_name(quantity.name, f), scaled_unit(quantity.unit), {}};
      for (const FrameRecord* frame : frames)
        series.values.push_back(
            scaled(quantity.unit, number_on_one_side(quantity, *frame, f, other_side), mean_diameter));
      found.series.push_back(std::move(series));
    }
  }
  return found;
}

std::string series_csv(const MemberSeries& series) {
  std::string text = "theta (deg)";
  for (const NamedSeries& column : series.series) text.append(",").append(head_of(column));
  text += "\n";
  for (std::size_t row = 0; row < series.theta.size(); ++row) {
    text += short_text(series.theta[row]);
    for (const NamedSeries& column : series.series)
      text.append(",").append(std::isnan(column.values[row]) ? std::string()
                                                             : short_text(column.values[row]));
    text += "\n";
  }
  return text;
}

MemberSeries parse_series(const std::string& text, const std::string& path) {
  std::istringstream lines = text_stream(text);
  std::string line;
  if (!std::getline(lines, line)) refuse_table(path);
  const std::vector<std::string> heads = split(line, ',');
  if (heads.front() != "theta (deg)") refuse_table(path);
  MemberSeries found;
  for (std::size_t c = 1; c < heads.size(); ++c) found.series.push_back(series_of_head(heads[c], path));
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = split(line, ',');
    if (cells.size() != heads.size()) refuse_table(path);
    const double theta = parse_cell(cells.front(), path);
    if (std::isnan(theta) || (!found.theta.empty() && theta <= found.theta.back())) refuse_table(path);
    found.theta.push_back(theta);
    for (std::size_t c = 1; c < cells.size(); ++c)
      found.series[c - 1].values.push_back(parse_cell(cells[c], path));
  }
  for (NamedSeries& series : found.series) series.values.shrink_to_fit();  // there may be many members
  return found;
}

std::string series_path(const std::string& run) { return file_beside(run, series_ending); }

}  // namespace talus
