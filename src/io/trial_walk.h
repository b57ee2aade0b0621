#pragma once
/// Trial of a run in a child process, for programs that a crash of HDF5 must not end. Private to src/io,
/// except for walk_before_opening.

#include <string>

namespace talus::io {

/// Lets RunFile::open try each run in a child process before it opens it: some malformed files whose hash is
/// right make HDF5 crash. The library calls this; the program reports such a crash itself, and exits. Returns
/// true.
bool walk_before_opening();

/// Walks through the files of a run, and opens it, in a child process, if walk_before_opening was called and
/// the files have not been tried before. `run`: its packed file or its folder. Throws Error(bad_data) if HDF5
/// crashes or hangs; errors in the run are left to the code that opens it, and without a child process there
/// is no trial.
void try_run(const std::string& run);

}  // namespace talus::io
