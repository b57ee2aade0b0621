#include "beds.h"

#include <filesystem>
#include <optional>
#include <string>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "session/session.h"
#include "tiling.h"

namespace talus::bench {
namespace {

constexpr Index tile_grains = 4000;

/// No value where the bed is not deposited but tiled.
std::optional<Scenario> scenario_of(Index grains) {
  Scenario scenario;
  switch (grains) {
    case 500:
      scenario.bed.length = 25.0;
      break;
    case 2000:
      scenario.bed.length = 50.0;
      break;
    case tile_grains:
      scenario.bed.length = 100.0;
      break;
    case 8000:
      scenario.bed.length = 200.0;
      break;
    default:
      return std::nullopt;
  }
  scenario.bed.depth = grains / scenario.bed.length;
  scenario.tilt.end_angle = 10.0;
  scenario.output.frame_every = 10.0;
  return scenario;
}

std::string path_of(Index grains, Slope slope) {
  return std::string(TALUS_BENCH_BEDS) + "/bed-" + std::to_string(grains) +
         (slope == Slope::flat ? "-flat.h5" : "-ten-degrees.h5");
}

void save(const Session& session, const std::string& path) {
  RunHeader header;
  header.statics = run_statics(session.scenario(), session.world());
  header.scenario_given = header.scenario_resolved = resolved_toml(session.scenario());
  header.seed = session.scenario().seed;
  RunStore store = RunStore::create(path, header, true);
  store.commit(session.segment(), session.checkpoint(0.0));
  store.pack();
}

void advance_to(Phase end, Session session, const std::string& path) {
  while (session.phase() != end) session.advance();
  save(session, path);
}

/// Deposits and tilts where that has not been done before.
Checkpoint deposited(Index grains, const Scenario& scenario, Slope slope) {
  const std::string path = path_of(grains, slope);
  if (!std::filesystem::exists(path)) {
    std::filesystem::create_directories(TALUS_BENCH_BEDS);
    if (slope == Slope::flat)
      advance_to(Phase::tilt, Session(scenario), path);
    else
      advance_to(Phase::done, Session(scenario, deposited(grains, scenario, Slope::flat)), path);
  }
  return RunFile::open(path).checkpoint();
}

/// A bed may be in the midst of a rearrangement when it reaches its angle: it rests with the step of a run,
/// and takes some steps of length h more.
void hold_until_rest(World& world, double h) {
  constexpr int quiet_steps = 50;
  constexpr int steps_of_h = 300;
  StepSettings settings = step_settings(Scenario{});
  StepWorkspace workspace;
  const double rest = Scenario{}.deposition.rest_velocity * world.gravity * settings.h;
  for (int quiet = 0; quiet < quiet_steps;)
    quiet = step(world, settings, workspace).rms_velocity < rest ? quiet + 1 : 0;
  settings.h = h;
  for (int k = 0; k < steps_of_h; ++k) step(world, settings, workspace);
}

World bed_at_rest(Index grains, Slope slope, double h) {
  if (const std::optional<Scenario> scenario = scenario_of(grains)) {
    World world = deposited(grains, *scenario, slope).world;
    if (slope == Slope::ten_degrees) hold_until_rest(world, h);
    return world;
  }
  if (grains <= 0 || grains % tile_grains != 0)
    throw Error(ExitCode::usage, "no bed of " + std::to_string(grains) +
                                     " grains: expected 500, 2000 or a multiple of " +
                                     std::to_string(tile_grains));
  return tiled(bed_at_rest(tile_grains, slope, h), grains / tile_grains);
}

}  // namespace

World bed(Index grains, Slope slope, double h) {
  World world = bed_at_rest(grains, slope, h);
  if (slope == Slope::ten_degrees) world.tilt += radians(Scenario{}.tilt.step);
  return world;
}

}  // namespace talus::bench
