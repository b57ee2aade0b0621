#include "app/ensemble_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>

#include "base/locked_file.h"
#include "base/text.h"
#include "core/statistics.h"
#include "ensemble/averages.h"
#include "ensemble/member_results.h"
#include "ensemble/member_state.h"
#include "io/durable_file.h"
#include "scenario/keys.h"

namespace talus::app {
namespace {

/// Quantities shown in reports, out of those in members.csv.
constexpr std::array<const char*, 6> shown_quantities = {
    "theta_c", "first_slide", "theta_d/lc_jump", "theta_d/percolation", "theta_d/dilation", "theta_r"};

constexpr std::array<const char*, 4> stage_names = {"waiting", "claimed", "failed", "done"};

std::vector<double> values_of(const EnsembleView& view, std::size_t variant, const std::string& quantity) {
  std::vector<double> values;
  for (std::size_t m = 0; m < view.plan.members.size(); ++m)
    if (view.plan.members[m].variant == variant && view.states[m].stage == ensemble::MemberStage::done)
      values.push_back(ensemble::number_called(view.numbers[m], quantity));
  return values;
}

std::string unit_of(const EnsembleView& view, const std::string& quantity) {
  const bool is_known = std::ranges::any_of(view.numbers, [&](const ensemble::MemberNumbers& member) {
    return find_value(member.numbers, quantity).has_value();
  });
  return is_known ? ensemble::unit_of_number(quantity) : "";
}

/// Returns "  theta_c = 19.41 ± 0.28 deg, standard deviation 0.80, 8 of 8"; empty if no member has it.
std::string mean_line(const EnsembleView& view, std::size_t variant, const std::string& quantity) {
  const std::vector<double> values = values_of(view, variant, quantity);
  const Statistics found = statistics_of(values);
  if (found.count == 0) return "";
  const bool has_error = found.count > 1 && found.error > 0.0;
  const std::string value =
      has_error ? ensemble::plus_minus(found.mean, found.error) : fmt::format("{:.4g}", found.mean);
  const std::string spread =
      has_error ? fmt::format(", standard deviation {:.2g}", found.deviation) : std::string();
  return fmt::format("  {} = {} {}{}, {} of {}\n", quantity, value, unit_of(view, quantity), spread,
                     found.count, counted(view.plan.seeds.size(), "member"));
}

std::string means_text(const EnsembleView& view) {
  std::string text;
  for (std::size_t v = 0; v < view.plan.variants.size(); ++v) {
    std::string lines;
    for (const char* quantity : shown_quantities) lines += mean_line(view, v, quantity);
    if (lines.empty()) continue;
    const auto& [name, file, scenario, full_name, origin] = view.plan.variants[v];
    text += fmt::format("{}{}:\n{}", name.empty() ? "means, with their standard errors" : visible(name),
                        full_name.empty() ? "" : fmt::format(" ({})", full_name), lines);
  }
  return text;
}

/// Returns the worker that has claimed a member.
std::string holder_text(const ensemble::Member& member, const ensemble::MemberState& state) {
  const std::optional<ensemble::ClaimHolder> holder = ensemble::read_claim(member.path, *state.claim);
  return holder ? visible(holder->worker) : "a process that has just started";
}

std::string members_text(const EnsembleView& view) {
  std::string text;
  bool failed = false;
  for (std::size_t m = 0; m < view.plan.members.size(); ++m) {
    const ensemble::Member& member = view.plan.members[m];
    if (!view.states[m].damage.empty()) {
      text += fmt::format("damaged: {}: {}\n", visible(member.name), visible(view.states[m].damage));
      failed = true;
    }
    if (view.states[m].stage == ensemble::MemberStage::claimed)
      text += fmt::format("under way: {}, {}\n", visible(member.name), holder_text(member, view.states[m]));
    if (view.states[m].stage != ensemble::MemberStage::failed) continue;
    const ensemble::MemberFailure failure = ensemble::read_failure(member.path);
    text += fmt::format("failed: {}, exit code {}: {}\n", visible(member.name), failure.exit_code,
                        failure.message.empty() ? "it printed nothing" : failure.message);
    failed = true;
  }
  if (failed) text += fmt::format("to repeat: talus ensemble retry {}\n", shell_quoted(view.folder));
  return text;
}

Json variant_json(const EnsembleView& view, std::size_t variant) {
  Json json;
  for (const char* quantity : shown_quantities) {
    const Statistics found = statistics_of(values_of(view, variant, quantity));
    json[quantity] = {{"unit", unit_of(view, quantity)},
                      {"n", found.count},
                      {"mean", found.mean},
                      {"deviation", found.deviation},
                      {"error", found.error}};
  }
  return json;
}

Json member_json(const EnsembleView& view, std::size_t m) {
  const ensemble::MemberState& state = view.states[m];
  const ensemble::Member& member = view.plan.members[m];
  Json json = {{"stage", stage_names.at(static_cast<std::size_t>(state.stage))}};
  if (!state.damage.empty()) json["damage"] = state.damage;
  if (state.stage == ensemble::MemberStage::claimed) json["by"] = holder_text(member, state);
  if (state.stage == ensemble::MemberStage::done) {
    json["state_hash"] = view.numbers[m].state_hash;
    json["seconds"] = view.numbers[m].seconds;
  }
  if (state.stage == ensemble::MemberStage::failed) {
    const ensemble::MemberFailure failure = ensemble::read_failure(member.path);
    json["exit_code"] = failure.exit_code;
    json["message"] = failure.message;
  }
  return json;
}

/// Returns "kept: the analyses of all members that are done, and the frames of 10"; empty if the ensemble
/// keeps and has all frames.
std::string kept_text(const EnsembleView& view) {
  const std::size_t done = ensemble::count_of(view.states, ensemble::MemberStage::done);
  const bool keeps_all = view.manifest.keep.empty() || view.manifest.keep == "all";
  if (done == 0 || (keeps_all && view.with_frames == done)) return "";
  return fmt::format("kept: the analyses of all members that are done, and the frames of {}\n",
                     view.with_frames == 0 ? "none" : std::to_string(view.with_frames));
}

}  // namespace

EnsembleView view_of_ensemble(const std::string& folder, ensemble::KnownMembers& known) {
  EnsembleView view{folder, ensemble::read_ensemble(folder), {}, {}, {}, 0};
  view.plan = ensemble::plan_of(view.manifest, folder);
  view.states = ensemble::scan_members(view.plan);
  ensemble::find_damage(view.plan, view.states, known);
  view.numbers = ensemble::numbers_of(view.plan, view.states, known);
  for (std::size_t m = 0; m < view.states.size(); ++m)
    if (view.states[m].stage == ensemble::MemberStage::done &&
        ensemble::read_member(view.plan.members[m], known).has_frames)
      ++view.with_frames;
  return view;
}

std::size_t count_ended(const EnsembleView& view) {
  const std::string& until = view.manifest.until;
  if (!until.empty() && ensemble::is_reached(ensemble::parse_precision(until), view.plan, view.numbers))
    return view.states.size();
  return ensemble::count_of(view.states, ensemble::MemberStage::done) +
         ensemble::count_of(view.states, ensemble::MemberStage::failed);
}

std::string count_text(const EnsembleView& view) {
  std::string text =
      fmt::format("{} of {} done, {} under way", ensemble::count_of(view.states, ensemble::MemberStage::done),
                  view.states.size(), ensemble::count_of(view.states, ensemble::MemberStage::claimed));
  if (const std::size_t failed = ensemble::count_of(view.states, ensemble::MemberStage::failed); failed > 0)
    text += fmt::format(", {} failed", failed);
  return text;
}

/// Returns a note if members come from several versions of Talus, which may measure differently.
static std::string versions_text(const EnsembleView& view) {
  std::vector<std::string> versions;
  for (std::size_t m = 0; m < view.numbers.size(); ++m)
    if (view.states[m].stage == ensemble::MemberStage::done)
      versions.push_back(visible_word(view.numbers[m].version));
  std::ranges::sort(versions);
  versions.erase(std::unique(versions.begin(), versions.end()), versions.end());
  if (versions.size() < 2) return "";
  return fmt::format("  members come from several versions of Talus, which may cause differences: {}\n",
                     joined(versions, ", "));
}

std::string ensemble_text(const EnsembleView& view, const EnsembleJobs& jobs) {
  const std::string until =
      view.manifest.until.empty() ? "" : fmt::format(", until {}", visible(view.manifest.until));
  return fmt::format("{}: {}{}\n{}{}{}{}{}", visible(view.folder), count_text(view), until, kept_text(view),
                     versions_text(view), jobs_text(jobs), members_text(view), means_text(view));
}

std::string ensemble_json(const EnsembleView& view, const EnsembleJobs& jobs) {
  Json variants = Json::object(), members = Json::object();
  for (std::size_t v = 0; v < view.plan.variants.size(); ++v)
    variants[view.plan.variants[v].name] = variant_json(view, v);
  for (std::size_t m = 0; m < view.plan.members.size(); ++m)
    members[view.plan.members[m].name] = member_json(view, m);
  return json_text({{"folder", view.folder},
                    {"version", view.manifest.version},
                    {"until", view.manifest.until},
                    {"keep", view.manifest.keep.empty() ? "all" : view.manifest.keep},
                    {"runs", view.with_frames},
                    {"members_in_all", view.states.size()},
                    {"done", ensemble::count_of(view.states, ensemble::MemberStage::done)},
                    {"claimed", ensemble::count_of(view.states, ensemble::MemberStage::claimed)},
                    {"failed", ensemble::count_of(view.states, ensemble::MemberStage::failed)},
                    {"waiting", ensemble::count_of(view.states, ensemble::MemberStage::waiting)},
                    {"jobs", jobs_json(jobs)},
                    {"variants", variants},
                    {"members", members}});
}

namespace {

/// Returns the keys in which the variants differ.
std::vector<std::string> varied_keys(const std::vector<ensemble::Variant>& variants) {
  std::vector<std::string> keys = scenario::key_names(variants[0].scenario);
  std::erase_if(keys, [&variants](const std::string& key) {
    const std::string first = scenario::value_text(variants[0].scenario, key);
    return std::ranges::all_of(variants, [&](const ensemble::Variant& variant) {
      return scenario::value_text(variant.scenario, key) == first;
    });
  });
  return keys;
}

/// Returns a number with ten digits: 14.419 for 14.419000000000002, which an angle in radians gives in
/// degrees. Results mean fewer, and ensemble.h5 has them all. Empty for NaN.
std::string rounded_text(double value) { return std::isnan(value) ? "" : fmt::format("{:.10g}", value); }

/// Returns one row for each finished member: variant, varied keys, seed, hash, version, seconds, and all its
/// numbers, with units in the column names.
std::string members_csv(const EnsembleView& view) {
  std::vector<std::string> names;
  for (const ensemble::MemberNumbers& member : view.numbers) ensemble::add_names(member, names);
  TextTable table{{{"variant"}}, {}};
  const std::vector<std::string> keys = varied_keys(view.plan.variants);
  for (const std::string& key : keys) table.columns.push_back({key});
  table.columns.insert(table.columns.end(), {{"seed"}, {"state_hash"}, {"version"}, {"seconds"}});
  for (const std::string& name : names)
    table.columns.push_back({fmt::format("{} ({})", name, ensemble::unit_of_number(name))});
  for (std::size_t m = 0; m < view.plan.members.size(); ++m) {
    const ensemble::MemberNumbers& numbers = view.numbers[m];
    const ensemble::Member& member = view.plan.members[m];
    if (view.states[m].stage != ensemble::MemberStage::done) continue;
    auto& row = table.rows.emplace_back();
    row.push_back({csv_quoted(view.plan.variants[member.variant].name)});
    for (const std::string& key : keys) {
      const std::string value = scenario::value_text(member.scenario, key);
      row.push_back({parse_number<double>(value) ? value : csv_quoted(value)});
    }
    row.insert(row.end(), {{std::to_string(member.seed)},
                           {numbers.state_hash},
                           {numbers.version},
                           {rounded_text(numbers.seconds)}});
    for (const std::string& name : names)
      row.push_back({rounded_text(ensemble::number_called(numbers, name))});
  }
  return csv_text(table);
}

ensemble::VariantAverages averages_of_variant(const EnsembleView& view, std::size_t variant,
                                              ensemble::KnownMembers& known) {
  std::vector<const ensemble::MemberResult*> members;
  for (std::size_t m = 0; m < view.plan.members.size(); ++m)
    if (view.plan.members[m].variant == variant && view.states[m].stage == ensemble::MemberStage::done)
      members.push_back(&ensemble::analysed_member(view.plan.members[m], known));
  const ensemble::Variant& found = view.plan.variants[variant];
  return ensemble::averages_of(found.name, io::read_text(found.scenario_file), std::move(members),
                               found.scenario.output.frame_every);
}

void write_files(const std::filesystem::path& folder, const EnsembleView& view,
                 ensemble::KnownMembers& known) {
  std::vector<ensemble::VariantAverages> variants;
  for (std::size_t v = 0; v < view.plan.variants.size(); ++v)
    variants.push_back(averages_of_variant(view, v, known));
  io::write_text((folder / "members.csv").string(), members_csv(view));
  io::write_text((folder / "averages.csv").string(), ensemble::averages_csv(variants));
  ensemble::write_averages((folder / "ensemble.h5").string(), variants, view.manifest.version);
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
