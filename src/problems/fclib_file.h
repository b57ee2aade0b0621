#pragma once
/// Contact problems in files that other solvers read and write: two-dimensional local problems of FCLIB, the
/// Friction Contact Library (docs/problem_files.md).

#include <map>
#include <string>
#include <vector>

#include "core/types.h"
#include "io/child_process.h"
#include "io/run_schema.h"

namespace talus::problems {

/// Contents of a problem file. Vectors of unknowns are (n, t) of contact 0, (n, t) of contact 1, ...
struct FclibProblem {
  std::string title;

  std::vector<Index> row, column;  ///< position of each entry of W
  std::vector<double> value;       ///< value of each entry of W, 1/kg
  std::vector<double> q;           ///< m/s
  std::vector<double> mu;
  std::vector<double> guess_r;  ///< N s; empty if the file has no guess

  /// Data sets specific to Talus by their paths, /talus/...; empty in files of other programs.
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<Index>> integers;
};

/// Writes a problem with its guess and additional data sets; entries of W are sorted by row. The file appears
/// complete or not at all. `guess_u` is W guess_r + q.
void write_fclib(const std::string& path, const FclibProblem& problem, const std::vector<double>& guess_u);

/// Reads and checks a problem of any program. Throws Error(missing_input) if the file cannot be opened, and
/// Error(bad_data), naming the data set, if it is not a two-dimensional problem, is incomplete or not finite,
/// or has inconsistent sizes.
FclibProblem read_fclib(const std::string& path);

/// Returns the problem in the arrays of a file called `path`. Throws the errors of read_fclib.
FclibProblem checked_problem(const std::string& path, const io::Parcels& found);

/// Writes a copy of the problem file `from` to `to`, with r and u as its /solution, replacing an existing
/// one. `to` appears complete or not at all, and may be `from`.
void write_fclib_solution(const std::string& from, const std::string& to, const std::vector<double>& r,
                          const std::vector<double>& u);

/// Returns the table. The letters of the shapes are B bodies, C contacts, U = 2 C unknowns, E entries of W.
const std::vector<io::DataSetField>& fclib_schema();

/// Returns the row of a data set. Throws Error(internal) if the table does not contain it.
const io::DataSetField& fclib_field(const std::string& path);

}  // namespace talus::problems
