#include "view/frame_source.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "core/trigonometry.h"

namespace talus::view {
namespace {

constexpr double slowest = 1e-3;  // deg/s

/// Returns how many frames of that size are cached: all of the paper's bed.
std::size_t max_kept(const Frame& frame) {
  constexpr std::size_t budget = 256u << 20, of_grain = 90, of_contact = 60;  // bytes
  const std::size_t size = of_grain * frame.x.size() + of_contact * frame.contacts.a.size() + 1;
  return std::max<std::size_t>(2, budget / size);
}

}  // namespace

void RecordedFrames::add(const std::vector<std::shared_ptr<const Frame>>& more) {
  for (const auto& frame : more) {
    instants_.tilts.push_back(frame->tilt);
    instants_.times.push_back(frame->time);
  }
  instants_.tilt_count = instants_.tilts.size();
  const std::scoped_lock lock(mutex_);
  frames_.insert(frames_.end(), more.begin(), more.end());
}

std::shared_ptr<const Frame> RecordedFrames::read(std::size_t k) {
  const std::scoped_lock lock(mutex_);
  return frames_.at(k);
}

RunFrames::RunFrames(const std::string& path) : file_(io::RunFile::open(path)) {
  if (file_.all_frame_tilts().empty())
    throw Error(ExitCode::bad_data,
                path + " has no frames yet: there is nothing to show before the tilt begins");
  instants_ = {file_.all_frame_tilts(), file_.all_frame_times(), file_.frame_count()};
}

std::shared_ptr<const Frame> RunFrames::read(std::size_t k) {
  const std::scoped_lock lock(mutex_);
  return std::make_shared<const Frame>(file_.frame(k));
}

std::shared_ptr<const Frame> RunFrames::frame(std::size_t k) {
  auto frame = kept(k);
  if (!frame) frame = read(k);
  keep(k, frame);
  return frame;
}

std::shared_ptr<const Frame> RunFrames::kept(std::size_t k) const {
  const auto found =
      std::ranges::find(kept_, k, &std::pair<std::size_t, std::shared_ptr<const Frame>>::first);
  return found == kept_.end() ? nullptr : found->second;
}

void RunFrames::keep(std::size_t k, std::shared_ptr<const Frame> frame) {
  std::erase_if(kept_, [k](const auto& kept) { return kept.first == k; });
  const std::size_t most = max_kept(*frame);
  kept_.emplace_front(k, std::move(frame));
  while (kept_.size() > most) kept_.pop_back();
}

void Replay::go_to(std::size_t frame) {
  index_ = std::min(frame, frames_->count() - 1);
  waited_ = 0.0;
}

void Replay::play(bool on) {
  if (on && index_ + 1 == frames_->count()) go_to(0);
  playing_ = on && frames_->count() > 1;
  waited_ = 0.0;
}

void Replay::set_speed(double degrees_per_second) { speed_ = std::max(degrees_per_second, slowest); }

double Replay::seconds_shown(std::size_t k) const {
  const std::vector<double>& tilts = frames_->file().frame_tilts();
  if (frames_->file().goes_by_time()) {  // in proportion to time, also while the tilt is held
    const std::vector<double>& times = frames_->file().all_frame_times();
    double fastest = 0.0;  // rad/s
    for (std::size_t j = 1; j < tilts.size(); ++j)
      fastest = std::max(fastest, std::abs(tilts[j] - tilts[j - 1]) / (times[j] - times[j - 1]));
    const double after = k + 1 < times.size() ? times[k + 1] - times[k] : 0.0;
    return degrees(fastest > 0.0 ? fastest : radians(1.0)) * after / speed_;
  }
  if (k + 1 < tilts.size()) return degrees(tilts[k + 1] - tilts[k]) / speed_;
  const double spacing =
      tilts.size() > 1 ? degrees(tilts.back() - tilts.front()) / static_cast<double>(tilts.size() - 1) : 1.0;
  return spacing / speed_;
}

bool Replay::advance(double seconds) {
  if (!playing_) return false;
  const std::size_t before = index_;
  for (waited_ += seconds; index_ + 1 < frames_->count() && waited_ >= seconds_shown(index_); ++index_)
    waited_ -= seconds_shown(index_);
  if (index_ + 1 == frames_->count()) playing_ = false;
  return index_ != before;
}

}  // namespace talus::view
