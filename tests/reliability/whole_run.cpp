#include "reliability/whole_run.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "base/hash.h"
#include "io/run_file.h"
#include "support/places.h"

namespace talus::test {
namespace {

/// Returns the value of TALUS_RELIABILITY; 0 for few tries.
double thoroughness() {
  const char* text = std::getenv("TALUS_RELIABILITY");
  return text == nullptr ? 0.0 : std::atof(text);
}

void add(Hasher& hasher, const Frame& frame) {
  hasher.add(frame.step);
  hasher.add(frame.time);
  hasher.add(frame.tilt);
  for (const auto* array :
       {&frame.x, &frame.y, &frame.angle, &frame.vx, &frame.vy, &frame.omega, &frame.gamma})
    hasher.add_array(*array);
  hasher.add_array(frame.image);
  hasher.add_array(frame.internal_moment);
  const FrameContacts& contacts = frame.contacts;
  for (const auto* array :
       {&contacts.nx, &contacts.ny, &contacts.px, &contacts.py, &contacts.fn, &contacts.ft})
    hasher.add_array(*array);
  hasher.add_array(contacts.a);
  hasher.add_array(contacts.b);
  hasher.add_array(contacts.shift);
  hasher.add_array(contacts.status);
}

}  // namespace

int tries(int few, int many) {
  const double share = thoroughness();
  return share > 0.0 ? std::max(1, static_cast<int>(share * many)) : few;
}

int stride(int count, int few) { return std::max(1, count / std::max(1, tries(few, count))); }

const char* const tiny_bed =
    "seed = 5\n[bed]\nlength = 10\ndepth = 3\n[deposition]\nrest_velocity = 0.1\n"
    "[tilt]\nrate = 20\nstep = 0.02\nend_angle = 3.5\n[output]\nframe_every = 0.5\nobservable_every = 0.1\n";

const char* const short_bed =
    "seed = 3\n[bed]\nlength = 16\ndepth = 6\n[tilt]\nend_angle = 3.0\n[output]\nframe_every = 0.25\n"
    "checkpoint_every = 0.05\n";

std::string digest(const std::string& path) {
  const io::RunFile run = io::RunFile::open(path);
  Hasher hasher;
  hasher.add_array(run.header().scenario_resolved);
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) add(hasher, run.frame(k));
  hasher.add_array(run.all_observables());
  hasher.add_array(run.steps());
  hasher.add(static_cast<std::uint64_t>(run.commands().size()));
  const io::Checkpoint& checkpoint = run.checkpoint();
  for (const auto& [name, value] : checkpoint.integers) hasher.add(value);
  for (const auto& [name, value] : checkpoint.reals) hasher.add(value);
  for (const auto& [name, value] : checkpoint.results) hasher.add(value);
  hasher.add(state_hash(checkpoint.world));
  return hash_text(hasher.value()) + (run.complete() ? " complete" : " not complete");
}

std::string frame_digest(const Frame& frame) {
  Hasher hasher;
  add(hasher, frame);
  return hash_text(hasher.value());
}

int committed_frames(const std::string& path) {
  if (io::run_presence(path) == io::RunPresence::none) return 0;
  const io::RunFile run = io::RunFile::open(path);
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) run.frame(k);
  return static_cast<int>(run.all_frame_tilts().size());
}

Words with_fault(const std::string& fault) {
  return {"LD_PRELOAD=" + faults_library(), "TALUS_FAULT=" + fault};
}

Counts count_calls(const Words& arguments, const TemporaryFolder& folder) {
  Words environment = with_fault("none");
  const std::string path = folder.path("counts.txt");
  environment.push_back("TALUS_FAULT_COUNT=" + path);
  Counts counts;
  if (run_talus(arguments, folder.path(), environment).exit_code == 0) counts = read_counts(path);
  return counts;
}

Counts read_counts(const std::string& path) {
  Counts counts;
  std::ifstream file(path);
  file >> counts.calls >> counts.allocations >> std::ws;
  std::getline(file, counts.struck);
  return counts;
}

}  // namespace talus::test
