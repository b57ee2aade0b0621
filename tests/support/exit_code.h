#pragma once
/// How a call ends.

#include "base/errors.h"

namespace talus::test {

/// The exit code of the Error that a call throws, `done` where it throws none.
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
