#include "app/ensemble_averages.h"

#include <filesystem>

#include "app/analysed_run.h"
#include "core/descriptor.h"
#include "core/locked_file.h"
#include "ensemble/averages_file.h"
#include "ensemble/kept_runs.h"
#include "ensemble/member_series.h"
#include "io/durable_file.h"
#include "io/run_store.h"
#include "scenario/text.h"
#include "session/analysis_parameters.h"

namespace talus {
namespace {

/// The series of a member that is done: read from the table beside its run, or made from the run and its
/// analysis where there is none, and kept.
MemberSeries series_of_member(const Member& member) {
  const std::string path = series_path(member.path);
  if (std::filesystem::exists(path)) return parse_series(read_text(path), path);
  if (run_presence(member.path) == RunPresence::none) refuse_missing_series(member);
  const AnalysedRun analysed =
      analysed_run(member.path, parse_analysis_settings({}), {.threads = 1, .quiet = true});
  MemberSeries series = member_series(analysed.analysis, analysed.statics.mean_diameter);
  write_text(path, series_csv(series));
  return series;
}

NamedAverages averages_of_variant(const EnsembleView& view, std::size_t variant) {
  std::vector<MemberResult> members;
  for (std::size_t m = 0; m < view.plan.members.size(); ++m) {
    const Member& member = view.plan.members[m];
    if (member.variant == variant && view.states[m].stage == MemberStage::done)
      members.push_back({member.seed, view.numbers[m], series_of_member(member)});
  }
  const Variant& found = view.plan.variants[variant];
  return {found.name, read_text(found.scenario_file),
          averages_of(members, found.scenario.output.frame_every)};
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

EnsembleView write_averages(const std::string& folder) {
  const std::filesystem::path place = folder;
  const std::string lock_path = (place / "averages.lock").string();
  read_ensemble(folder);  // before a file is made in what may be no ensemble
  const Descriptor lock = create_locked_when_free(lock_path);
  EnsembleView view = view_of_ensemble(folder);
  if (count_of(view.states, MemberStage::done) > 0) write_files(place, view);
  remove_file(lock_path);
  return view;
}

}  // namespace talus
