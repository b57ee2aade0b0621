#include "app/ensemble_averages.h"

#include <filesystem>

#include "app/perturbed_run.h"
#include "core/locked_file.h"
#include "core/paths.h"
#include "ensemble/averages_file.h"
#include "ensemble/kept_runs.h"
#include "ensemble/member_lists.h"
#include "ensemble/member_series.h"
#include "ensemble/pool.h"
#include "io/durable_file.h"
#include "io/run_store.h"
#include "runs/analysis_parameters.h"
#include "scenario/text.h"

namespace talus {
namespace {

/// Makes the tables of a member that is done from its run and analysis where one of them is not there, as
/// of an ensemble of an earlier Talus. Without the run there may be no lists. Returns its numbers then.
MemberNumbers complete_tables(const Member& member, const MemberNumbers& known) {
  const bool series = is_there(series_path(member.path));
  if (series && is_there(lists_path(member.path))) return known;
  if (run_presence(member.path) == RunPresence::none) {
    if (!series) refuse_missing_series(member);
    return known;
  }
  is_complete(member);  // its own run
  const RunView analysed = analysed_run(member.path, parse_analysis_settings({}), {.threads = 1});
  write_tables(member.path, analysed);
  return write_numbers(member, analysed);
}

NamedAverages averages_of_variant(const EnsembleView& view, std::size_t variant) {
  const Variant& found = view.plan.variants[variant];
  const double spacing = found.scenario.output.frame_every;
  std::vector<MemberResult> members;
  ListAverages lists;
  for (std::size_t m = 0; m < view.plan.members.size(); ++m) {
    const Member& member = view.plan.members[m];
    if (member.variant != variant || view.states[m].stage != MemberStage::done) continue;
    const MemberNumbers numbers = complete_tables(member, view.numbers[m]);
    const std::string series = series_path(member.path), file = lists_path(member.path);
    require_own_file(member, numbers, series_ending);
    members.push_back({member.seed, numbers, parse_series(read_text(series), series)});
    if (!is_there(file)) continue;
    require_own_file(member, numbers, lists_ending);
    add_member(lists, read_lists(file), number_called(numbers, "theta_c"), spacing);
  }
  return {found.name, read_text(found.scenario_file), averages_of(members, spacing), std::move(lists)};
}

void write_files(const std::filesystem::path& folder, const EnsembleView& view) {
  std::vector<NamedAverages> variants;
  for (std::size_t v = 0; v < view.plan.variants.size(); ++v)
    variants.push_back(averages_of_variant(view, v));
  write_text((folder / "members.csv").string(), members_csv(view));
  write_text((folder / "averages.csv").string(), averages_csv(variants));
  write_averages((folder / "ensemble.h5").string(), std::move(variants), view.manifest.version);
}

}  // namespace

void write_tables(const std::string& run, const RunView& analysed) {
  const double mean_diameter = analysed.statics.mean_diameter;
  write_lists(lists_path(run), member_lists(analysed.analysis, mean_diameter));
  write_text(series_path(run), series_csv(member_series(analysed.analysis, mean_diameter)));
}

MemberNumbers write_numbers(const Member& member, const RunView& analysed) {
  MemberNumbers numbers = member_numbers(*analysed.file, analysed.analysis);
  sign(numbers, member, {series_ending, lists_ending, trials_ending});
  write_text(numbers_path(member.path), numbers_csv(numbers));
  return numbers;
}

EnsembleView write_averages(const std::string& folder) {
  const std::filesystem::path place = folder;
  read_ensemble(folder);  // before a file is made in what may be no ensemble
  EnsembleView view;
  while_locked((place / "averages.lock").string(), [&] {
    view = view_of_ensemble(folder);
    if (count_of(view.states, MemberStage::done) > 0) write_files(place, view);
  });
  return view;
}

}  // namespace talus
