// Copies a bed close to failure, and tilts the copies with more and less friction.
// usage: branches SCENARIO.toml TILT [KEY=VALUE...]

#include <talus/talus.h>

#include <cstdio>
#include <cstdlib>

int main(int count, char** arguments) {
  try {
    if (count < 3)
      throw talus::Error(talus::ExitCode::usage, "usage: branches SCENARIO.toml TILT [KEY=VALUE...]");
    talus::Simulation bed(talus::read_scenario(arguments[1], {arguments + 3, arguments + count}));
    bed.deposit();
    bed.tilt_to(std::atof(arguments[2]));
    for (const double friction : {0.3, 0.5, 0.7}) {
      talus::Simulation branch = bed;
      branch.set_friction(friction);
      branch.finish();
      const auto theta_c = branch.theta_c();
      std::printf("friction %.1f: ", friction);
      theta_c ? std::printf("fails at %.2f deg\n", *theta_c) : std::printf("stands\n");
    }
  } catch (const talus::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
