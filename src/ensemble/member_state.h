#pragma once
/// Progress of the members of an ensemble, read from the names of the files in its folder, and the claims by
/// which workers share its members.

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/output_file.h"
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
  std::optional<int> claim;  ///< highest existing claim, in any stage
  bool has_folder = false;   ///< the folder in which its run is computed exists
  std::string damage = {};   ///< damage of its run file that find_damage found
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

struct ClaimTimes {
  double stale = 120.0;  ///< s without a heartbeat after which a claim of another machine is dead
};

/// The contents of a claim.
struct ClaimHolder {
  std::string worker;  ///< for example "process 123 on host a"
  std::string boot;    ///< boot id; distinguishes hosts of the same name
  std::uint64_t beats = 0;
};

/// Reads the claim of that number; nothing if it does not exist or is incomplete.
std::optional<ClaimHolder> read_claim(const std::string& run, int number);

/// Returns "seed-7.claim-0" for "seed-7.h5".
std::string claim_path(const std::string& run, int number);

/// The parts of a claim's file name: the name of its run without extension ("seed-7") and the number.
/// parse_claim_name returns nothing for other files.
struct ClaimName {
  std::string run;
  int number = 0;
};
std::optional<ClaimName> parse_claim_name(const std::string& file);

/// Returns the paths of all claims of a run.
std::vector<std::string> claims_of(const std::string& run);

/// The claims that this worker has observed, and the times at which they last grew.
struct ClaimWatch {
  struct Observation {
    int number = 0;
    std::uint64_t beats = 0;
    std::chrono::steady_clock::time_point since;
    bool grew = false;  ///< it grew while it was watched, so its worker is alive
    std::string who;    ///< current holder; a new holder counts from its own first heartbeat
  };
  ClaimTimes times;
  std::map<std::string, Observation> observations;  ///< indexed by run
};

enum class ClaimState { alive, dead, unknown };

/// Returns whether the worker of a claim is alive. `unknown`: the claim is on another machine, or on a file
/// system without locks, and has not been watched long enough.
ClaimState claim_state(const std::string& run, int number, ClaimWatch& watch);

/// The right to compute one member. It ends with the object, or with the process and its descendants.
class Claim {
 public:
  /// Acquires the claim on a run. `found` is the highest existing claim, which must be dead, if there is one.
  /// Returns nothing if another process was faster. Throws creation_error and Error(io_error).
  static std::optional<Claim> take(const std::string& run, std::optional<int> found, const ClaimTimes& times);
  Claim(Claim&&) noexcept = default;
  Claim& operator=(Claim&&) = delete;
  ~Claim();

  /// Writes a heartbeat if one is due; one that cannot be written is skipped. Returns false if the claim is
  /// lost, because it was considered dead or removed.
  bool record_heartbeat();

  int number() const { return number_; }

 private:
  Claim(const std::string& run, int number, Descriptor file, const ClaimTimes& times);
  std::string path_;
  int number_;
  std::string next_;  ///< path of the claim that would replace this one
  Descriptor file_;
  std::chrono::duration<double> interval_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace talus::ensemble
