#pragma once
/// Errors of calls.

#include <string>
#include <vector>

#include "base/errors.h"
#include "support/has.h"

namespace talus::test {

/// How a call ends: exit code and message of the Error that it throws, or `done` and no message.
struct Refusal {
  ExitCode code = ExitCode::done;
  std::string message;

  bool operator==(const Refusal&) const = default;
};

template <typename Call>
Refusal refusal_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  return {};
}

template <typename Call>
ExitCode exit_code_of(const Call& call) {
  return refusal_of(call).code;
}

/// Returns whether a call throws an Error with this exit code, whose message has all of these parts.
template <typename Call>
testing::AssertionResult refuses(const Call& call, ExitCode code,
                                 const std::vector<std::string>& parts = {}) {
  const Refusal refusal = refusal_of(call);
  if (refusal.code != code)
    return testing::AssertionFailure() << "exit code " << static_cast<int>(refusal.code) << ", expected "
                                       << static_cast<int>(code) << ": " << refusal.message;
  return has_all(refusal.message, parts);
}

/// Returns the message of a call that takes bad data; none if it accepts them.
template <typename Call>
std::string message_of(const Call& call) {
  const Refusal refusal = refusal_of(call);
  EXPECT_TRUE(refusal.code == ExitCode::bad_data || refusal.code == ExitCode::done) << refusal.message;
  return refusal.message;
}

}  // namespace talus::test
