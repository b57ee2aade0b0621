/// Cost of making a run durable: commits of the paper's bed, without and with a frame, in the folder
/// of the beds and in memory; packing, opening and reading the run.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "beds.h"
#include "io/run_file.h"
#include "io/run_store.h"
#include "session/run_header.h"

namespace talus::bench {
namespace {

constexpr Index grains = 8000;

/// Returns the bed after the first step of its tilt, with a recorded frame.
const session::Session& tilted() {
  static const session::Session session = [] {
    session::Session begun = session_at_tilt(grains);
    while (begun.segment().frames.empty()) begun.advance();
    return begun;
  }();
  return session;
}

io::RunStore new_store(const std::string& path) {
  return io::RunStore::create(path, session::run_header(tilted(), session::RunOrigin{}), true);
}

std::string run_path(const char* folder) { return std::string(folder) + "/store_bench.h5"; }

/// Commits a checkpoint, or a checkpoint with a frame, for which a run has to wait.
void commit(benchmark::State& state, const char* folder, bool with_frame) {
  const std::string path = run_path(folder);
  io::Segment segment = tilted().segment();
  if (!with_frame) segment.frames.clear();
  {
    io::RunStore store = new_store(path);
    for (auto _ : state) store.commit(segment, tilted().checkpoint(0.0));
  }
  std::filesystem::remove_all(io::run_folder(path));
}

constexpr int frames = 20;

void pack(benchmark::State& state) {
  const std::string path = run_path(TALUS_BENCH_BEDS);
  for (auto _ : state) {
    state.PauseTiming();
    io::RunStore store = new_store(path);
    for (int k = 0; k < frames; ++k) store.commit(tilted().segment(), tilted().checkpoint(0.0));
    state.ResumeTiming();
    store.pack();
  }
}

/// Opens the run that `pack` has left.
void open_run(benchmark::State& state) {
  for (auto _ : state)
    benchmark::DoNotOptimize(io::RunFile::open(run_path(TALUS_BENCH_BEDS)).frame_tilts().size());
}
void read_frames(benchmark::State& state) {
  const io::RunFile run = io::RunFile::open(run_path(TALUS_BENCH_BEDS));
  for (auto _ : state)
    for (std::size_t k = 0; k < frames; ++k) benchmark::DoNotOptimize(run.frame(k));
}

void slowest(benchmark::internal::Benchmark* measured) {
  measured->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->Iterations(1)
      ->Repetitions(40)
      ->ReportAggregatesOnly()
      ->ComputeStatistics("max", [](const std::vector<double>& times) {
        return *std::max_element(times.begin(), times.end());
      });
}

BENCHMARK_CAPTURE(commit, checkpoint_on_disk, TALUS_BENCH_BEDS, false)->Apply(slowest);
BENCHMARK_CAPTURE(commit, frame_on_disk, TALUS_BENCH_BEDS, true)->Apply(slowest);
BENCHMARK_CAPTURE(commit, checkpoint_in_memory, "/dev/shm", false)->Apply(slowest);
BENCHMARK_CAPTURE(commit, frame_in_memory, "/dev/shm", true)->Apply(slowest);
BENCHMARK(pack)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1)
    ->Repetitions(5)
    ->ReportAggregatesOnly();
BENCHMARK(open_run)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(read_frames)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace talus::bench
