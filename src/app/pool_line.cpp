#include "app/pool_line.h"

#include <algorithm>
#include <fmt/core.h>

#include "app/progress_text.h"
#include "app/status_line.h"
#include "session/estimate.h"

namespace talus {
namespace {

/// "study: 3 of 8 runs done, 2 under way", and how far that is: the share is that of the jobs that have
/// ended.
std::string line_text(const PoolProgress& progress, const std::string& beginning, const std::string& counted,
                      const StatusLine& line) {
  const double share =
      static_cast<double>(progress.done) / static_cast<double>(std::max<std::size_t>(1, progress.all));
  std::vector<ProgressField> fields =
      progress_fields(share, progress.seconds, progress.seconds_left, line.on_terminal());
  fields.insert(fields.begin(), {fmt::format("{}{} of {} {} done, {} under way", beginning, progress.done,
                                             progress.all, counted, progress.running),
                                 0});
  return fitted_line(fields, line.width());
}

/// "baseline/seed-1 done after 8 s; ", before the line in a log.
std::string end_text(const PoolProgress& progress) {
  const std::string how =
      progress.exit_code == 0 ? "done" : fmt::format("ended with exit code {}", progress.exit_code);
  return fmt::format("{} {} after {}; ", progress.ended->name, how, duration_text(progress.seconds_of_job));
}

}  // namespace

std::vector<FailedJob> run_with_progress(const std::vector<Job>& jobs, std::size_t all, int at_once,
                                         const std::string& work, const std::string& counted) {
  StatusLine line(jobs.empty(), 0.0);
  return run_jobs(jobs, {work, at_once, all, [&](const PoolProgress& progress) {
                           if (line.on_terminal())
                             line.show(line_text(progress, work + ": ", counted, line));
                           else if (progress.ended != nullptr)
                             line.show(line_text(progress, end_text(progress), counted, line));
                         }});
}

}  // namespace talus
