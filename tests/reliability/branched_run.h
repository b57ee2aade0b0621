#pragma once
/// A run with commands, and a branch of it.

#include <functional>
#include <string>

#include "io/run_store.h"

namespace talus::hostile {

/// Computes a bed between walls as `parent`, in which commands set friction and tilt rate and drag a grain,
/// and a branch from a frame at which all three are in effect, with an additional push. If `complete`, the
/// runs are computed to their end as packed files; else they are stopped and remain folders.
void make_branch(const std::string& parent, const std::string& branch, bool complete);

/// Stores the run at `branch` again as the folder `path`, with a changed start and matching hashes.
void store_with_start(const std::string& branch, const std::string& path,
                      const std::function<void(io::BranchOrigin&)>& change);

/// Reads everything in a branch, restarts it from its own start and takes a step; then uses it like any other
/// run (hostile_run.h), and as the start of another branch. Throws the errors of these.
void use_branch(const std::string& path);

}  // namespace talus::hostile
