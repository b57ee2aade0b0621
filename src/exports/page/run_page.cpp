#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <utility>

#include "analysis/frame_analysis.h"
#include "analysis/packing/packing.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "base/version.h"
#include "core/trigonometry.h"
#include "exports/page/page_data.h"
#include "pictures/layers.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"

namespace talus::exports {
namespace {

std::string end_text(const PageRun& run) {
  const double theta_c = run.analysis.theta_c;
  if (std::isfinite(theta_c)) return fmt::format("until the slope failed at θ_c = {:.2f}°", degrees(theta_c));
  const auto [low, high] = std::ranges::minmax(run.file.frame_tilts());
  return fmt::format("between {}° and {}°; the slope has not failed", degrees_text(low, 2),
                     degrees_text(high, 2));
}

/// Returns the title, such as "A granular slope, tilted until it fails".
std::string page_title(const PageRun& run) {
  return std::isfinite(run.analysis.theta_c) ? "A granular slope, tilted until it fails"
                                             : "A granular slope, tilted";
}

/// Returns a description of the run and of the page, as rich text.
std::string page_sentence(const PageRun& run) {
  const RunStatics& statics = run.statics();
  const double diameter = statics.mean_diameter;
  return fmt::format(
      "A bed of {} rigid disks, {:.4g} mean diameters D long and {:.3g} D deep, {}, was tilted {}. Contact "
      "Dynamics computed how the grains move and press on each other.",
      statics.free_count, statics.length / diameter, statics.depth / diameter,
      statics.periodic ? "periodic along the slope" : "between two walls", end_text(run));
}

/// Returns names and values: seed, version, hash of the state; nothing about the machine.
Facts page_provenance(const PageRun& run) {
  const io::RunHeader& header = run.file.header();
  Facts facts = {{"seed", std::to_string(header.seed)}};
  // Information about the machine and its folders is left out.
  for (const char* name : {"version", "git_hash", "compiler", "start", "end"})
    if (const auto value = find_value(header.provenance, name); value && !value->empty())
      facts.emplace_back(name, *value);
  if (run.file.has_state())
    facts.emplace_back("hash of the last state", hash_text(state_hash(run.file.checkpoint().world)));
  facts.emplace_back("page written by", version_text());
  return facts;
}

Json facts_json(const Facts& facts) {
  Json list = Json::array();
  for (const auto& [name, value] : facts) list.push_back(Json::array({name, value}));
  return list;
}

/// Returns the template with each {{name}} replaced by value_of(name).
template <typename ValueOf>
std::string filled(std::string_view text, const ValueOf& value_of) {
  std::string result;
  for (auto open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
    const auto close = text.find("}}", open);
    result.append(text.substr(0, open)).append(value_of(text.substr(open + 2, close - open - 2)));
    text.remove_prefix(close + 2);
  }
  return result.append(text);
}

/// Returns JSON for a script element, which would end at "</"; invalid UTF-8 becomes U+FFFD.
std::string script_text(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

}  // namespace

std::string run_page(const io::RunFile& file, const std::string& path, const analysis::Analysis& analysis,
                     const std::vector<std::size_t>& frames, const Watch& watch) {
  const PageRun run = begin_page(file, analysis, frames);
  PageData data(run);
  for_each_frame(run, watch, [&](const auto&... frame) { data.add(frame...); });
  const std::string name = std::filesystem::path(path).stem().string();
  Json json = {{"name", name},
               {"title", page_title(run)},
               {"sentence", page_sentence(run)},
               {"theta_c", degrees(run.analysis.theta_c)},
               {"events", events_json(run)},
               {"curves", curves_json(run)},
               {"scenario", run.file.header().scenario_resolved},
               {"provenance", facts_json(page_provenance(run))},
               {"tables", Json::array()}};
  json.update(data.json());
  std::string tables;
  for (const auto& [id, table] : data.tables()) {
    json["tables"].push_back(
        {{"name", id}, {"rows", table.rows}, {"columns", table.columns}, {"bytes", table.bytes}});
    tables +=
        fmt::format("<script type=\"text/plain\" id=\"table-{}\">{}</script>\n", id, packed_text(table));
  }
  return filled(page_template(), [&](std::string_view part) -> std::string {
    if (part == "title") return xml_text(fmt::format("{}: {}", page_title(run), name));
    if (part == "style") return std::string(page_style());
    if (part == "script") return page_script();
    if (part == "data") return script_text(json);
    return tables;
  });
}

namespace {

/// Sets the angle that scales maps: that of repose, or of the given threshold.
void take_angle(pictures::MapSettings& settings, const analysis::Analysis& analysis) {
  if (std::isfinite(analysis.theta_c)) {
    settings.theta_c = analysis.theta_c;
  } else if (std::isfinite(analysis.gamma_c) && analysis.gamma_c < 1.0) {
    settings.theta_c = std::asin(analysis.gamma_c);
  } else {
    settings.theta_c = radians(pictures::assumed_theta_c);
    settings.theta_c_assumed = true;
  }
}

pictures::MapSettings settings_of(const analysis::Analysis& analysis,
                                  const analysis::AnalysisParameters& parameters) {
  pictures::MapSettings settings;
  take_angle(settings, analysis);
  // With an explicit Gamma_c, the first threshold is another multiple of sin(theta_c).
  if (!analysis.thresholds.empty())
    settings.threshold_factor = std::isfinite(analysis.theta_c) && parameters.gamma_c
                                    ? analysis.thresholds.front().gamma / sine(settings.theta_c)
                                    : analysis.thresholds.front().factor;
  settings.l_min = parameters.l_min;
  settings.joined_by_neighbours = parameters.joining == analysis::Joining::neighbours;
  return settings;
}

std::vector<float> lengths_of(const PageRun& run, const BedFrame& bed, std::size_t k) {
  if (!run.has_threshold()) return {};
  if (k < run.analysis.frames.size()) return run.analysis.frames[k].thresholds.front().lc;
  return analysis::analyse_thresholds(bed, run.parameters, run.analysis, analysis::frame_volume(bed))
      .front()
      .lc;
}

}  // namespace

bool PageRun::shows(pictures::MapKind kind) const {
  if (kind == pictures::MapKind::overloaded || kind == pictures::MapKind::clusters) return has_threshold();
  return kind != pictures::MapKind::coarse || settings.length * statics().mean_diameter <= statics().length;
}

PageRun begin_page(const io::RunFile& file, const analysis::Analysis& analysis,
                   std::vector<std::size_t> frames) {
  const analysis::AnalysisParameters parameters = runs::from_facts(analysis.parameters);
  PageRun run{file, analysis, std::move(frames), parameters, settings_of(analysis, parameters), {}};
  run.extent = pictures::bed_extent(run.statics());
  pictures::MotionSample sample({pictures::MapKind::displacement, pictures::MapKind::rotation});
  Frame before;
  for (std::size_t k = 0; k < file.all_frame_tilts().size(); ++k) {
    Frame frame = file.frame(k);
    const BedFrame bed{frame, run.statics()};
    pictures::extend(run.extent, bed);
    if (k > 0 && std::ranges::binary_search(run.frames, k)) sample.add({bed, &before, !file.goes_by_time()});
    before = std::move(frame);
  }
  run.settings.motion = sample.ranges();
  return run;
}

void for_each_frame(const PageRun& run, const Watch& watch, const UseFrame& use) {
  pictures::SeenFrames seen;
  seen.rule = run.settings;
  Frame before;
  std::size_t column = 0;
  for (std::size_t k = 0; column < run.frames.size(); ++k) {
    if (watch.stopped && watch.stopped())
      throw Error(ExitCode::stopped, "stopped before the page was complete; repeat the command");
    Frame frame = runs::analysed_frame(run.file, run.parameters, k);
    const BedFrame bed{frame, run.statics()};
    const analysis::Clusters clusters =
        run.has_threshold() ? pictures::overloaded_clusters(bed, run.settings) : analysis::Clusters();
    seen.instants.push_back({frame.step, frame.time, frame.tilt});
    seen.cluster_colours.push_back(seen.tracker.next(clusters));
    if (run.frames[column] == k) {
      use({bed, k > 0 ? &before : nullptr, !run.file.goes_by_time(), k}, seen, clusters,
          lengths_of(run, bed, k));
      ++column;
      if (watch.progress) watch.progress(column, run.frames.size());
    }
    before = std::move(frame);
  }
}

}  // namespace talus::exports
