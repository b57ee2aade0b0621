/// Curves of the run shown.

#include <algorithm>
#include <cmath>

#include "analysis/failure/last_rise.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "view/view_model.h"

namespace talus::view {

void ViewModel::plot_rows() { plot_observables(rows_, statics(), abscissa(), plots_); }

void ViewModel::plot_values() {
  const std::vector<double>& times = frames_->instants().times;
  plot_frames(series_->values(), times, mean_diameter(), abscissa(), plots_);
  if (analysis_) plot_frames(analysis_->frames, times, mean_diameter(), abscissa(), plots_, true);
}

void ViewModel::note_thresholds(const pictures::OverloadRule& rule) {
  note_threshold(rule.threshold_factor, theta_c_ ? std::nullopt : std::optional(rule.theta_c), plots_);
}

std::vector<const analysis::Quantity*> ViewModel::more_quantities() const {
  std::vector<const analysis::Quantity*> more;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    const bool known = analysis_ || quantity.display.observable || analysis::needs_threshold(quantity);
    const bool shown = std::ranges::find(plots_, quantity.name, &Plot::name) != plots_.end();
    if (known && !shown && analysis::is_number_of_frame(quantity)) more.push_back(&quantity);
  }
  return more;
}

void ViewModel::add_plot(const analysis::Quantity& quantity) {
  plots_.push_back(plot_of_quantity(quantity));
  name_axis(axis_, plots_);
  plot_rows();
  plot_values();
  note_thresholds(first().settings());
}

void ViewModel::remove_plot(const std::string& name) {
  std::erase_if(plots_, [&name](const Plot& plot) { return plot.added && plot.name == name; });
  state.plot_options.erase(name);
  if (state.enlarged_plot == name) state.enlarged_plot.clear();
}

void ViewModel::set_plot_axis(PlotAxis axis) {
  if (axis == axis_ || !has_plot_axis(axis)) return;
  axis_ = axis;
  name_axis(axis_, plots_);
  plot_rows();
  plot_values();
  for (const Plot& plot : plots_) {
    if (!plot.along_run) continue;
    state.plot_options[plot.name].zoomed.reset();
    state.plot_options[plot.name].chosen.reset();
  }
}

PlotMarks ViewModel::plot_marks() const {
  PlotMarks marks;
  marks.shown = place_on(abscissa(), frame_->tilt, frame_->time);
  for (const TimelineEvent& event : events_) {
    const double place = place_on(abscissa(), event.tilt, event.time);
    if (!std::isfinite(place)) continue;
    if (event.kind == TimelineEvent::Kind::failure) marks.theta_c = place;
    if (event.kind == TimelineEvent::Kind::rearrangement) marks.ticks.push_back(place);
  }
  return marks;
}

void ViewModel::go_to_place(double x) {
  const RunInstants& run_instants = frames_->instants();
  const auto frame =
      axis_ == PlotAxis::time ? pictures::nearest_frame(run_instants.times, x)
      : axis_ == PlotAxis::angle_left
          ? pictures::nearest_frame(analysis::magnitudes(run_instants.tilts, {0, run_instants.tilts.size()}),
                                    theta_c_.value_or(not_known) - radians(x))
          : pictures::nearest_frame(run_instants.tilts, radians(x));
  if (frame) go_to(*frame);
}

}  // namespace talus::view
