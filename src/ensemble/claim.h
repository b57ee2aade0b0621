#pragma once
/// Claims on the members of an ensemble, for workers that share only a folder.
///
/// A claim is a file next to the run, "seed-7.claim-0", which only one process can create. Its worker holds a
/// lock on it, and appends a byte to it at intervals. On the worker's machine, the lock shows whether the
/// claim is alive. Another machine, which may not see locks, checks with its own clock whether the file
/// grows. A process that finds the claim dead creates the claim with the next number, "seed-7.claim-1"; again
/// only one can. If there are several claims, the highest number is valid.

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/descriptor.h"

namespace talus::ensemble {

struct ClaimTimes {
  double stale = 120.0;  ///< s without a heartbeat after which a claim of another machine is dead

  /// Returns the interval between two heartbeats, s.
  double heartbeat_interval() const { return stale / 12.0; }
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
  Claim(std::string path, int number, std::string next, Descriptor file, double seconds);
  std::string path_;
  int number_;
  std::string next_;  ///< path of the claim that would replace this one
  Descriptor file_;
  std::chrono::duration<double> interval_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace talus::ensemble
