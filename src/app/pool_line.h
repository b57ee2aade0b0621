#pragma once
/// A pool of processes with its progress on stderr: one line that is rewritten on a terminal, a line for each
/// job that ends in a log.

#include <string>
#include <vector>

#include "ensemble/pool.h"

namespace talus {

/// run_jobs, as part of `work` ("study"), which begins the line; it counts things called `counted`.
std::vector<FailedJob> run_with_progress(const std::vector<Job>& jobs, std::size_t all, int at_once,
                                         const std::string& work, const std::string& counted = "runs");

}  // namespace talus
