#include "view/view_data.h"

#include <cmath>

#include "core/errors.h"
#include "pictures/frame_choice.h"

namespace talus {

void ViewModel::Data::open_replay() {
  frames = std::make_shared<RunFrames>(pictures.path);
  replay.emplace(frames);
  const RunFile& file = frames->file();
  pictures.run = file.header();
  all_statics = statics();
  theta_c = find_value(file.checkpoint().results, "theta_c");
  if (theta_c && !std::isfinite(*theta_c)) theta_c.reset();  // it has not failed
  analysis = read_usable_analysis(pictures.path, file);
  rows = file.observables();
  plot_observables(rows, statics(), plots);
  plot_steps(file.steps(), plots);
  dilation = dilation_frame(rows, file.frame_tilts(), theta_c.value_or(std::nan("")));
  // The bed is highest at its beginning or at its end.
  bed = bed_extent(statics());
  extend(bed, {*frames->read(replay->count() - 1), statics()});
  show(replay->frame(0));
  begin_series();
}

void ViewModel::Data::begin_series() {
  series.reset();
  if (replay) {
    series =
        std::make_unique<FrameSeries>(all_statics, [from = frames](std::size_t k) { return from->read(k); });
    series->set_counts(replay->count(), frames->file().frame_count());
  } else {
    series = std::make_unique<FrameSeries>(all_statics,
                                           [from = recorded](std::size_t k) { return from->read(k); });
    series->set_counts(recorded->all().size(), recorded->all().size());
  }
}

void ViewModel::Data::start_live(const std::string& next_output, bool overwrite) {
  auto next = std::make_unique<LiveRun>(scenario, scenario_text, next_output, overwrite, command_line);
  output = next_output;
  series.reset();
  pictures.met = {};
  live = std::move(next);
  pictures.run.statics = all_statics = live->statics();
  pictures.run.seed = scenario.seed;
  theta_c.reset();
  rows.clear();
  plots = empty_plots();
  show(live->frame());
  recorded = std::make_shared<RecordedFrames>();
  begin_series();
}

std::shared_ptr<const Frame> ViewModel::Data::read(std::size_t k) {
  try {
    return replay->frame(k);
  } catch (const Error& failure) {
    error = failure.what();
    return nullptr;
  }
}

void ViewModel::Data::show_replayed() {
  auto next = read(replay->index());
  if (next) return show(std::move(next));
  replay->play(false);
}

void ViewModel::Data::show(std::shared_ptr<const Frame> next) {
  if (next == stored) return;
  stored = std::move(next);
  if (stored->x.size() != statics().radius.size())
    pictures.run.statics = arrived_statics(all_statics, stored->grain_count());
  // While a bed falls together its top goes down: then only the frame shown counts.
  if (!replay) bed = series ? series->extent() : bed_extent(statics());
  extend(bed, {*stored, statics()});
  make_frame();
}

bool ViewModel::Data::read_with(double next_l_min) {
  if (next_l_min == l_min) return false;
  l_min = next_l_min;
  make_frame();
  return true;
}

void ViewModel::Data::make_frame() {
  frame = std::make_shared<const Frame>(mapped_frame(*stored, statics(), l_min));
  plot_gamma({*frame, statics()}, plots);
}

bool ViewModel::Data::take_live() {
  auto next = live->frame();
  const LiveStatus status = live->status();
  theta_c = status.theta_c;
  if (next == stored) return false;
  recorded->add(live->recorded_frames(recorded->all().size()));
  series->set_counts(recorded->all().size(), recorded->all().size());
  const std::vector<ObservableRow> more = live->observables(rows.size());
  rows.insert(rows.end(), more.begin(), more.end());
  if (!more.empty()) plot_observables(rows, statics(), plots);
  plot_steps(live->steps(0), plots);
  show(std::move(next));
  return true;
}

bool ViewModel::Data::follow_frames(const OverloadRule& rule) {
  bool changed = !(series->rule() == rule);
  if (changed) {
    const auto threshold = analysis ? find_threshold(*analysis, rule) : std::nullopt;
    series->begin(rule, threshold ? stored_records(*analysis, *threshold) : std::vector<FrameRecord>{});
  }
  if (series->take_in(pictures)) {
    if (replay) extend(bed, series->extent());
    if (!series->error().empty()) error = series->error();
    changed = true;
  }
  if (changed) plot_frames(series->values(), statics().mean_diameter, plots);
  return changed;
}

std::optional<std::size_t> ViewModel::Data::place_of(Landmark landmark) const {
  if (!replay) return std::nullopt;
  const std::vector<double>& tilts = frames->file().frame_tilts();
  switch (landmark) {
    case Landmark::first:
      return 0;
    case Landmark::last:
      return replay->count() - 1;
    case Landmark::theta_c:
      if (!theta_c || tilts.front() > *theta_c) return std::nullopt;
      return frame_at_repose(tilts, *theta_c);
    case Landmark::percolation:
      return percolation_frame(series->values());
    case Landmark::theta_d:
      return dilation;
    case Landmark::length_jump:
      if (!series->has_all_values()) return std::nullopt;
      return length_jump_frame(series->values(), length_cut(statics(), series->rule().l_min),
                               theta_c.value_or(std::nan("")));
  }
  return std::nullopt;
}

}  // namespace talus
