#pragma once
/// Exit codes of calls.

#include "base/errors.h"

namespace talus::test {

/// Returns the exit code of the Error that a call throws, or `done` if it throws none.
template <typename Call>
ExitCode exit_code_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::done;
}

}  // namespace talus::test
