#include "ensemble/member_results.h"

#include <array>
#include <cerrno>
#include <utility>
#include <variant>

#include "analysis/failure/transition.h"
#include "analysis/quantities.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "core/snapshot.h"
#include "core/statistics.h"
#include "core/trigonometry.h"
#include "io/packed_file.h"
#include "runs/analysis_run.h"
#include "runs/run_view.h"
#include "session/run_header.h"

namespace talus::ensemble {

namespace {

/// Results that the run itself computes, without an analysis.
constexpr const char* angle_at_rest = "theta_r";
constexpr std::array<const char*, 2> counted_steps = {"unconverged_steps_deposition", "unconverged_steps"};

/// Returns the number of values of a result: its elements, or the thresholds.
std::size_t count_of(const analysis::NumberOfRun& number, const analysis::Analysis& analysis) {
  const analysis::Quantity& quantity = analysis::quantity_of(number.quantity);
  if (number.place == analysis::Place::run)
    return std::get<std::vector<double>>(analysis::values_of(quantity, analysis)).size();
  return analysis::needs_threshold(quantity) ? analysis.thresholds.size() : 1;
}

double result(const Figures& figures, const std::string& name) {
  return find_value(figures, name).value_or(not_known);
}

FileMark mark_of(const std::string& path) {
  if (const std::optional<FileMark> mark = mark_of_file(path)) return *mark;
  throw system_error(ExitCode::missing_input, "open", path, errno);
}

/// Returns the quantities that are averaged, or only those of the scalar results. Values of single grains,
/// which make up most of an analysis, are excluded.
std::vector<analysis::Quantity> quantities_of_members(bool averaged) {
  std::vector<analysis::Quantity> found;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    const bool is_result = std::ranges::any_of(
        analysis::numbers_of_run(), [&](const auto& number) { return number.quantity == quantity.member; });
    const bool is_averaged = analysis::is_number_of_run(quantity) || analysis::is_number_of_frame(quantity) ||
                             analysis::is_list_of_run(quantity) || analysis::is_list_of_frame(quantity);
    if (averaged ? is_averaged : is_result) found.push_back(quantity);
  }
  return found;
}

MemberResult result_of(const Member& member, const io::RunFile& run, analysis::Analysis analysis) {
  MemberNumbers numbers = member_numbers(run, analysis);
  for (analysis::FrameRecord& frame : analysis.frames)
    for (analysis::FrameThreshold& threshold : frame.thresholds) threshold.lc = {}, threshold.cluster = {};
  return {member.seed, std::move(numbers), std::move(analysis), run.header().statics.mean_diameter,
          run.has_frames()};
}

MemberResult read_result(const Member& member, bool whole) {
  const io::RunFile run = io::RunFile::open(member.path);
  require_own_run(member, run);
  const std::optional<analysis::Analysis> analysis = io::read_analysis(run, quantities_of_members(whole));
  const bool is_valid = analysis && analysis->key == runs::analysis_key(run, analysis::AnalysisParameters());
  MemberResult found = result_of(member, run, is_valid ? *analysis : analysis::Analysis());
  if (!is_valid) found.numbers.numbers.clear();
  if (!whole) found.analysis = {};
  return found;
}

const MemberResult& keep(const Member& member, KnownMembers& known, KnownMembers::Entry read) {
  return known.by_path.insert_or_assign(member.path, std::move(read)).first->second.result;
}

}  // namespace

std::string element_name(const std::string& name, std::size_t k) {
  return k == 0 ? name : fmt::format("{}[{}]", name, k);
}

MemberNumbers member_numbers(const io::RunFile& run, const analysis::Analysis& analysis) {
  const io::Checkpoint& end = run.checkpoint();
  MemberNumbers found{hash_text(state_hash(end.world)),
                      runs::version_of(run.header().provenance),
                      result(end.timing, "deposition") + result(end.timing, "tilt"),
                      {}};
  for (const analysis::NumberOfRun& number : analysis::numbers_of_run()) {
    const std::string& unit = analysis::quantity_of(number.quantity).unit;
    for (std::size_t k = 0; k < count_of(number, analysis); ++k)
      found.numbers.emplace_back(element_name(name_of(number), k),
                                 analysis::scaled(unit, analysis::number_at(analysis, number, k),
                                                  run.header().statics.mean_diameter));
  }
  found.numbers.emplace_back(angle_at_rest, degrees(result(end.results, angle_at_rest)));
  for (const char* name : counted_steps) found.numbers.emplace_back(name, result(end.results, name));
  return found;
}

std::vector<std::string> numbers_of_run() {
  std::vector<std::string> names;
  for (const analysis::NumberOfRun& number : analysis::numbers_of_run()) names.push_back(name_of(number));
  names.emplace_back(angle_at_rest);
  names.insert(names.end(), counted_steps.begin(), counted_steps.end());
  return names;
}

bool is_number_of_run(const std::string& name) {
  const std::vector<std::string> names = numbers_of_run();
  const std::size_t bracket = std::min(name.find('['), name.size());
  const std::string element = name.substr(bracket);  // for example "[1]"
  const std::size_t digits = element.find_first_not_of("0123456789", 1);
  const bool is_element =
      element.empty() || (digits != std::string::npos && digits > 1 && element.substr(digits) == "]");
  return is_element && std::ranges::find(names, name.substr(0, bracket)) != names.end();
}

std::string unit_of_number(const std::string& name) {
  if (name == angle_at_rest) return "deg";
  const auto found = std::ranges::find(analysis::quantities(), name.substr(0, name.find_first_of("@[")),
                                       &analysis::Quantity::name);
  return found == analysis::quantities().end() ? "1" : analysis::scaled_unit(found->unit);
}

double number_called(const MemberNumbers& numbers, const std::string& name) {
  return result(numbers.numbers, name);
}

void add_names(const MemberNumbers& numbers, std::vector<std::string>& names) {
  for (const auto& [name, value] : numbers.numbers)
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

void require_own_run(const Member& member, const io::RunFile& run) {
  const io::RunHeader& header = run.header();
  // Values are compared, not texts: a key that an earlier version did not have takes its default.
  const scenario::Scenario scenario = runs::stored_scenario(header, member.path);
  if (scenario != member.scenario)
    throw Error(ExitCode::bad_data,
                "{} is a run of another scenario, not of this member of the ensemble: {}; expected the "
                "scenario, the settings and the version with which the ensemble was started; give another "
                "folder, or remove the run",
                member.path, scenario::differences(scenario, member.scenario));
  if (const std::vector<std::string> more = session::departures(run, scenario); !more.empty())
    throw Error(ExitCode::bad_data,
                "{} is not a run of its scenario alone, as the members of an ensemble are: {}; give another "
                "folder, or remove the run",
                member.path, session::departures_text(more));
  const std::string bed = session::bed_of(header.provenance);
  if (!bed.empty() && !member.origin.bed.empty() && bed != member.origin.bed)
    throw Error(ExitCode::bad_data,
                "{} was not computed from the bed of this ensemble: {} (deposition.file) has changed; undo "
                "the change, and remove the run",
                member.path, visible(scenario.deposition.file));
}

bool is_complete(const Member& member) {
  const io::RunPresence presence = io::run_presence(member.path);
  if (presence == io::RunPresence::none) return false;
  require_own_run(member, io::RunFile::open(member.path));
  return presence == io::RunPresence::packed;
}

const MemberResult& read_member(const Member& member, KnownMembers& known, bool whole) {
  const FileMark mark = mark_of(member.path);  // recorded before reading, in case the file changes meanwhile
  const auto found = known.by_path.find(member.path);
  if (found != known.by_path.end() && (found->second.whole || !whole) && found->second.mark == mark)
    return found->second.result;
  return keep(member, known, {mark, whole, read_result(member, whole)});
}

std::vector<MemberNumbers> numbers_of(const EnsemblePlan& plan, const std::vector<MemberState>& states,
                                      KnownMembers& known) {
  std::vector<MemberNumbers> numbers(plan.members.size());
  std::map<std::pair<std::size_t, std::string>, const Member*> ends;
  for (std::size_t m = 0; m < plan.members.size(); ++m) {
    if (states[m].stage != MemberStage::done) continue;
    const Member& member = plan.members[m];
    numbers[m] = read_member(member, known).numbers;
    // A bed from a file has no random element and may be the same for all seeds.
    if (member.scenario.deposition.method == scenario::DepositionMethod::file) continue;
    const auto [first, is_new] = ends.emplace(std::pair(member.variant, numbers[m].state_hash), &member);
    if (!is_new)
      throw Error(ExitCode::bad_data,
                  "{} and {} have the same state_hash, which two seeds never have: one is a copy; remove it, "
                  "and talus ensemble computes that member again",
                  first->second->path, member.path);
  }
  return numbers;
}

void find_damage(const EnsemblePlan& plan, std::vector<MemberState>& states, KnownMembers& known) {
  for (std::size_t m = 0; m < states.size(); ++m) {
    if (states[m].stage != MemberStage::done) continue;
    const Member& member = plan.members[m];
    try {
      read_member(member, known);
    } catch (const Error& error) {
      if (error.code() != ExitCode::bad_data) continue;
      states[m].damage = io::damage_of_packed(member.path);
      if (!states[m].damage.empty()) states[m].stage = MemberStage::waiting;
    }
  }
}

const MemberResult& analysed_member(const Member& member, KnownMembers& known) {
  const MemberResult& read = read_member(member, known, true);
  if (!read.numbers.numbers.empty()) return read;
  runs::RunView run = runs::analysed_run(member.path, analysis::AnalysisParameters(), {});
  if (!run.file->complete())
    throw Error(ExitCode::bad_data, member.path + " is being computed again; wait until it ends");
  return keep(member, known,
              {mark_of(member.path), true, result_of(member, *run.file, std::move(run.analysis))});
}

Precision parse_precision(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  Precision precision;
  if (colon != std::string::npos && colon > 0) {
    precision.quantity = text.substr(0, colon);
    precision.error = parse_number<double>(text.substr(colon + 1)).value_or(0.0);
    const bool has_error = precision.error > 0.0;
    if (has_error && is_number_of_run(precision.quantity)) return precision;
    if (has_error)
      throw Error(ExitCode::usage, "--until {}: {} is not a result of a run; expected one of {}",
                  visible_word(text), visible_word(precision.quantity), joined(numbers_of_run(), ", "));
  }
  throw Error(ExitCode::usage,
              "--until {}: expected a quantity and the standard error of its mean, such as theta_c:0.2 (deg)",
              visible_word(text));
}

bool is_reached(const Precision& precision, const EnsemblePlan& plan,
                const std::vector<MemberNumbers>& numbers) {
  std::vector<std::vector<double>> values(plan.variants.size());
  for (std::size_t m = 0; m < plan.members.size(); ++m) {
    if (numbers[m].numbers.empty()) continue;
    values[plan.members[m].variant].push_back(number_called(numbers[m], precision.quantity));
  }
  return std::ranges::all_of(values, [&](const std::vector<double>& variant_values) {
    const Statistics found = statistics_of(variant_values);
    return found.count >= min_members && found.error <= precision.error;
  });
}

}  // namespace talus::ensemble
