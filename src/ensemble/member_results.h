#pragma once
/// Results of the members of an ensemble, read from their run files, and the stopping criterion on their
/// means.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/core.h>
#include <map>
#include <string>
#include <vector>

#include "analysis/record.h"
#include "base/output_file.h"
#include "ensemble/member_state.h"
#include "ensemble/plan.h"
#include "io/run_file.h"

namespace talus::ensemble {

/// The scalar results of a member, in the units of tables (unit_of_number).
struct MemberNumbers {
  std::string state_hash;
  std::string version;   ///< version and git hash of the Talus that computed it
  double seconds = 0.0;  ///< wall time of its steps
  Figures numbers;       ///< for example "theta_c"; "theta_d/lc_jump[1]" is element 1 of several
};

/// The results of a completed member.
struct MemberResult {
  std::uint64_t seed = 0;
  MemberNumbers numbers;             ///< without numbers if this version has not analysed its run
  analysis::Analysis analysis = {};  ///< averaged quantities; empty if only the numbers were read
  double mean_diameter = 1.0;        ///< D, m
  bool has_frames = true;            ///< its file contains frames as well as the analysis
};

/// Returns all scalar results of a complete run and of its analysis (analysis/failure/transition.h), and then
/// those that the run itself computes (theta_r).
MemberNumbers member_numbers(const io::RunFile& run, const analysis::Analysis& analysis);

/// Returns the names of the scalar results of a run, only the first of several elements: "theta_d/dilation",
/// not "theta_d/dilation[1]".
std::vector<std::string> numbers_of_run();

/// Whether a name is one of numbers_of_run(), or a further element of it ("theta_d/dilation[1]").
bool is_number_of_run(const std::string& name);

/// Returns the unit of a scalar result in tables: deg, D, ...
std::string unit_of_number(const std::string& name);

/// Returns the scalar result of that name; NaN if there is none.
double number_called(const MemberNumbers& numbers, const std::string& name);

/// Adds the names of the scalar results of a member that are not among `names` yet. Runs that have failed
/// have more elements than others.
void add_names(const MemberNumbers& numbers, std::vector<std::string>& names);

/// Returns the name of element k of a result with several, such as "theta_d/lc_jump[1]"; [0] is left out.
std::string element_name(const std::string& name, std::size_t k);

/// Throws Error(bad_data) if a run has another scenario, seed or bed than the member, or if more was done to
/// it than its scenario says: a branch, or a run with commands of a script.
void require_own_run(const Member& member, const io::RunFile& run);

/// Whether the run of a member is complete. Throws the errors of require_own_run and RunFile::open.
bool is_complete(const Member& member);

/// A cache of the members that a process has read. A member is read again only if its file changes, because
/// every byte of a run file is compared with its hash, which is slow for many members.
struct KnownMembers {
  struct Entry {
    FileMark mark;
    bool whole = false;  ///< includes the averaged quantities
    MemberResult result;
  };
  std::map<std::string, Entry> by_path;
};

/// Returns the results of a completed member, only its scalar ones unless `whole`. The reference is valid
/// until its file is found changed. Throws the errors of require_own_run and RunFile::open.
const MemberResult& read_member(const Member& member, KnownMembers& known, bool whole = false);

/// Returns the scalar results of the completed members, in the order of the plan, and empty results for the
/// others. Throws the errors of read_member, and Error(bad_data) if two seeds of a variant have the same
/// state hash.
std::vector<MemberNumbers> numbers_of(const EnsemblePlan& plan, const std::vector<MemberState>& states,
                                      KnownMembers& known);

/// Marks members with damaged files as waiting, and records the damage. Members that read_member refuses for
/// another reason remain done.
void find_damage(const EnsemblePlan& plan, std::vector<MemberState>& states, KnownMembers& known);

/// Returns all results of a completed member. If its run has no valid analysis, such as one that `talus run`
/// has put there, it is analysed first, and the analysis is stored if possible. Throws also the errors of
/// analysed_run, and Error(bad_data) if the run is being computed again.
const MemberResult& analysed_member(const Member& member, KnownMembers& known);

/// For example "theta_c:0.2": the required standard error of the mean of theta_c, in the unit of tables
/// (deg).
struct Precision {
  std::string quantity;
  double error = 0.0;
};

/// The standard error is unreliable with fewer values.
inline constexpr int min_members = 5;

/// Parses a criterion. Throws Error(usage), naming --until, if the text has another form or the quantity is
/// not a scalar result.
Precision parse_precision(const std::string& text);

/// Whether the mean of each variant has that precision, with at least `min_members` values. `numbers` comes
/// from numbers_of.
bool is_reached(const Precision& precision, const EnsemblePlan& plan,
                const std::vector<MemberNumbers>& numbers);

/// Formats "16.43 ± 0.21": the width, which must be positive, with two digits, and the mean with the same
/// number of decimals. `sign` adds a plus before a non-negative mean.
inline std::string plus_minus(double mean, double width, bool sign = false) {
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 12);
  return fmt::format(fmt::runtime(sign ? "{0:+.{2}f} ± {1:.{2}f}" : "{0:.{2}f} ± {1:.{2}f}"), mean, width,
                     decimals);
}

}  // namespace talus::ensemble
