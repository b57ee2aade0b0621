#include "reliability/branched_run.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "io/bounds.h"
#include "io/run_file.h"
#include "reliability/hostile_run.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/small_bed.h"

namespace talus::hostile {
namespace {

constexpr std::int64_t to_the_end = 1'000'000;
constexpr std::size_t left_at = 2;  ///< frame of the parent

scenario::Scenario bed() {
  scenario::Scenario scenario = test::small_tilted_bed(3.0);
  scenario.bed.boundary = scenario::BedBoundary::walls;
  scenario.bed.depth = 2.0;
  return scenario;
}

void make_parent(const std::string& path) {
  session::Session probe(bed());
  while (probe.phase() == session::Phase::deposition) probe.advance();
  const std::int64_t step = probe.world().step;
  const Grains& grains = probe.world().grains;
  const std::vector<Command> commands = {{0, CommandKind::friction, -1, 0.6},
                                         {step + 2, CommandKind::tilt_rate, -1, 15.0},
                                         {step + 5, CommandKind::drag, 7, grains.x[7], grains.y[7]}};
  session::Session session(bed());
  io::RunStore store = io::RunStore::create(path, session::run_header(session, {}), false);
  session::replay(session, &store, commands, to_the_end, {});
}

}  // namespace

void make_branch(const std::string& parent, const std::string& branch, bool complete) {
  if (!std::filesystem::exists(parent)) make_parent(parent);
  const io::RunFile run = io::RunFile::open(parent);
  const io::BranchOrigin origin = {parent, static_cast<std::int64_t>(left_at),
                                   hash_text(state_hash(run.checkpoint().world)),
                                   session::checkpoint_at_frame(run, left_at)};
  session::Session session(bed(), origin.start);
  session.record_start();
  session::RunOrigin of_run;
  of_run.branch = origin;
  io::RunStore store = io::RunStore::create(branch, session::run_header(session, of_run), false);
  const std::int64_t begin = origin.start.world.step;
  const std::vector<Command> commands = {{begin + 3, CommandKind::push, 4, 0.1, 0.1}};
  session::replay(session, &store, commands, complete ? to_the_end : begin + 60, {});
}

void store_with_start(const std::string& branch, const std::string& path,
                      const std::function<void(io::BranchOrigin&)>& change) {
  const io::RunFile run = io::RunFile::open(branch);
  io::RunHeader header = run.header();
  change(*header.branch);
  io::Segment segment;
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) segment.frames.push_back(run.frame(k));
  segment.observables = run.all_observables();
  segment.steps = run.steps();
  segment.commands = run.commands();
  std::filesystem::remove_all(io::run_folder(path));
  std::filesystem::remove(path);
  io::checks_what_is_written = false;
  io::RunStore::create(path, header, false).commit(segment, run.checkpoint());
  io::checks_what_is_written = true;
}

void use_branch(const std::string& path) {
  const io::RunFile run = io::RunFile::open(path);
  session::Session session = session::session_at_start(run.header(), path);
  session.advance();
  use_run(run, path);
  session::checkpoint_at_frame(run, 0);
}

}  // namespace talus::hostile
