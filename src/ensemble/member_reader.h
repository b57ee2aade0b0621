#pragma once
/// Results of the members of an ensemble, read from their run files.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ensemble/member_state.h"
#include "ensemble/member_values.h"
#include "ensemble/plan.h"
#include "io/run_file.h"

namespace talus::ensemble {

/// Throws Error(bad_data) if a run has another scenario, seed or bed than the member, or if more was done to
/// it than its scenario says: a branch, or a run with commands of a script.
void require_own_run(const Member& member, const io::RunFile& run);

/// Whether the run of a member is complete. Throws the errors of require_own_run and RunFile::open.
bool is_complete(const Member& member);

/// A cache of the members that a process has read. A member is read again only if its file changes, because
/// every byte of a run file is compared with its hash, which is slow for many members.
struct KnownMembers {
  /// Identifies a file and its state; another file, or a modified one, has another mark.
  struct FileMark {
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = 0, seconds = 0, nanoseconds = 0;
    bool operator==(const FileMark&) const = default;
  };
  struct Entry {
    FileMark mark;
    bool whole = false;  ///< includes series and lists
    MemberResult result;
  };
  std::map<std::string, Entry> by_path;
};

/// Returns the results of a completed member, at least its scalar ones. The reference is valid until its file
/// is found changed. Throws the errors of require_own_run and RunFile::open.
const MemberResult& read_member(const Member& member, KnownMembers& known);

/// Marks members with damaged files as waiting, and records the damage. Members that read_member refuses for
/// another reason remain done.
void find_damage(const EnsemblePlan& plan, std::vector<MemberState>& states, KnownMembers& known);

/// Returns all results of a completed member. If its run has no valid analysis, such as one that `talus run`
/// has put there, it is analysed first, and the analysis is stored if possible. Throws also the errors of
/// analysed_run, and Error(bad_data) if the run is being computed again.
const MemberResult& analysed_member(const Member& member, KnownMembers& known);

}  // namespace talus::ensemble
