#pragma once
/// Error handling of the main function of each benchmark program.

#include <cstdio>

#include "base/errors.h"

namespace talus::bench {

/// Returns the result of run(argc, argv), or the exit code of its error.
template <typename Run>
int run_program(const char* name, const Run& run, int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: error: %s\n", name, error.what());
    return static_cast<int>(error.code());
  }
}

}  // namespace talus::bench
