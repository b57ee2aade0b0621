#pragma once
/// How far the members of an ensemble are, read from the names of the files in its folder.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ensemble/plan.h"

namespace talus::ensemble {

enum class MemberStage {
  waiting,
  claimed,  ///< somebody has taken it, who may be at work or gone
  failed,   ///< it ended with an error, which stays until it is retried
  done,     ///< its run file is there
};

struct MemberState {
  MemberStage stage = MemberStage::waiting;
  std::optional<int> claim;    ///< the highest claim there is, whatever the stage
  bool has_folder = false;     ///< the folder in which its run is computed is there
  bool has_old_table = false;  ///< earlier versions of Talus have left a table of it
  std::string damage = {};     ///< of its run file, if look_for_damage found it so
};

/// Of all members, in the order of the plan, with one look at each folder.
std::vector<MemberState> look_at_members(const EnsemblePlan& plan);

/// Those that are done, in the order of the plan.
std::vector<std::size_t> done_members(const EnsemblePlan& plan);

std::size_t count_of(const std::vector<MemberState>& states, MemberStage stage);

/// The file beside the run of a member that failed, which tells its error.
std::string failure_path(const std::string& run);

/// How a member failed.
struct MemberFailure {
  int exit_code = 0;    ///< 128 + signal where a signal ended it
  std::string message;  ///< the last line that it printed, fit to be shown
};
void record_failure(const std::string& run, const MemberFailure& failure);

/// Throws as read_text does.
MemberFailure read_failure(const std::string& run);

/// The last line of a log that says something; empty where there is none.
std::string last_line_of(const std::string& log);

}  // namespace talus::ensemble
