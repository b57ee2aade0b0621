#include "session/run_header.h"

#include <unistd.h>

#include <ctime>

#include "core/version.h"

namespace talus {
namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string host_name() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

/// All keys stand in a stored scenario, so one that lacks this key is from before it.
constexpr const char* key_of_poured_beds = "arrival_speed";

}  // namespace

RunHeader run_header(const Session& session, const RunOrigin& origin) {
  RunHeader header;
  header.statics = run_statics(session.scenario(), session.world());
  header.scenario_given = origin.scenario_text;
  header.scenario_resolved = resolved_toml(session.scenario());
  header.seed = session.scenario().seed;
  header.provenance = {{"version", version},
                       {"git_hash", git_hash},
                       {"compiler", compiler},
                       {"flags", build_flags},
                       {"host", host_name()},
                       {"threads", std::to_string(origin.threads)},
                       {"start", utc_now()},
                       {"command", origin.command_line},
                       {"scenario_file", origin.scenario_file}};
  return header;
}

Scenario stored_scenario(const RunHeader& header, const std::string& name) {
  Scenario scenario = parse_scenario(header.scenario_resolved, name);
  if (header.scenario_resolved.find(key_of_poured_beds) == std::string::npos) {
    scenario.deposition.method = DepositionMethod::collapse;
    scenario.deposition.wall_friction = scenario.deposition.friction;
  }
  return scenario;
}

}  // namespace talus
