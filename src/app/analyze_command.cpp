/// `talus analyze`: the multiscale analysis of whole runs, printed and stored in their files.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "app/analysis_report.h"
#include "app/commands.h"
#include "app/progress.h"
#include "core/hash.h"
#include "io/analysis_file.h"
#include "io/run_file.h"
#include "session/analysis_run.h"

namespace talus {
namespace {

struct AnalyzeArguments {
  std::vector<std::string> runs;
  std::vector<std::string> settings;
  int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 2u));
  bool json = false;
  bool force = false;
  bool quiet = false;
};

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

AnalysedRun analyse(const std::string& path, const AnalysisParameters& parameters,
                    const AnalyzeArguments& arguments) {
  const RunFile run = RunFile::open(path);
  AnalysedRun result{path, "", run.header().statics, run.frame_tilts(), {}};
  if (run.complete() && !arguments.force)
    if (auto stored = read_analysis(path); stored && stored->key == analysis_key(run, parameters)) {
      result.state = "analysis read from the file";
      result.analysis = std::move(*stored);
      return result;
    }
  AnalysisLine line(run.frame_count(), arguments.quiet);
  result.analysis =
      analyse_run(run, parameters, arguments.threads, [&line](std::size_t done) { line.show(done); });
  result.state = "analysis stored in the file";
  if (run.complete())
    store_analysis(path, result.analysis, hash_text(state_hash(run.checkpoint().world)));
  else
    result.state = "analysis not stored: the run is not complete";
  return result;
}

void analyze(const AnalyzeArguments& arguments) {
  const AnalysisParameters parameters = parse_analysis_settings(arguments.settings);
  if (arguments.json) std::printf("[");
  for (std::size_t r = 0; r < arguments.runs.size(); ++r) {
    const AnalysedRun run = analyse(arguments.runs[r], parameters, arguments);
    if (arguments.json)
      std::printf("%s%s", r > 0 ? ",\n" : "", analysis_json(run).c_str());
    else
      std::printf("%s%s", r > 0 ? "\n" : "", analysis_text(run).c_str());
    std::fflush(stdout);
  }
  if (arguments.json) std::printf("]\n");
}

}  // namespace

void add_analyze_command(CLI::App& app) {
  auto arguments = std::make_shared<AnalyzeArguments>();
  CLI::App* command = app.add_subcommand(
      "analyze", "Analyse stresses, overloaded grains and contacts of runs, and store it in their files");
  command
      ->add_option("runs", arguments->runs, "Run files; a run that is not complete is analysed, not stored")
      ->required();
  command
      ->add_option("--set", arguments->settings,
                   "Change a parameter of the analysis, e.g. --set lc_cut=30 (see docs/analysis.md)")
      ->allow_extra_args(false);
  command
      ->add_option("--threads", arguments->threads,
                   "Frames analysed side by side; the result does not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_flag("--force", arguments->force, "Compute again what is stored and valid");
  command->add_flag("--json", arguments->json,
                    "As a JSON list with all series of each run, in SI units and radians");
  command->add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command->callback([arguments] { analyze(*arguments); });
}

}  // namespace talus
