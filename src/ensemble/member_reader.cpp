#include "ensemble/member_reader.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <fmt/core.h>
#include <functional>
#include <iterator>

#include "analysis/failure/place.h"
#include "analysis/quantities.h"
#include "base/errors.h"
#include "base/visible_text.h"
#include "io/analysis_file.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"
#include "runs/run_view.h"
#include "scenario/text.h"
#include "session/run_header.h"
#include "session/run_identity.h"

namespace talus::ensemble {
namespace {

KnownMembers::FileMark mark_of(const std::string& path) {
  struct stat file = {};
  if (::stat(path.c_str(), &file) != 0) throw system_error(ExitCode::missing_input, "open", path, errno);
  return {file.st_dev, file.st_ino, file.st_size, file.st_mtim.tv_sec, file.st_mtim.tv_nsec};
}

std::vector<analysis::Quantity> rows_where(const std::function<bool(const analysis::Quantity&)>& is_wanted) {
  std::vector<analysis::Quantity> found;
  std::ranges::copy_if(analysis::quantities(), std::back_inserter(found), is_wanted);
  return found;
}

const std::vector<analysis::Quantity>& numbers_of_members() {
  static const std::vector<analysis::Quantity> table = rows_where([](const analysis::Quantity& quantity) {
    return std::ranges::any_of(analysis::numbers_of_run(), [&](const analysis::NumberOfRun& number) {
      return number.quantity == quantity.member;
    });
  });
  return table;
}

/// Returns the quantities that are averaged. Values of single grains, which make up most of an analysis, are
/// excluded.
const std::vector<analysis::Quantity>& averaged_quantities() {
  static const std::vector<analysis::Quantity> table = rows_where([](const analysis::Quantity& quantity) {
    return analysis::is_number_of_run(quantity) || analysis::is_number_of_frame(quantity) ||
           analysis::is_list_of_run(quantity) || analysis::is_list_of_frame(quantity);
  });
  return table;
}

MemberResult result_of(const Member& member, const io::RunFile& run, const analysis::Analysis& analysis) {
  const double mean_diameter = run.header().statics.mean_diameter;
  return {member.seed, member_numbers(run, analysis), member_series(analysis, mean_diameter),
          member_lists(analysis, mean_diameter), run.has_frames()};
}

MemberResult read_result(const Member& member, bool whole) {
  const io::RunFile run = io::RunFile::open(member.path);
  require_own_run(member, run);
  const std::optional<analysis::Analysis> analysis =
      io::read_analysis(run, whole ? averaged_quantities() : numbers_of_members());
  const bool is_valid = analysis && analysis->key == runs::analysis_key(run, analysis::AnalysisParameters());
  if (is_valid && whole) return result_of(member, run, *analysis);
  MemberResult found{member.seed, {}, {}, {}, run.has_frames()};
  found.numbers = member_numbers(run, is_valid ? *analysis : analysis::Analysis());
  if (!is_valid) found.numbers.numbers.clear();
  return found;
}

const MemberResult& keep(const Member& member, KnownMembers& known, KnownMembers::Entry read) {
  return known.by_path.insert_or_assign(member.path, std::move(read)).first->second.result;
}

const MemberResult& read_parts(const Member& member, KnownMembers& known, bool whole) {
  const KnownMembers::FileMark mark =
      mark_of(member.path);  // recorded before reading, in case the file changes meanwhile
  const auto found = known.by_path.find(member.path);
  if (found != known.by_path.end() && (found->second.whole || !whole) && found->second.mark == mark)
    return found->second.result;
  return keep(member, known, {mark, whole, read_result(member, whole)});
}

}  // namespace

void require_own_run(const Member& member, const io::RunFile& run) {
  const io::RunHeader& header = run.header();
  // Values are compared, not texts: a key that an earlier version did not have takes its default.
  const scenario::Scenario scenario = runs::stored_scenario(header, member.path);
  if (scenario != member.scenario)
    throw Error(
        ExitCode::bad_data,
        fmt::format("{} is a run of another scenario, not of this member of the ensemble: {}; expected the "
                    "scenario, the settings and the version with which the ensemble was started; give "
                    "another folder, or remove the run",
                    member.path, scenario::differences(scenario, member.scenario)));
  if (const std::vector<std::string> more = session::departures(run, scenario); !more.empty())
    throw Error(ExitCode::bad_data,
                fmt::format("{} is not a run of its scenario alone, as the members of an ensemble are: {}; "
                            "give another folder, or remove the run",
                            member.path, session::departures_text(more)));
  const std::string bed = session::bed_of(header.provenance);
  if (!bed.empty() && !member.origin.bed.empty() && bed != member.origin.bed)
    throw Error(ExitCode::bad_data,
                fmt::format("{} was not computed from the bed of this ensemble: {} (deposition.file) has "
                            "changed; undo the change, and remove the run",
                            member.path, visible(scenario.deposition.file)));
}

bool is_complete(const Member& member) {
  const io::RunPresence presence = io::run_presence(member.path);
  if (presence == io::RunPresence::none) return false;
  require_own_run(member, io::RunFile::open(member.path));
  return presence == io::RunPresence::packed;
}

const MemberResult& read_member(const Member& member, KnownMembers& known) {
  return read_parts(member, known, false);
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
  const MemberResult& read = read_parts(member, known, true);
  if (!read.numbers.numbers.empty()) return read;
  const runs::RunView run = runs::analysed_run(member.path, analysis::AnalysisParameters(), {});
  if (!run.file->complete())
    throw Error(ExitCode::bad_data, member.path + " is being computed again; wait until it ends");
  return keep(member, known, {mark_of(member.path), true, result_of(member, *run.file, run.analysis)});
}

}  // namespace talus::ensemble
