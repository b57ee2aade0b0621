// Tilts a bed until half of its grains are overloaded, holds it there for three seconds, and draws it.
// usage: stop_at_fraction SCENARIO.toml [KEY=VALUE...]

#include <talus/talus.h>

#include <cstdio>

int main(int count, char** arguments) {
  try {
    if (count < 2)
      throw talus::Error(talus::ExitCode::usage, "usage: stop_at_fraction SCENARIO.toml [KEY=VALUE...]");
    talus::Simulation sim(talus::read_scenario(arguments[1], {arguments + 2, arguments + count}));
    sim.record("held.h5", true);
    sim.deposit();
    while (!sim.done() && sim.quantity("overloaded/fraction") < 0.5) sim.tilt_by(0.25);
    if (!sim.done()) {
      sim.set_tilt_rate(0.0);
      sim.run(3.0);
    }
    std::printf("%.2f deg: %.0f %% of the grains are overloaded; state %s\n", sim.tilt(),
                100.0 * sim.quantity("overloaded/fraction"), sim.state_hash().c_str());
    write_png("held.png", sim.draw("gamma"));
  } catch (const talus::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
