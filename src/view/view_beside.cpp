/// The second view: what it is of, and how it follows the first.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.h"
#include "view/camera.h"
#include "view/run_clock.h"
#include "view/view_data.h"

namespace talus {
namespace {

const MapLayers& layers_beside(const ViewState& asked) {
  return asked.beside.layers.empty() ? asked.map.layers : asked.beside.layers;
}

/// The same share of its length, as many D above the floor.
Vec2 place_in(const RunStatics& to, const RunStatics& from, double x, double y) {
  return {x / from.length * to.length, y / from.mean_diameter * to.mean_diameter};
}

/// Holds both, with ends of few digits.
ScaleRange common_range(const ScaleRange& one, const ScaleRange& two) {
  constexpr double hair = 1e-6;  // of a step: ends that are round stay
  const double low = std::min(one.low, two.low), high = std::max(one.high, two.high);
  const double step = std::pow(10.0, std::floor(std::log10(high - low)) - 1.0);
  return {step * std::floor(low / step + hair), step * std::ceil(high / step - hair)};
}

const GrainValues& values_of(MapCache& cache, const RunStatics& statics) {
  if (!cache.values) cache.values = cache.source.frame ? grain_values(cache.source, statics) : GrainValues{};
  return *cache.values;
}

}  // namespace

RunInstants ViewModel::Data::instants() const {
  RunInstants of;
  of.tilts = replay ? frames->file().all_frame_tilts() : frame_tilts();
  of.times = all_frame_times();
  of.tilt_count = replay ? frames->file().frame_count() : of.tilts.size();
  of.theta_c = theta_c.value_or(not_known);
  return of;
}

bool ViewModel::Data::same_map(const ViewState& asked) const {
  return other && !asked.beside.minus && layers_beside(asked) == asked.map.layers;
}

ViewState ViewModel::Data::beside_state(const ViewState& asked) const {
  ViewState state = asked;
  state.map.layers = layers_beside(asked);
  state.minus = asked.beside.minus;
  if (state.minus || state.map.layers != asked.map.layers) {  // these are of another map
    state.map.range_low.reset();
    state.map.range_high.reset();
  }
  if (!other) return state;
  if (linked.range && same_map(asked) && !asked.map.range_low && !asked.map.range_high) {
    state.map.range_low = linked.range->low;
    state.map.range_high = linked.range->high;
  }
  const Vec2 centre = place_in(other->statics(), statics(), asked.camera.centre_x, asked.camera.centre_y);
  state.camera = {centre.x, centre.y, asked.camera.zoom};
  state.selected.reset();
  return state;
}

void ViewModel::Data::link_ranges(const ViewState& asked) {
  if (!same_map(asked)) {
    linked = {};
    return;
  }
  const double other_theta_c = other->theta_c();
  if (linked.layers == asked.map.layers && linked.theta_c == shown_theta_c() &&
      linked.other_theta_c == other_theta_c)
    return;
  // By their frames of now: ranges are the same in all.
  linked = {asked.map.layers, shown_theta_c(), other_theta_c, std::nullopt};
  const Data& beside = *other->data_;
  ViewState plain = asked;
  plain.map.range_low.reset();
  plain.map.range_high.reset();
  const auto range = [&](const Data& of) {
    return own_range({of.frame, nullptr, of.map_settings(plain), of.bed, std::nullopt, 0, false},
                     of.statics());
  };
  const std::optional<ScaleRange> one = range(*this), two = range(beside);
  if (one && two && !(*one == *two)) linked.range = common_range(*one, *two);
}

bool ViewModel::Data::follow_beside(const ViewState& asked, double seconds) {
  if (!other) return false;
  link_ranges(asked);
  other->state = beside_state(asked);
  const RunInstants shown = instants();
  const bool in_flow = shown_index() >= shown.tilt_count;
  const auto k =
      linked_frame(asked.beside.clock, shown, {frame->tilt, frame->time, in_flow}, other->data_->instants());
  bool changed = false;
  if (k && *k != other->frame_index()) {
    other->go_to(*k);
    changed = true;
  }
  changed = other->update(seconds) || changed;
  const auto as_high = [](const Data& as, const Data& in) {
    MapExtent extent = as.bed;
    const double scale = in.statics().mean_diameter / as.statics().mean_diameter;
    extent.y_min *= scale;
    extent.y_max *= scale;
    return extent;
  };
  bed_beside = as_high(*other->data_, *this);
  other->data_->bed_beside = as_high(*this, *other->data_);
  if (!other->state.message.empty() && other->state.message != asked.message) error = other->state.message;
  return changed;
}

void ViewModel::open_beside(const std::string& path) {
  if (is_live())
    throw Error(ExitCode::usage, path + ": another run can be beside a replay only; " + this->path() +
                                     " is being computed. Show another map of it, or what has changed");
  if (!is_run(path)) throw Error(ExitCode::usage, path + ": only a run file can be shown beside another run");
  {
    const std::scoped_lock lock(*data_->turn);
    auto data = std::make_unique<Data>();
    data->pictures.path = path;
    data->turn = data_->turn;
    data->open_replay();
    data_->other.reset(new ViewModel(std::move(data)));
  }
  data_->linked = {};
  state.beside.shown = true;
  state.beside.clock = has_program() && data_->other->has_program() ? PlotAxis::time : PlotAxis::tilt;
  data_->follow_beside(state, 0.0);
}

void ViewModel::close_beside() {
  data_->other.reset();
  data_->linked = {};
  data_->bed_beside.reset();
}

const ViewModel* ViewModel::run_beside() const { return data_->other.get(); }

bool ViewModel::has_clock(PlotAxis clock) const {
  return clock != PlotAxis::angle_left || (data_->theta_c && data_->other && data_->other->theta_c_known());
}

FrameView ViewModel::map_beside(double aspect) const {
  if (data_->other) return data_->other->map(aspect);
  const ViewState beside = data_->beside_state(state);
  return data_->picture(beside, data_->part(beside, aspect), data_->map_beside);
}

const FrameView& ViewModel::annotated_map_beside() const {
  if (data_->other) return data_->other->annotated_map();
  const ViewState beside = data_->beside_state(state);
  return data_->whole_map(beside, common_part(data_->part(beside, data_->aspect), data_->bed),
                          data_->map_beside);
}

FrameView ViewModel::furnished_map_beside() const {
  if (data_->other) return data_->other->furnished_map();
  return data_->furnished(data_->beside_state(state), data_->map_beside);
}

std::optional<Index> ViewModel::grain_beside_at(double x, double y) const {
  return data_->other ? data_->other->grain_at(x, y) : grain_at(x, y);
}

Vec2 ViewModel::place_in_first(double x, double y) const {
  return data_->other ? place_in(statics(), data_->other->statics(), x, y) : Vec2{x, y};
}

const GrainValues& ViewModel::values() const { return values_of(data_->map, statics()); }

const GrainValues& ViewModel::values_beside() const {
  return data_->other ? data_->other->values() : values_of(data_->map_beside, statics());
}

}  // namespace talus
