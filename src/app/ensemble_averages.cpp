#include "app/ensemble_averages.h"

#include <filesystem>

#include "base/locked_file.h"
#include "ensemble/averages_file.h"
#include "io/durable_file.h"

namespace talus::app {
namespace {

ensemble::NamedAverages averages_of_variant(const EnsembleView& view, std::size_t variant,
                                            ensemble::KnownMembers& known) {
  const ensemble::Variant& found = view.plan.variants[variant];
  const double spacing = found.scenario.output.frame_every;
  std::vector<ensemble::MemberResult> members;
  ensemble::ListAverages lists;
  for (std::size_t m = 0; m < view.plan.members.size(); ++m) {
    const ensemble::Member& member = view.plan.members[m];
    if (member.variant != variant || view.states[m].stage != ensemble::MemberStage::done) continue;
    const ensemble::MemberResult& result = ensemble::analysed_member(member, known);
    members.push_back({member.seed, result.numbers, result.series});
    ensemble::add_member(lists, result.lists, ensemble::number_called(result.numbers, "theta_c"), spacing);
  }
  return {found.name, io::read_text(found.scenario_file), ensemble::averages_of(members, spacing),
          std::move(lists)};
}

void write_files(const std::filesystem::path& folder, const EnsembleView& view,
                 ensemble::KnownMembers& known) {
  std::vector<ensemble::NamedAverages> variants;
  for (std::size_t v = 0; v < view.plan.variants.size(); ++v)
    variants.push_back(averages_of_variant(view, v, known));
  io::write_text((folder / "members.csv").string(), members_csv(view));
  io::write_text((folder / "averages.csv").string(), ensemble::averages_csv(variants));
  ensemble::write_averages((folder / "ensemble.h5").string(), std::move(variants), view.manifest.version);
}

}  // namespace

EnsembleView write_averages(const std::string& folder, ensemble::KnownMembers& known) {
  const std::filesystem::path place = folder;
  ensemble::read_ensemble(folder);  // refuses a folder without an ensemble before a file is created in it
  EnsembleView view;
  while_locked((place / "averages.lock").string(), [&] {
    const ensemble::EnsemblePlan plan = ensemble::plan_of(ensemble::read_ensemble(folder), folder);
    std::vector<ensemble::MemberState> states = ensemble::scan_members(plan);
    ensemble::find_damage(plan, states, known);
    for (std::size_t m = 0; m < states.size(); ++m)
      if (states[m].stage == ensemble::MemberStage::done) ensemble::analysed_member(plan.members[m], known);
    view = view_of_ensemble(folder, known);
    if (ensemble::count_of(view.states, ensemble::MemberStage::done) > 0) write_files(place, view, known);
  });
  return view;
}

}  // namespace talus::app
