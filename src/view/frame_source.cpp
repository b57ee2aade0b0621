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

Replay::Replay(const std::string& path) : file_(io::RunFile::open(path)) {
  if (file_.all_frame_tilts().empty())
    throw Error(ExitCode::bad_data,
                path + " has no frames yet: there is nothing to show before the tilt begins");
  instants_ = {file_.all_frame_tilts(), file_.all_frame_times(), file_.frame_count()};
}

std::shared_ptr<const Frame> Replay::read(std::size_t k) {
  const std::scoped_lock lock(file_mutex_);
  return std::make_shared<const Frame>(file_.frame(k));
}

std::shared_ptr<const Frame> Replay::frame(std::size_t k) {
  std::unique_lock lock(kept_mutex_);
  const auto found =
      std::ranges::find(kept_, k, &std::pair<std::size_t, std::shared_ptr<const Frame>>::first);
  auto frame = found == kept_.end() ? nullptr : found->second;
  lock.unlock();
  if (!frame) frame = read(k);
  keep(k, frame);
  return frame;
}

void Replay::keep(std::size_t k, const std::shared_ptr<const Frame>& frame) {
  const std::scoped_lock lock(kept_mutex_);
  std::erase_if(kept_, [k](const auto& kept) { return kept.first == k; });
  const std::size_t most = max_kept(*frame);
  kept_.emplace_front(k, frame);
  while (kept_.size() > most) kept_.pop_back();
}

void Replay::go_to(std::size_t frame) {
  index_ = std::min(frame, count() - 1);
  waited_ = 0.0;
}

void Replay::play(bool on) {
  if (on && index_ + 1 == count()) go_to(0);
  playing_ = on && count() > 1;
  waited_ = 0.0;
}

void Replay::set_speed(double degrees_per_second) { speed_ = std::max(degrees_per_second, slowest); }

double Replay::seconds_shown(std::size_t k) const {
  const std::vector<double>& tilts = file_.frame_tilts();
  if (file_.goes_by_time()) {  // in proportion to time, also while the tilt is held
    const std::vector<double>& times = file_.all_frame_times();
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
  for (waited_ += seconds; index_ + 1 < count() && waited_ >= seconds_shown(index_); ++index_)
    waited_ -= seconds_shown(index_);
  if (index_ + 1 == count()) playing_ = false;
  return index_ != before;
}

}  // namespace talus::view
