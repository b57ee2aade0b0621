/// The second view: its content, and how it follows the first.

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "view/camera.h"
#include "view/run_clock.h"
#include "view/view_model.h"

namespace talus::view {
namespace {

const pictures::MapLayers& second_layers(const ViewState& asked) {
  return asked.second_view.layers.empty() ? asked.map.layers : asked.second_view.layers;
}

/// Returns a range that contains both, with ends of few digits.
pictures::ScaleRange common_range(const pictures::ScaleRange& one, const pictures::ScaleRange& two) {
  constexpr double hair = 1e-6;  // in steps: ends that are already round stay
  const double low = std::min(one.low, two.low), high = std::max(one.high, two.high);
  const double step = std::pow(10.0, std::floor(std::log10(high - low)) - 1.0);
  return {step * std::floor(low / step + hair), step * std::ceil(high / step - hair)};
}

}  // namespace

Vec2 place_in(const RunStatics& to, const RunStatics& from, double x, double y) {
  if (&to == &from) return {x, y};
  return {x / from.length * to.length, y / from.mean_diameter * to.mean_diameter};
}

RunInstants ViewModel::instants() const {
  RunInstants run_instants = frames_->instants();
  run_instants.theta_c = theta_c_.value_or(not_known);
  return run_instants;
}

std::vector<double> ViewModel::tilts_of_tilt() const {
  std::vector<double> tilts = frames_->instants().tilts;
  tilts.resize(frames_->instants().tilt_count);
  return tilts;
}

std::vector<double> ViewModel::times_of_tilt() const {
  std::vector<double> times = frames_->instants().times;
  times.resize(frames_->instants().tilt_count);
  return times;
}

bool ViewModel::same_map() const {
  return other_ && !state.second_view.minus && second_layers(state) == state.map.layers;
}

ViewState ViewModel::second_view_state() const {
  ViewState view_state = state;
  view_state.map.layers = second_layers(state);
  view_state.minus = state.second_view.minus;
  if (view_state.minus || view_state.map.layers != state.map.layers) {  // these belong to another map
    view_state.map.range_low.reset();
    view_state.map.range_high.reset();
  }
  if (!other_) return view_state;
  if (linked_.range && same_map() && !state.map.range_low && !state.map.range_high) {
    view_state.map.range_low = linked_.range->low;
    view_state.map.range_high = linked_.range->high;
  }
  const Vec2 centre = place_in(other_->statics(), statics(), state.camera.centre_x, state.camera.centre_y);
  view_state.camera = {centre.x, centre.y, state.camera.zoom};
  view_state.selected.reset();
  return view_state;
}

View ViewModel::second() {
  if (other_) return {*other_, other_->state, other_->map_, true};
  second_state_ = second_view_state();
  return {*this, second_state_, second_map_, true};
}

void ViewModel::link_ranges() {
  if (!same_map()) {
    linked_ = {};
    return;
  }
  if (linked_.layers == state.map.layers && linked_.theta_c == theta_c() &&
      linked_.other_theta_c == other_->theta_c())
    return;
  // The current frames suffice, because ranges are the same in all frames.
  linked_ = {state.map.layers, theta_c(), other_->theta_c(), std::nullopt};
  ViewState plain = state;
  plain.map.range_low.reset();
  plain.map.range_high.reset();
  const auto range = [&plain](ViewModel& model) {
    const View view{model, plain, model.map_};
    return own_range({model.frame_, nullptr, view.settings(), model.bed_, std::nullopt, 0, false},
                     model.statics());
  };
  const std::optional<pictures::ScaleRange> one = range(*this), two = range(*other_);
  if (one && two && !(*one == *two)) linked_.range = common_range(*one, *two);
}

bool ViewModel::follow_second_run(double seconds) {
  if (!other_) return false;
  link_ranges();
  other_->state = second_view_state();
  const RunInstants shown = instants();
  const bool in_flow = frame_index() >= shown.tilt_count;
  const auto k =
      linked_frame(state.second_view.clock, shown, {frame_->tilt, frame_->time, in_flow}, other_->instants());
  const bool goes = k && *k != other_->frame_index();
  if (goes) other_->go_to(*k);
  const bool changed = other_->update(seconds) || goes;
  const auto as_high = [](const ViewModel& as, const ViewModel& in) {
    pictures::MapExtent extent = as.bed_;
    const double scale = in.mean_diameter() / as.mean_diameter();
    extent.y_min *= scale;
    extent.y_max *= scale;
    return extent;
  };
  second_bed_ = as_high(*other_, *this);
  other_->second_bed_ = as_high(*this, *other_);
  if (!other_->state.message.empty() && other_->state.message != state.message)
    error_ = other_->state.message;
  return changed;
}

void ViewModel::open_second_run(const std::string& path) {
  if (is_live())
    throw Error(ExitCode::usage, path + ": another run can be shown only next to a replay; " + this->path() +
                                     " is being computed. Show another map of it, or its change");
  if (!io::is_run(path))
    throw Error(ExitCode::usage, path + ": only a run file can be shown next to another run");
  {
    const std::scoped_lock lock(*turn_);
    std::unique_ptr<ViewModel> next(new ViewModel);
    next->pictures_.path = path;
    next->turn_ = turn_;
    next->open_replay();
    other_ = std::move(next);
  }
  linked_ = {};
  state.second_view.shown = true;
  state.second_view.clock = goes_by_time() && other_->goes_by_time() ? PlotAxis::time : PlotAxis::tilt;
  follow_second_run(0.0);
}

void ViewModel::close_second_run() {
  other_.reset();
  linked_ = {};
  second_bed_.reset();
}

bool ViewModel::has_clock(PlotAxis clock) const {
  return clock != PlotAxis::angle_left || (theta_c_ && other_ && other_->theta_c_known());
}

}  // namespace talus::view
