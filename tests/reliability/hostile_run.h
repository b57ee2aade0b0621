#pragma once
/// A run to spoil, and all that is done with a run that was stored.

#include <string>

#include "io/run_file.h"
#include "problems/problem_file.h"

namespace talus::hostile {

/// Computes a small bed between walls, with commands, to its end, and stores its analysis in its file.
void make_run(const std::string& path);

/// The same, stopped at a tilt (deg) before its end: a folder. Without a tilt, as soon as the bed is at rest.
void make_folder_of_run(const std::string& path, double tilt = 0.0);

/// The problem after the second frame of the run at `run`.
void make_problem(const std::string& run, const std::string& path);

/// Reads all that a run holds, goes on with it for a step, analyses it, and forms the problem of its first
/// frame. Throws as these do.
void use_run(const std::string& path);
/// The same of one that is open, at the path where its analysis is.
void use_run(const io::RunFile& run, const std::string& path);

/// Solves a problem, in a few passes.
void use_problem(const problems::StoredProblem& stored);
/// The same of the one at `path`.
void use_problem(const std::string& path);

}  // namespace talus::hostile
