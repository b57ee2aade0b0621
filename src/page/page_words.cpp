#include "page/page_words.h"

#include <cmath>
#include <fmt/core.h>

#include "core/hash.h"
#include "core/trigonometry.h"
#include "core/version.h"

namespace talus {
namespace {

std::string end_text(const PageRun& run) {
  const double theta_c = run.analysis.theta_c;
  if (std::isfinite(theta_c)) return fmt::format("until the slope failed at θ_c = {:.2f}°", degrees(theta_c));
  return fmt::format("to {:.2f}°; the slope has not failed", degrees(run.file.frame_tilts().back()));
}

}  // namespace

std::string page_title(const PageRun& run) {
  return std::isfinite(run.analysis.theta_c) ? "A granular slope, tilted until it fails"
                                             : "A granular slope, tilted";
}

std::string page_sentence(const PageRun& run) {
  const RunStatics& statics = run.statics();
  const double diameter = statics.mean_diameter;
  return fmt::format(
      "A bed of {} rigid disks, {:.4g} mean diameters D long and {:.3g} D deep, {}, was tilted {}. Contact "
      "Dynamics "
      "computed how the grains move and press on each other.",
      statics.free_count, statics.length / diameter, statics.depth / diameter,
      statics.periodic ? "periodic along the slope" : "between two walls", end_text(run));
}

Facts page_provenance(const PageRun& run) {
  const RunHeader& header = run.file.header();
  Facts facts = {{"seed", std::to_string(header.seed)}};
  // What tells of the machine and its folders stays there.
  for (const char* name : {"version", "git_hash", "compiler", "start", "end"})
    if (const auto value = find_value(header.provenance, name); value && !value->empty())
      facts.emplace_back(name, *value);
  if (run.file.has_state())
    facts.emplace_back("hash of the last state", hash_text(state_hash(run.file.checkpoint().world)));
  facts.emplace_back("page written by", version_text());
  return facts;
}

}  // namespace talus
