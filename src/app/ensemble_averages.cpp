#include "app/ensemble_averages.h"

#include <filesystem>

#include "base/locked_file.h"
#include "ensemble/averages_file.h"
#include "io/durable_file.h"

namespace talus {
namespace {

NamedAverages averages_of_variant(const EnsembleView& view, std::size_t variant, KnownMembers& known) {
  const Variant& found = view.plan.variants[variant];
  const double spacing = found.scenario.output.frame_every;
  std::vector<MemberResult> members;
  ListAverages lists;
  for (std::size_t m = 0; m < view.plan.members.size(); ++m) {
    const Member& member = view.plan.members[m];
    if (member.variant != variant || view.states[m].stage != MemberStage::done) continue;
    const MemberResult& result = analysed_member(member, known);
    members.push_back({member.seed, result.numbers, result.series});
    add_member(lists, result.lists, number_called(result.numbers, "theta_c"), spacing);
  }
  return {found.name, read_text(found.scenario_file), averages_of(members, spacing), std::move(lists)};
}

void write_files(const std::filesystem::path& folder, const EnsembleView& view, KnownMembers& known) {
  std::vector<NamedAverages> variants;
  for (std::size_t v = 0; v < view.plan.variants.size(); ++v)
    variants.push_back(averages_of_variant(view, v, known));
  write_text((folder / "members.csv").string(), members_csv(view));
  write_text((folder / "averages.csv").string(), averages_csv(variants));
  write_averages((folder / "ensemble.h5").string(), std::move(variants), view.manifest.version);
}

}  // namespace

EnsembleView write_averages(const std::string& folder, KnownMembers& known) {
  const std::filesystem::path place = folder;
  read_ensemble(folder);  // before a file is made in what may be no ensemble
  EnsembleView view;
  while_locked((place / "averages.lock").string(), [&] {
    const EnsemblePlan plan = plan_of(read_ensemble(folder), folder);
    std::vector<MemberState> states = look_at_members(plan);
    look_for_damage(plan, states, known);
    for (std::size_t m = 0; m < states.size(); ++m)
      if (states[m].stage == MemberStage::done) analysed_member(plan.members[m], known);
    view = view_of_ensemble(folder, known);
    if (count_of(view.states, MemberStage::done) > 0) write_files(place, view, known);
  });
  return view;
}

}  // namespace talus
