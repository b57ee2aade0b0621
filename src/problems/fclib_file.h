#pragma once
/// Contact problems as files that other solvers read and write: local problems of FCLIB, the Friction Contact
/// Library, in two dimensions (docs/problem_files.md).

#include <map>
#include <string>
#include <vector>

#include "core/types.h"
#include "io/child_process.h"

namespace talus::problems {

/// What a problem file holds. Vectors of unknowns are (n, t) of contact 0, (n, t) of contact 1, ...
struct FclibProblem {
  std::string title;

  std::vector<Index> row, column;  ///< of the entries of W
  std::vector<double> value;       ///< of the entries of W, 1/kg
  std::vector<double> q;           ///< m/s
  std::vector<double> mu;
  std::vector<double> guess_r;  ///< N s; empty where the file has no guess

  /// Data sets of Talus' own by their paths, /talus/...; empty in files of other programs.
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<Index>> integers;
};

/// Writes a problem with its guess and what belongs to it; entries of W are sorted by row. The file appears
/// whole or not at all. `guess_u` is W guess_r + q.
void write_fclib(const std::string& path, const FclibProblem& problem, const std::vector<double>& guess_u);

/// Reads and checks a problem of any program. Throws Error(missing_input) where the file cannot be opened,
/// and Error(bad_data), naming the data set, where it is no problem in two dimensions, or is not whole,
/// finite and of sizes that fit.
FclibProblem read_fclib(const std::string& path);

/// The problem in the arrays of a file called `path`; throws as read_fclib does.
FclibProblem checked_problem(const std::string& path, const io::Parcels& found);

/// Writes a copy of the problem file `from` to `to`, with r and u as its /solution, in place of one that it
/// has. `to` appears whole or not at all, and may be `from`.
void write_fclib_solution(const std::string& from, const std::string& to, const std::vector<double>& r,
                          const std::vector<double>& u);

}  // namespace talus::problems
