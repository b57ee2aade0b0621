#include "view/frame_reader.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <limits>

namespace talus::view {
namespace {

/// Adds the frame to the pictures and returns its record, if requested.
std::optional<analysis::FrameRecord> add_and_measure(pictures::PictureSeries& pictures, const Frame& stored,
                                                     bool with_values) {
  const pictures::OverloadRule& rule = pictures.plan.maps[0];
  const Frame frame = pictures::as_mapped(pictures, stored);
  const BedFrame bed{frame, pictures.run.statics};
  const analysis::Clusters clusters = pictures::overloaded_clusters(bed, rule);
  pictures::extend(pictures.extent, bed);
  pictures::add_frame(pictures, frame, clusters);
  return with_values ? std::optional(overload_record(bed, clusters, rule)) : std::nullopt;
}

/// Returns whether there was anything to move.
template <typename T>
bool move_all(std::vector<T>& from, std::vector<T>& to) {
  std::ranges::move(from, std::back_inserter(to));
  return !std::exchange(from, {}).empty();
}

}  // namespace

FrameReader::FrameReader(const RunStatics& statics, std::shared_ptr<FrameSource> frames)
    : statics_(statics),
      source_(std::move(frames)),
      extent_(pictures::bed_extent(statics)),
      read_extent_(extent_),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void FrameReader::prepare(std::size_t k, double l_min) {
  const PreparedFrame frame{k, l_min};
  const std::scoped_lock lock(mutex_);
  wanted_ = frame == in_progress_ || frame == prepared_ ? std::nullopt : std::optional(frame);
  changed_.notify_all();
}

std::shared_ptr<const Frame> FrameReader::take(std::size_t k, double l_min) {
  const PreparedFrame frame{k, l_min};
  std::unique_lock lock(mutex_);
  if (wanted_ == frame) wanted_.reset();  // the caller reads it sooner
  if (in_progress_ == frame) changed_.wait(lock, [&] { return in_progress_ != frame; });
  if (prepared_ != frame) return nullptr;
  prepared_.reset();
  return std::move(mapped_);
}

void FrameReader::follow(const std::optional<ContactKey>& contact) {
  if (contact == contact_) return;
  contact_ = contact;
  history_.clear();
  const std::scoped_lock lock(mutex_);
  history_task_ = contact ? std::make_shared<HistoryTask>(HistoryTask{*contact}) : nullptr;
  changed_.notify_all();
}

void FrameReader::evaluate(const pictures::OverloadRule& rule, std::vector<analysis::FrameRecord> known) {
  rule_ = rule;
  values_ = std::move(known);
  auto task = std::make_shared<ValuesTask>();
  task->known = values_.size();
  task->pictures.run.statics = statics_;
  static_cast<pictures::OverloadRule&>(task->pictures.plan.maps.emplace_back()) = rule;
  task->pictures.plan.maps[0].layers = {pictures::MapKind::clusters};
  const std::scoped_lock lock(mutex_);
  task->pictures.extent = read_extent_;
  values_task_ = std::move(task);
  seen_frames_.reset();
  changed_.notify_all();
}

void FrameReader::set_counts(std::size_t frames, std::size_t of_tilt) {
  const std::scoped_lock lock(mutex_);
  frames_ = frames;
  of_tilt_ = of_tilt;
  changed_.notify_all();
}

bool FrameReader::collect_history() {
  const std::scoped_lock lock(mutex_);
  return history_task_ && move_all(history_task_->ready, history_);
}

bool FrameReader::collect_values(pictures::PictureSeries& pictures) {
  const std::scoped_lock lock(mutex_);
  if (!values_task_) return false;
  const bool failed = std::exchange(error_, values_task_->error) != values_task_->error;
  if (!seen_frames_) return failed;
  pictures.seen_frames = *std::exchange(seen_frames_, std::nullopt);
  extent_ = read_extent_;
  move_all(values_task_->ready, values_);
  return true;
}

bool FrameReader::values_are_due() const {
  return values_task_ && values_task_->error.empty() &&
         values_task_->pictures.seen_frames.instants.size() < frames_;
}

void FrameReader::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const auto anything = [this] { return wanted_ || history_is_due() || values_are_due(); };
  while (changed_.wait(lock, stop, anything) && !stop.stop_requested()) {
    if (wanted_)
      prepare_frame(lock);
    else
      history_is_due() ? read_history(lock) : read_values(lock);
  }
}

void FrameReader::prepare_frame(std::unique_lock<std::mutex>& lock) {
  in_progress_ = std::exchange(wanted_, std::nullopt);
  const auto [k, l_min] = *in_progress_;
  lock.unlock();
  std::shared_ptr<const Frame> mapped;
  try {
    if (const auto stored = source_->frame(k); stored->x.size() == statics_.radius.size())
      mapped = std::make_shared<const Frame>(pictures::mapped_frame(*stored, statics_, l_min));
  } catch (const std::exception&) {  // reading it again reports the reason
  }
  lock.lock();
  prepared_ = std::exchange(in_progress_, std::nullopt);
  mapped_ = std::move(mapped);
  changed_.notify_all();
}

void FrameReader::read_history(std::unique_lock<std::mutex>& lock) {
  const std::shared_ptr<HistoryTask> task = history_task_;
  lock.unlock();
  std::optional<HistoryInstant> instant;
  try {
    instant = instant_of(*source_->read(task->next), task->contact);
  } catch (const std::exception&) {  // the values meet the same error, which they report
  }
  lock.lock();
  task->next = instant ? task->next + 1 : std::numeric_limits<std::size_t>::max();
  if (instant) task->ready.push_back(*instant);
}

void FrameReader::read_values(std::unique_lock<std::mutex>& lock) {
  const std::shared_ptr<ValuesTask> task = values_task_;
  const std::size_t k = task->pictures.seen_frames.instants.size();
  const bool with_values = k >= task->known && k < of_tilt_;
  lock.unlock();
  std::optional<analysis::FrameRecord> values;
  std::string error;
  try {
    values = add_and_measure(task->pictures, *source_->read(k), with_values);
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  lock.lock();
  task->error = error;
  if (!error.empty() || task != values_task_) return;
  if (values) task->ready.push_back(std::move(*values));
  seen_frames_ = task->pictures.seen_frames;
  read_extent_ = task->pictures.extent;
}

}  // namespace talus::view
