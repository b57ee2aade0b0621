/// Any text as a scenario: rejected with places, or accepted and then identical after writing and reading it.

#include "scenario/scenario.h"

#include <cstdint>
#include <cstdlib>

#include "base/errors.h"
#include "session/estimate.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  talus::scenario::Scenario scenario;
  try {
    // The parity of the first byte decides whether the text is a file or a setting of the command line.
    scenario = size > 0 && data[0] % 2 == 1 ? talus::scenario::parse_scenario("", "f.toml", {text.substr(1)})
                                            : talus::scenario::parse_scenario(text, "f.toml");
  } catch (const talus::LocatedError& error) {
    if (error.code() != talus::ExitCode::bad_data) std::abort();
    return 0;
  }
  if (talus::scenario::parse_scenario(talus::scenario::resolved_toml(scenario), "again.toml") != scenario)
    std::abort();
  talus::session::estimate(scenario);
  return 0;
}
