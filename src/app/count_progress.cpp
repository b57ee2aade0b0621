#include "app/count_progress.h"

#include <memory>
#include <utility>

#include "app/progress_text.h"

namespace talus {
namespace {

constexpr double seconds_in_log = 5.0;

}  // namespace

CountProgress::CountProgress(std::string label, std::size_t count, bool quiet)
    : label_(std::move(label)), count_(count), line_(quiet, seconds_in_log) {}

void CountProgress::show(std::size_t done) {
  const bool last = line_.on_terminal() && done == count_;
  if (!last && !line_.is_due()) return;
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin_).count();
  line_.show(count_progress_text(label_, done, count_, elapsed, line_.width()));
}

std::function<void(std::size_t, std::size_t)> count_shown(std::string label, bool quiet) {
  if (quiet) return {};
  return [label = std::move(label), line = std::shared_ptr<CountProgress>(), before = std::size_t{0}](
             std::size_t done, std::size_t count) mutable {
    if (!line || done < before) line = std::make_shared<CountProgress>(label, count, false);
    before = done;
    line->show(done);
  };
}

}  // namespace talus
