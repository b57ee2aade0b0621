#include "session/perturbation_table.h"

#include <charconv>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text_stream.h"
#include "base/visible_text.h"
#include "core/snapshot.h"
#include "scenario/text.h"

namespace talus::session {
namespace {

bool read_number(std::string_view text, auto& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::string patch_text(const SurfacePatch& patch) {
  return fmt::format("{}x{}", scenario::short_text(patch.width), scenario::short_text(patch.depth));
}

std::optional<SurfacePatch> parse_patch(const std::string& text) {
  const std::size_t cross = text.find('x');
  SurfacePatch patch;
  if (cross == std::string::npos || !read_number(std::string_view(text).substr(0, cross), patch.width) ||
      !read_number(std::string_view(text).substr(cross + 1), patch.depth))
    return std::nullopt;
  const bool usable = patch.width > 0.0 && patch.width < 1e6 && patch.depth > 0.0 && patch.depth < 1e6;
  return usable ? std::optional(patch) : std::nullopt;
}

std::string plan_text(const PerturbationPlan& plan) {
  return fmt::format("--from {} --every {} --patch {}", scenario::short_text(plan.first),
                     scenario::short_text(plan.every), patch_text(plan.patch));
}

std::optional<PerturbationPlan> parse_plan(const std::string& text) {
  std::istringstream words = text_stream(text);
  std::string option, first, every, patch;
  words >> option >> first >> option >> every >> option >> patch;
  PerturbationPlan plan;
  const std::optional<SurfacePatch> found = parse_patch(patch);
  if (!found || !read_number(first, plan.first) || !read_number(every, plan.every)) return std::nullopt;
  plan.patch = *found;
  const bool in_range = plan.first >= 0.0 && plan.first <= PerturbationPlan::highest &&
                        plan.every >= PerturbationPlan::min_every && plan.every <= PerturbationPlan::highest;
  if (!in_range || plan_text(plan) != text) return std::nullopt;
  return plan;
}

std::vector<TrialRow> rows_of(const PerturbedState& state, std::int64_t step) {
  std::vector<TrialRow> rows;
  for (const Trial& trial : state.trials)
    rows.push_back({static_cast<double>(step), state.tilt, trial.strength, trial.energy,
                    static_cast<double>(trial.end), trial.time, static_cast<double>(trial.moved),
                    trial.displacement});
  return rows;
}

PerturbationTable table_of(const io::RunFile& run, const PerturbationPlan& plan, const std::string& path) {
  const std::string found = find_value(run.header().provenance, trials_fact).value_or("none");
  if (found != plan_text(plan))
    throw Error(ExitCode::bad_data,
                fmt::format("{} has the trials '{}', expected '{}'; use another folder, or remove the run",
                            path, visible_word(found, 120), plan_text(plan)));
  PerturbationTable table{plan, {}};
  for (const TrialRow& row : run.trials()) {
    const double tilt = at(row, TrialField::tilt), end = at(row, TrialField::end);
    if (end != 0.0 && end != 1.0 && end != 2.0)
      throw Error(ExitCode::bad_data, path + ": /trials/end holds a value other than 0, 1 and 2");
    if (table.states.empty() || table.states.back().tilt != tilt) table.states.push_back({tilt, {}});
    table.states.back().trials.push_back(
        {at(row, TrialField::velocity), at(row, TrialField::energy),
         static_cast<TrialEnd>(static_cast<int>(end)), at(row, TrialField::time),
         static_cast<Index>(at(row, TrialField::moved)), at(row, TrialField::displacement)});
  }
  return table;
}

}  // namespace talus::session
