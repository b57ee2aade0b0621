#pragma once
/// Progress of the members of an ensemble, read from the names of the files in its folder.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus::ensemble {

enum class MemberStage {
  waiting,
  claimed,  ///< a worker has claimed it, and may be at work or gone
  failed,   ///< it ended with an error, which remains until it is retried
  done,     ///< its run file exists
};

struct MemberState {
  MemberStage stage = MemberStage::waiting;
  std::optional<int> claim;    ///< highest existing claim, in any stage
  bool has_folder = false;     ///< the folder in which its run is computed exists
  bool has_old_table = false;  ///< earlier versions of Talus have left a table
  std::string damage = {};     ///< damage of its run file that find_damage found
};

/// Returns the states of all members, in the order of the plan. Scans each folder once.
std::vector<MemberState> scan_members(const EnsemblePlan& plan);

/// Returns the indices of the completed members, in the order of the plan.
std::vector<std::size_t> done_members(const EnsemblePlan& plan);

std::size_t count_of(const std::vector<MemberState>& states, MemberStage stage);

/// Returns the path of the file next to the run of a failed member that records its error.
std::string failure_path(const std::string& run);

/// The error of a failed member.
struct MemberFailure {
  int exit_code = 0;    ///< 128 + signal if a signal ended it
  std::string message;  ///< last line that it printed, made printable
};
void record_failure(const std::string& run, const MemberFailure& failure);

/// Reads a recorded failure. Throws the errors of read_text.
MemberFailure read_failure(const std::string& run);

/// Returns the last non-empty line of a log; empty if there is none.
std::string last_line_of(const std::string& log);

}  // namespace talus::ensemble
