#pragma once
/// Workers of an ensemble as processes side by side on this machine, with their progress on stderr.

#include <string>

#include "ensemble/claim.h"

namespace talus {

struct EnsembleWorkers {
  std::string folder;
  ClaimTimes times;
  std::string max_wall;  ///< HH:MM; empty: no limit
  int jobs = 1;          ///< workers side by side, each on one thread
};

/// Computes what is missing of an ensemble. Members that others compute are waited for, and taken over where
/// their workers end before them; workers that were killed are replaced, as long as members come to an end.
/// With a limit of time others are left alone. Throws Error(stopped) on a signal or where the time is over,
/// the Error of a worker that ended with one, and as read_ensemble does.
void compute_members(const EnsembleWorkers& workers);

}  // namespace talus
