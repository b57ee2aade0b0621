/// Cost of the parts of an analysis for a frame, in processor time of one thread: the mean over frames
/// spread evenly through an analysed run, the smallest of several rounds. Prints a row of a Markdown table
/// for each part.

#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/deformation/deformation.h"
#include "analysis/frame_analysis.h"
#include "analysis/packing/packing.h"
#include "analysis/topology/topology.h"
#include "base/errors.h"
#include "io/run_file.h"
#include "processor_time.h"
#include "program.h"

namespace talus::bench {
namespace {

constexpr std::size_t sampled = 8;
constexpr int rounds = 5;

struct Sample {
  Frame stored, frame, before;  ///< `frame` with the gamma of neighbourhoods
  analysis::PersistenceDiagram network, network_before;
  analysis::FrameRecord record;
};

Sample sample_of(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k) {
  const RunStatics& statics = run.header().statics;
  Sample sample;
  sample.stored = run.frame(k);
  sample.frame = analysis::with_analysed_gamma(sample.stored, statics, parameters);
  sample.before = run.frame(k - 1);
  sample.network = analysis::force_persistence({sample.frame, statics}, 1.0);
  sample.network_before = analysis::force_persistence({sample.before, statics}, 1.0);
  return sample;
}

int measure(int argc, char** argv) {
  if (argc != 2) throw Error(ExitCode::usage, "expected the path of a run");
  const io::RunFile run = io::RunFile::open(argv[1]);
  const RunStatics& statics = run.header().statics;
  const analysis::AnalysisParameters parameters;
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(0.35);
  const analysis::Analysis analysis = analysis::begin_analysis(statics, parameters, theta_c);
  std::vector<std::size_t> numbers;
  std::vector<Sample> samples;
  for (std::size_t s = 1; s <= sampled; ++s) {
    numbers.push_back(s * (run.frame_count() - 1) / sampled);
    samples.push_back(sample_of(run, parameters, numbers.back()));
  }
  const double largest = analysis.correlation_distance.back() + analysis.correlation_distance.front();
  const auto row = [&](const char* part, const std::function<void(Sample&, std::size_t)>& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
      const double begin = processor_seconds();
      for (std::size_t s = 0; s < samples.size(); ++s) work(samples[s], numbers[s]);
      least = std::fmin(least, processor_seconds() - begin);
    }
    std::printf("| %s | %.2f |\n", part, 1e3 * least / static_cast<double>(samples.size()));
    std::fflush(stdout);
  };
  std::printf("| part | ms a frame |\n|---|--:|\n");
  row("frame read", [&](Sample&, std::size_t k) { (void)run.frame(k); });
  row("gamma of neighbourhoods", [&](Sample& sample, std::size_t) {
    (void)analysis::with_analysed_gamma(sample.stored, statics, parameters);
  });
  row("thresholds: l_c, clusters, directed paths", [&](Sample& sample, std::size_t) {
    (void)analysis::analyse_thresholds({sample.frame, statics}, parameters, analysis, 1.0);
  });
  row("correlations of forces, gamma and mean stress", [&](Sample& sample, std::size_t) {
    (void)analysis::force_correlation({sample.frame, statics}, largest, parameters.bins);
    (void)analysis::stress_ratio_correlation({sample.frame, statics}, largest, parameters.bins);
    (void)analysis::mean_stress_correlation({sample.frame, statics}, largest, parameters.bins);
  });
  row("local solid fraction", [&](Sample& sample, std::size_t) {
    analysis::measure_local_solid_fraction({sample.frame, statics}, sample.record);
  });
  row("granular temperature", [&](Sample& sample, std::size_t) {
    analysis::measure_granular_temperature({sample.frame, statics}, sample.record);
  });
  row("local deformation", [&](Sample& sample, std::size_t) {
    analysis::measure_deformation(sample.before, {sample.frame, statics}, sample.record);
  });
  row("rigid clusters", [&](Sample& sample, std::size_t) {
    analysis::measure_rigid_clusters({sample.frame, statics}, sample.record);
  });
  row("persistence", [&](Sample& sample, std::size_t) {
    (void)analysis::force_persistence({sample.frame, statics}, 1.0);
  });
  row("change of the network", [&](Sample& sample, std::size_t) {
    std::vector<analysis::FrameRecord> records(2);
    analysis::measure_network_changes({sample.network_before, sample.network}, statics.free_count, records);
  });
  row("all of a frame but reading and what it is compared with", [&](Sample& sample, std::size_t) {
    (void)analysis::analyse_frame(
        {analysis::with_analysed_gamma(sample.stored, statics, parameters), statics}, parameters, analysis);
  });
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  return talus::bench::run_program("analysis_bench", talus::bench::measure, argc, argv);
}
