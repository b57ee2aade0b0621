/// `talus analyze`: multiscale analysis of complete runs, printed and stored in their files.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <initializer_list>
#include <memory>

#include "analysis/failure/transition.h"
#include "app/analysis_report.h"
#include "app/commands.h"
#include "app/json.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "io/run_schema.h"
#include "pictures/frame_choice.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

std::string degree_text(double angle) { return degrees_text(angle, 2); }

/// Returns the frames of the table: those at round angles or, if the tilt goes up and down, a few at equal
/// intervals; the first, the last and the one at repose.
pictures::FrameChoice shown_frames(const std::vector<double>& tilts, double theta_c) {
  constexpr std::size_t max_intervals = 12;
  constexpr std::array spacings = {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};  // deg
  const std::size_t last = tilts.size() - 1;
  pictures::FrameChoice frames;
  if (std::ranges::is_sorted(tilts) && tilts.front() >= 0.0) {
    const double range = degrees(tilts.back() - tilts.front());
    const auto spacing =
        std::ranges::find_if(spacings, [&](double each) { return range <= each * max_intervals; });
    frames = pictures::frames_every(tilts, spacing == spacings.end() ? 10.0 : *spacing);
  }
  if (frames.empty() || frames.size() > 2 * max_intervals) {
    frames.clear();
    for (std::size_t k = 1; k < max_intervals; ++k) frames.push_back(k * last / max_intervals);
  }
  frames.insert(frames.end(), {0, last});
  if (std::isfinite(theta_c)) frames.push_back(pictures::frame_at_repose(tilts, theta_c));
  std::ranges::sort(frames);
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

/// Returns the indices of the thresholds that a grain reaches in some frame.
std::vector<std::size_t> reached_thresholds(const analysis::Analysis& analysis) {
  std::vector<std::size_t> reached;
  for (std::size_t t = 0; t < analysis.thresholds.size(); ++t)
    if (std::ranges::any_of(analysis.frames, [t](const analysis::FrameRecord& frame) {
          return frame.thresholds[t].overloaded_fraction > 0.0;
        }))
      reached.push_back(t);
  return reached;
}

std::string heading(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  const double theta_c = analysis.theta_c, gamma_c = analysis.gamma_c;
  const std::vector<analysis::FrameRecord>& frames = analysis.frames;
  const auto [lowest, highest] = std::ranges::minmax_element(frames, {}, &analysis::FrameRecord::tilt);
  std::string text =
      fmt::format("{}  ({})\n{}, {} to {} deg; ", run.path, run.kept, counted(frames.size(), "frame"),
                  degree_text(lowest->tilt), degree_text(highest->tilt));
  if (const analysis::FramesOfRise rise = analysis::last_rise(frames); rise.frames.size() < frames.size())
    text += fmt::format("theta_c, theta_d and the first slide refer to the last rise, from {} deg; ",
                        degree_text(frames[rise.first].tilt));
  text += std::isnan(theta_c) ? "the slope has not failed"
                              : fmt::format("theta_c = {} deg", degree_text(theta_c));
  if (std::isnan(gamma_c))
    return text + ": overloaded grains need a threshold; set one with --set gamma_c=0.3\n";
  const double diameter = run.statics.mean_diameter;
  const double l_min = runs::from_facts(analysis.parameters).l_min;
  text += fmt::format("; Gamma_c = {:.4f}; l_c cut at {:.4g} D\n", gamma_c, analysis.lc_cut / diameter);
  return text +
         (l_min > 0.0
              ? fmt::format("gamma of each grain together with its neighbours within {:.4g} D\n", 0.5 * l_min)
              : std::string("gamma of single grains\n"));
}

std::string span_text(const analysis::FrameThreshold& at) {
  const bool depth = at.spans_depth != 0, length = at.spans_length != 0;
  return std::string(depth ? "H" : "") + (length ? "L" : depth ? "" : "-");
}

TextTable series_table(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  const std::vector<std::size_t> reached = reached_thresholds(analysis);
  const bool failed = std::isfinite(analysis.theta_c);
  std::vector<double> tilts;
  for (const analysis::FrameRecord& frame : analysis.frames) tilts.push_back(frame.tilt);
  const std::size_t repose = failed ? pictures::frame_at_repose(tilts, analysis.theta_c) : tilts.size();
  TextTable table{{{"theta", true}, {"Gamma", true}, {"sT/sN", true}, {"z", true}, {"dV/V (%)", true}}, {}};
  for (const std::size_t t : reached) {
    const analysis::RunThreshold& threshold = analysis.thresholds[t];
    const std::string limit =
        fmt::format("gamma >= {:.4g} Gamma_c = {:.4f}", threshold.factor, threshold.gamma);
    table.columns.push_back({"p_o", true, "", limit});
    for (const char* title : {"mean", "max", "largest", "spans"}) table.columns.push_back({title, true});
  }
  if (failed) table.columns.push_back({"", false});
  for (const std::size_t k : shown_frames(tilts, analysis.theta_c)) {
    const analysis::FrameRecord& frame = analysis.frames[k];
    auto& row = table.rows.emplace_back();
    row = {{degree_text(frame.tilt)},
           {number_cell("{:.4f}", frame.stress_ratio)},
           {number_cell("{:.4f}", frame.sigma_t_over_n)},
           {number_cell("{:.3f}", frame.coordination_number)},
           {number_cell("{:+.4f}", 100.0 * frame.volume_strain)}};
    const double diameter = run.statics.mean_diameter;
    for (const std::size_t t : reached) {
      const analysis::FrameThreshold& at = frame.thresholds[t];
      row.insert(row.end(), {{number_cell("{:.3f}", at.overloaded_fraction)},
                             {number_cell("{:.2f}", at.lc_mean / diameter)},
                             {number_cell("{:.1f}", at.lc_max / diameter)},
                             {number_cell("{:.3f}", at.largest_share)},
                             {span_text(at)}});
    }
    if (failed) row.push_back({k == repose ? "at repose" : k > repose ? "after failure" : ""});
  }
  return table;
}

/// Returns "8.25 ± 0.25 deg", or "<= 0.00 deg" if no frame precedes the angle.
std::string onset_text(double angle, double error) {
  if (std::isnan(angle)) return "none";
  if (std::isnan(error)) return fmt::format("<= {} deg", degree_text(angle));
  return fmt::format("{} ± {} deg", degree_text(angle), degree_text(error));
}

std::string line(const std::string& name, const std::initializer_list<std::string> texts) {
  std::string text = fmt::format("  {:<34}", name);
  for (const std::string& each : texts) text += fmt::format("{:<24}", each);
  return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string dilation_text(const analysis::Analysis& analysis, std::size_t s) {
  const double angle = analysis.dilation[s];
  if (std::isnan(angle)) return "none";
  return fmt::format("{} deg, {} to {}", degree_text(angle), degree_text(analysis.dilation_low[s]),
                     degree_text(analysis.dilation_high[s]));
}

std::string first_slide_text(const analysis::Analysis& analysis) {
  const double angle = analysis.first_slide;
  if (std::isnan(angle)) return "none";
  const bool late = angle > analysis.theta_c;
  return degree_text(angle) + " deg" +
         (late ? ", after theta_c: tilting continued while the flow that began there gathered speed" : "");
}

std::string transition_table(const runs::RunView& run) {
  const analysis::Analysis& analysis = run.analysis;
  std::string text = line("first slide of the surface layer", {first_slide_text(analysis)}) + "theta_d by\n";
  for (const std::size_t t : reached_thresholds(analysis)) {
    const analysis::RunThreshold& threshold = analysis.thresholds[t];
    const std::string at = fmt::format(", {:.4g} Gamma_c", threshold.factor);
    const double size = threshold.lc_jump_size / run.statics.mean_diameter;
    text += line("jump of l_c max" + at, {onset_text(threshold.lc_jump, threshold.lc_jump_error),
                                          std::isnan(size) ? "" : fmt::format("by {:.1f} D", size)});
    text += line("percolation" + at, {onset_text(threshold.percolation, threshold.percolation_error)});
  }
  return text + line("dilation, volume", {dilation_text(analysis, 0)}) +
         line("dilation, centre of mass", {dilation_text(analysis, 1)});
}

}  // namespace

std::string beyond_repose(double theta_c, double tilt) {
  if (!(degrees(tilt - theta_c) > 1.0)) return "";
  return fmt::format(
      "; tilting continued to {} deg while this flow gathered speed, so the first slide may come after "
      "theta_c (for a smaller difference, lower tilt.rate)",
      degree_text(tilt));
}

std::string analysis_text(const runs::RunView& run) {
  const std::vector<analysis::RunThreshold>& thresholds = run.analysis.thresholds;
  const std::vector<std::size_t> reached = reached_thresholds(run.analysis);
  std::string notes;
  if (!reached.empty())
    notes =
        "l_c in D; largest: share of the overloaded grains in the largest cluster; spans: H from floor to "
        "surface, L along the bed\n";
  for (std::size_t t = 0; t < thresholds.size(); ++t)
    if (std::ranges::find(reached, t) == reached.end())
      notes += fmt::format("no grain reaches {:.4g} Gamma_c = {:.4f}{}\n", thresholds[t].factor,
                           thresholds[t].gamma,
                           thresholds[t].gamma > 1.0 ? "; gamma under compression is at most 1" : "");
  return fmt::format("{}\n{}{}\n{}{}", heading(run), aligned_text(series_table(run), 1), notes,
                     transition_table(run), event_summary(run));
}

namespace {

bool is_of_grains(const analysis::Quantity& quantity) {
  return quantity.shape.find('N') != std::string::npos;
}

/// Nests numbers into lists; `extents` are the sizes, outermost first, empty for a number.
template <typename T>
Json nested(std::span<const T> numbers, std::span<const std::uint64_t> extents) {
  if (extents.empty()) return numbers[0];
  Json list = Json::array();
  const std::size_t width = extents[0] > 0 ? numbers.size() / extents[0] : 0;
  for (std::size_t i = 0; i < extents[0]; ++i)
    list.push_back(nested(numbers.subspan(i * width, width), extents.subspan(1)));
  return list;
}

Json values_json(const analysis::Quantity& quantity, const analysis::Analysis& analysis) {
  const auto extents = io::dimensions(io::data_set_of(quantity), io::sizes_of(analysis));
  return std::visit(
      [&](const auto& array) { return nested(std::span(array), std::span<const std::uint64_t>(extents)); },
      analysis::values_of(quantity, analysis));
}

}  // namespace

std::string analysis_json(const runs::RunView& run, std::span<const analysis::Quantity> table) {
  const analysis::Analysis& analysis = run.analysis;
  Json json = {{"path", run.path},
               {"state", run.kept},
               {"key", analysis.key},
               {"mean_diameter", run.statics.mean_diameter},
               {"parameters", object_of(analysis.parameters)},
               {"tilt", Json::array()}};
  for (const analysis::FrameRecord& frame : analysis.frames) json["tilt"].push_back(frame.tilt);
  for (const analysis::Quantity& quantity : table)
    if (io::is_present(quantity, analysis) && !is_of_grains(quantity))
      json[quantity.name] = values_json(quantity, analysis);
  return json_text(json);
}

namespace {

struct AnalyzeArguments {
  std::vector<std::string> runs;
  std::vector<std::string> settings;
  runs::AnalysisOptions options;
  bool json = false;
  bool quiet = false;
};

void analyze(const AnalyzeArguments& arguments) {
  const analysis::AnalysisParameters parameters = runs::parse_analysis_settings(arguments.settings);
  const std::vector<std::string> runs = with_members(runs_among(arguments.runs));
  runs::AnalysisOptions options = arguments.options;
  options.progress = count_shown("analysis", arguments.quiet);
  if (arguments.json) print("[");
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const runs::RunView run = runs::analysed_run(runs[r], parameters, options);
    if (arguments.json)
      print("{}{}", r > 0 ? ",\n" : "", analysis_json(run));
    else
      print("{}{}", r > 0 ? "\n" : "", analysis_text(run));
    std::fflush(stdout);
  }
  if (arguments.json) print("]\n");
}

}  // namespace

void add_analyze_command(CLI::App& app) {
  auto arguments = std::make_shared<AnalyzeArguments>();
  CLI::App* command = app.add_subcommand(
      "analyze",
      "Analyse stresses, overloaded grains and contacts of runs, and store the results in their files");
  command
      ->add_option(
          "RUNS", arguments->runs,
          "Run files, or folders of ensembles; the analysis of an incomplete run is printed but not stored")
      ->required();
  add_analysis_settings(*command, arguments->settings);
  add_threads_option(*command, arguments->options.threads, "Frames analysed in parallel");
  command->add_flag("--force", arguments->options.force,
                    "Recompute the analysis even if a valid one is stored");
  command->add_flag("--json", arguments->json,
                    "Print a JSON list with all series of each run, in SI units and radians");
  command->add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command->callback([arguments] { analyze(*arguments); });
}

}  // namespace talus::app
