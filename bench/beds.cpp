#include "beds.h"

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "tiling.h"

namespace talus::bench {
namespace {

constexpr Index tile_grains = 4000;

/// Returns the scenario of a deposited bed; no value if the bed is tiled.
std::optional<scenario::Scenario> scenario_of(Index grains) {
  scenario::Scenario scenario;
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

std::string path_of(Index grains, const std::string& state) {
  return std::string(TALUS_BENCH_BEDS) + "/bed-" + std::to_string(grains) + "-" + state + ".h5";
}

void save(const scenario::Scenario& scenario, const io::Segment& segment, const io::Checkpoint& checkpoint,
          const std::string& path) {
  std::filesystem::create_directories(TALUS_BENCH_BEDS);
  io::RunHeader header;
  header.statics = session::run_statics(scenario, checkpoint.world);
  header.scenario_given = header.scenario_resolved = scenario::resolved_toml(scenario);
  header.seed = scenario.seed;
  io::RunStore store = io::RunStore::create(path, header, true);
  store.commit(segment, checkpoint);
  store.pack();
}

void advance_to(session::Phase end, session::Session session, const std::string& path) {
  while (session.phase() != end) session.advance();
  save(session.scenario(), session.segment(), session.checkpoint(0.0), path);
}

/// Returns the flat bed, which is deposited if it is not stored yet.
io::Checkpoint flat_bed(Index grains, const scenario::Scenario& scenario) {
  const std::string path = path_of(grains, "flat");
  if (!std::filesystem::exists(path)) advance_to(session::Phase::tilt, session::Session(scenario), path);
  return io::RunFile::open(path).checkpoint();
}

/// Returns the tilted bed, which is computed if it is not stored yet.
io::Checkpoint tilted_bed(Index grains, const scenario::Scenario& scenario) {
  const std::string path = path_of(grains, "ten-degrees");
  if (!std::filesystem::exists(path))
    advance_to(session::Phase::done, session::Session(scenario, flat_bed(grains, scenario)), path);
  return io::RunFile::open(path).checkpoint();
}

void hold_until_rest(World& world, double h) {
  constexpr int quiet_steps = 50;
  dynamics::StepSettings settings = session::step_settings(scenario::Scenario{});
  settings.h = h;
  dynamics::StepWorkspace workspace;
  const double rest = scenario::Scenario{}.deposition.rest_velocity * world.gravity * h;
  for (int quiet = 0; quiet < quiet_steps;)
    quiet = dynamics::step(world, settings, workspace).motion.rms_velocity < rest ? quiet + 1 : 0;
}

/// Returns the tilted bed after holding it at its angle with steps of h until it is at rest, because it may
/// be rearranging when it reaches the angle. Computed if it is not stored yet.
io::Checkpoint rested_bed(Index grains, const scenario::Scenario& scenario, double h) {
  const std::string path =
      path_of(grains, "ten-degrees-rest-" + std::to_string(std::llround(1e9 * h)) + "ns");
  if (!std::filesystem::exists(path)) {
    io::Checkpoint checkpoint = tilted_bed(grains, scenario);
    hold_until_rest(checkpoint.world, h);
    save(scenario, {}, checkpoint, path);
  }
  return io::RunFile::open(path).checkpoint();
}

World bed_at_rest(Index grains, Slope slope, double h) {
  if (const std::optional<scenario::Scenario> scenario = scenario_of(grains))
    return (slope == Slope::flat ? flat_bed(grains, *scenario) : rested_bed(grains, *scenario, h)).world;
  if (grains <= 0 || grains % tile_grains != 0)
    throw Error(ExitCode::usage, "no bed of " + std::to_string(grains) +
                                     " grains: expected 500, 2000 or a multiple of " +
                                     std::to_string(tile_grains));
  return tiled(bed_at_rest(tile_grains, slope, h), grains / tile_grains);
}

}  // namespace

World bed(Index grains, Slope slope, double h) {
  World world = bed_at_rest(grains, slope, h);
  if (slope == Slope::ten_degrees) world.tilt += radians(scenario::Scenario{}.tilt.step);
  return world;
}

session::Session session_at_tilt(Index grains) {
  const scenario::Scenario scenario = scenario_of(grains).value();
  return session::Session(scenario, flat_bed(grains, scenario));
}

}  // namespace talus::bench
