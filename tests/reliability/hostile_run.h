#pragma once
/// A run to damage, and all uses of a stored run.

#include <string>

#include "io/run_file.h"
#include "problems/problem_file.h"

namespace talus::hostile {

/// Computes a small bed between walls, with commands, to its end, and stores its analysis in its file.
void make_run(const std::string& path);

/// Computes the same, stopped at a tilt (deg) before its end, which leaves a folder. Without a tilt, it stops
/// as soon as the bed is at rest.
void make_folder_of_run(const std::string& path, double tilt = 0.0);

/// Writes the problem after the second frame of the run at `run`.
void make_problem(const std::string& run, const std::string& path);

/// Reads everything in a run, continues it for a step, analyses it, and forms the problem of its first frame.
/// Throws the errors of these.
void use_run(const std::string& path);
/// Does the same with an open run; `path` is that of its analysis.
void use_run(const io::RunFile& run, const std::string& path);

/// Solves a problem in a few sweeps.
void use_problem(const problems::StoredProblem& stored);
/// Does the same with the problem at `path`.
void use_problem(const std::string& path);

}  // namespace talus::hostile
