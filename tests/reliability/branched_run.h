#pragma once
/// A run with commands, and a branch of it.

#include <functional>
#include <string>

#include "io/run_store.h"

namespace talus::hostile {

/// Computes a bed between walls, in which commands set friction and the rate of the tilt and drag a grain, as
/// `parent`; and a branch of it from a frame where all three are in force, with a push of its own.
/// `complete`: to its end, as a packed file; else it is stopped on its way, a folder.
void make_branch(const std::string& parent, const std::string& branch, bool complete);

/// The run at `branch` again as the folder `path`, of which the start has been changed, with the hashes that
/// it then has.
void store_with_start(const std::string& branch, const std::string& path,
                      const std::function<void(io::BranchOrigin&)>& change);

/// Reads all that a branch holds, begins it again from its own start, and takes a step; then all that is done
/// with any run (hostile_run.h), and the start of another branch. Throws as these do.
void use_branch(const std::string& path);

}  // namespace talus::hostile
