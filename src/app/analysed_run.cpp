#include "app/analysed_run.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "app/progress.h"
#include "core/hash.h"
#include "io/analysis_file.h"
#include "io/run_file.h"
#include "session/analysis_run.h"

namespace talus {
namespace {

/// Tells how far an analysis is: in one line of a terminal, or now and then in a log.
class AnalysisLine {
 public:
  AnalysisLine(std::size_t frames, bool quiet)
      : frames_(frames), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

  void show(std::size_t done) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    const bool last = done == frames_;
    if (quiet_ || (!(last && terminal_) && seconds - shown_ < (terminal_ ? 0.2 : 10.0))) return;
    shown_ = seconds;
    const double left = seconds * static_cast<double>(frames_ - done) / static_cast<double>(done);
    std::fprintf(stderr, "%sanalysis  frame %zu of %zu  ETA %s  (%s)%s", terminal_ ? "\r\033[K" : "", done,
                 frames_, duration_text(left).c_str(), duration_text(seconds).c_str(),
                 last || !terminal_ ? "\n" : "");
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t frames_;
  bool quiet_;
  bool terminal_;
  Clock::time_point begin_ = Clock::now();
  double shown_ = 0.0;  ///< s after the beginning
};

}  // namespace

AnalysedRun analysed_run(const std::string& path, const AnalysisParameters& parameters,
                         const AnalysisOptions& options) {
  const RunFile run = RunFile::open(path);
  AnalysedRun result{path, "", run.header().statics, run.frame_tilts(), {}};
  if (run.complete() && !options.force)
    if (auto stored = read_analysis(path); stored && stored->key == analysis_key(run, parameters)) {
      result.state = "analysis read from the file";
      result.analysis = std::move(*stored);
      return result;
    }
  AnalysisLine line(run.frame_count(), options.quiet);
  result.analysis =
      analyse_run(run, parameters, options.threads, [&line](std::size_t done) { line.show(done); });
  result.state = "analysis stored in the file";
  if (run.complete())
    store_analysis(path, result.analysis, hash_text(state_hash(run.checkpoint().world)));
  else
    result.state = "analysis not stored: the run is not complete";
  return result;
}

}  // namespace talus
