#pragma once
/// What the members of an ensemble have given, read from their run files.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ensemble/member_state.h"
#include "ensemble/member_values.h"
#include "ensemble/plan.h"
#include "io/run_store.h"

namespace talus::ensemble {

/// Throws Error(bad_data) where a run is not that of the member: of another scenario, seed or bed.
void require_own_run(const Member& member, const io::RunHeader& header);

/// Whether the run of a member is complete. Throws as require_own_run and RunFile::open do.
bool is_complete(const Member& member);

/// What a process has read of members, each once as long as its file stays the same: every byte of a run file
/// is compared with its hash, which takes a while where there are many.
struct KnownMembers {
  /// Which file it was; another one, or one that was written to, has another mark.
  struct FileMark {
    std::uint64_t device = 0, inode = 0;
    std::int64_t size = 0, seconds = 0, nanoseconds = 0;
    bool operator==(const FileMark&) const = default;
  };
  struct Known {
    FileMark mark;
    bool whole = false;  ///< with series and lists
    MemberResult result;
  };
  std::map<std::string, Known> by_path;
};

/// The numbers of a member that is done, at least. The reference holds until its file is found changed.
/// Throws as require_own_run and RunFile::open do.
const MemberResult& read_member(const Member& member, KnownMembers& known);

/// Takes members whose files are damaged for ones that wait, and says why. Those that read_member refuses for
/// another reason stay done.
void look_for_damage(const EnsemblePlan& plan, std::vector<MemberState>& states, KnownMembers& known);

/// All of a member that is done, whose run may not be analysed yet, such as one that `talus run` has put
/// there: it is then, and the analysis stored where it may be. Throws as analysed_run does as well, and
/// Error(bad_data) where the run is just being computed again.
const MemberResult& analysed_member(const Member& member, KnownMembers& known);

}  // namespace talus::ensemble
