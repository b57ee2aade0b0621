#pragma once
/// Who computes which member of an ensemble, where workers share a folder and nothing else.
///
/// A claim is a file beside the run, "seed-7.claim-0", that only one process can create. Its worker holds a
/// lock on it, and adds a byte to it from time to time. On the machine of the worker the lock tells whether
/// the claim is alive; another machine, to which locks may not reach, looks whether the file grows, by its
/// own clock alone. Whoever finds it dead creates the claim of the next number, "seed-7.claim-1": only one
/// can. Where there are several claims the highest number holds.

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/descriptor.h"

namespace talus::ensemble {

struct ClaimTimes {
  double stale = 120.0;  ///< s without a heartbeat after which a claim of another machine is dead

  /// s between two heartbeats
  double beat() const { return stale / 12.0; }
};

/// What stands in a claim.
struct ClaimHolder {
  std::string worker;  ///< "process 123 on host a"
  std::string boot;    ///< which start of which machine: two hosts of one name have two
  std::uint64_t beats = 0;
};

/// The claim of a number; nothing where there is none, or it is just being written.
std::optional<ClaimHolder> read_claim(const std::string& run, int number);

/// "seed-7.claim-0" of "seed-7.h5".
std::string claim_path(const std::string& run, int number);

/// The number in the name of a claim, and the name of its run without its ending ("seed-7"); nothing for
/// another file.
struct ClaimName {
  std::string run;
  int number = 0;
};
std::optional<ClaimName> parse_claim_name(const std::string& file);

/// The paths of all claims of a run.
std::vector<std::string> claims_of(const std::string& run);

/// The claims that this worker has looked at, and when they last grew.
struct ClaimWatch {
  struct Seen {
    int number = 0;
    std::uint64_t beats = 0;
    std::chrono::steady_clock::time_point since;
    bool grew = false;  ///< while it was watched: somebody is at work
    std::string who;    ///< has it: a new holder counts from its own first heartbeat
  };
  ClaimTimes times;
  std::map<std::string, Seen> seen;  ///< by run
};

enum class ClaimState { alive, dead, unknown };

/// Whether the worker of a claim is there. `unknown`: on another machine, or on a file system without locks,
/// and not watched for long enough.
ClaimState claim_state(const std::string& run, int number, ClaimWatch& watch);

/// The right to compute one member. It ends with the object, or with the process and all that it started.
class Claim {
 public:
  /// Takes the claim of a run of which `found` is the highest that exists, and dead, if there is one. Nothing
  /// where another process was faster. Throws creation_error and Error(io_error).
  static std::optional<Claim> take(const std::string& run, std::optional<int> found, const ClaimTimes& times);
  Claim(Claim&&) noexcept = default;
  Claim& operator=(Claim&&) = delete;
  ~Claim();

  /// Adds a heartbeat where one is due; one that cannot be written is left out. False where the claim is
  /// lost: it was taken for dead, or removed.
  bool beat();

  int number() const { return number_; }

 private:
  Claim(std::string path, int number, std::string next, Descriptor file, double seconds);
  std::string path_;
  int number_;
  std::string next_;  ///< the claim that would replace it
  Descriptor file_;
  std::chrono::duration<double> interval_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace talus::ensemble
