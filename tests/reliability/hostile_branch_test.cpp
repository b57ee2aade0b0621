/// Branches whose /branch is damaged, or intact but impossible for their run: every command reports it in one
/// message, or does not need it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/hash.h"
#include "core/random.h"
#include "io/child_process.h"
#include "io/run_file.h"
#include "io/run_store.h"
#include "reliability/hostile_run.h"
#include "reliability/hostile_test.h"
#include "reliability/whole_run.h"
#include "session/frame_state.h"
#include "session/run.h"
#include "session/run_check.h"
#include "session/run_header.h"
#include "support/small_bed.h"

namespace talus::hostile {
namespace {

namespace fs = std::filesystem;

constexpr int done = 0, bad_data = 65;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

/// Computes a bed between walls as `parent`, in which commands set friction and tilt rate and drag a grain,
/// and a branch from a frame at which all three are in effect, with an additional push. If `complete`, the
/// runs are computed to their end as packed files; else they are stopped and remain folders.
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

/// Stores the run at `branch` again as the folder `path`, with a changed start and matching hashes.
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

/// Reads everything in a branch, restarts it from its own start and takes a step; then uses it like any other
/// run (hostile_run.h), and as the start of another branch. Throws the errors of these.
void use_branch(const std::string& path) {
  const io::RunFile run = io::RunFile::open(path);
  session::Session session = session::session_at_start(run.header(), path);
  session.advance();
  use_run(run, path);
  session::checkpoint_at_frame(run, 0);
}

void make_good(const test::CommandFolder& folder) {
  make_branch(folder.path("parent.h5"), folder.path("good.h5"), true);
  make_branch(folder.path("parent.h5"), folder.path("stopped.h5"), false);
}

class HostileBranch : public HostileFile<make_good> {
 protected:
  static Outcome talus(const Words& words) { return folder->talus(words); }

  /// Returns the stopped branch with another start.
  static std::string with_start(const std::function<void(io::BranchOrigin&)>& change) {
    const std::string path = folder->path("changed.h5");
    store_with_start(folder->path("stopped.h5"), path, change);
    return path;
  }
};

/// Uses the branch in a child process, within the time that a file of that size needs.
void use_apart(const std::string& path) {
  const std::string folder = io::run_folder(path);
  const std::string read = fs::exists(path) ? path : test::path_beginning(folder, "header_");
  io::in_child_process(path, fs::file_size(read), [&path] {
    use_branch(path);
    return io::Parcels();
  });
}

std::optional<std::string> refusal(const std::string& path) { return hostile::refusal(path, use_apart); }

bool is_of_branch(const std::string& path) { return path.starts_with("/branch/"); }

Words data_sets_of_branch(const Bytes& file) {
  Words paths = data_sets(file);
  std::erase_if(paths, [](const std::string& path) { return !is_of_branch(path); });
  return paths;
}

TEST_F(HostileBranch, is_the_good_one_to_begin_with) {
  EXPECT_EQ(refusal(bad(good)), std::nullopt);
  EXPECT_EQ(refusal(bad(spoilt(good, {}))), std::nullopt);
  EXPECT_EQ(refusal(with_start([](io::BranchOrigin&) {})), std::nullopt);
  EXPECT_EQ(refusal(folder->path("stopped.h5")), std::nullopt);
  const session::RunCheck check = session::check_run(io::RunFile::open(folder->path("good.h5")), {});
  EXPECT_TRUE(check.faults.empty()) << check.faults.front();
  EXPECT_GT(check.largest_mobilisation, 0.5 / 0.6) << "the friction set by a command is in effect";
  EXPECT_EQ(talus({"replay", "good.h5", "-q"}).exit_code, done);
}

TEST_F(HostileBranch, that_was_stopped_goes_on_to_the_end_of_one_that_was_not) {
  fs::copy(io::run_folder(folder->path("stopped.h5")), io::run_folder(folder->path("again.h5")));
  EXPECT_TRUE(ends(talus({"run", "--resume", "again.h5", "-q"}), done));
  EXPECT_EQ(folder->hash("again.h5"), folder->hash("good.h5"));
  EXPECT_EQ(talus({"replay", "again.h5", "-q"}).exit_code, done);
  EXPECT_EQ(talus({"check", "again.h5"}).exit_code, done);
}

TEST_F(HostileBranch, each_data_set_of_another_make_is_refused_by_name) {
  // Without one of these the start is different but valid; only the hashes of the parts reveal it.
  const auto may_be_missing = [](const std::string& path) {
    for (const char* name : {"/friction", "/deposition_friction", "/drag_grain", "/tilt_rate",
                             "/unconverged_in_a_row", "/last_largest_overlap", "/last_residual",
                             "/last_converged", "/last_friction", "/last_wall_friction"})
      if (path.ends_with(name)) return true;
    return false;
  };
  std::size_t refused = 0;
  for (const std::string& path : data_sets_of_branch(good))
    for (const Harm harm : {Harm::missing, Harm::group_instead, Harm::as_int64, Harm::as_text,
                            Harm::as_text_of_variable_length, Harm::as_compound, Harm::one_rank_more,
                            Harm::huge, Harm::values_in_another_file, Harm::external_link}) {
      const bool is_gone = harm == Harm::missing || harm == Harm::group_instead;
      const bool is_text_still = harm == Harm::as_text && path == "/branch/run";
      if (is_text_still || (is_gone && may_be_missing(path))) continue;
      SCOPED_TRACE(path + " " + name_of(harm));
      const Bytes bytes = spoilt(good, std::vector<Spoil>{{path, harm, 0, 0, folder->path("good.h5")}});
      const std::optional<std::string> message = refusal(bad(bytes));
      ASSERT_TRUE(message) << "was accepted";
      const auto leaf = path.rfind('/');
      EXPECT_TRUE(has(*message, path.substr(0, leaf)) || has(*message, "/branch/state_hash")) << *message;
      ++refused;
    }
  EXPECT_GT(refused, 300U);
}

TEST_F(HostileBranch, one_value_less_is_told_by_check) {
  for (const char* path :
       {"/branch/reals/friction", "/branch/reals/deposition_friction", "/branch/integers/drag_grain"}) {
    const io::RunFile run =
        io::RunFile::open(bad(spoilt(good, std::vector<Spoil>{{path, Harm::missing, 0, 0, {}}})));
    const session::RunCheck check = session::check_run(run, {});
    EXPECT_TRUE(std::ranges::any_of(check.faults, [&path](const std::string& fault) {
      return fault.starts_with(path);
    })) << path;
  }
}

TEST_F(HostileBranch, sizes_and_values_of_chance_are_refused_or_harmless) {
  const int count = tries(150);
  EXPECT_GT(refusals_of_chance(use_apart, data_sets_of_branch(good), 60, count), count / 2);
}

/// Start that no run of this scenario has, with matching hashes.
struct WrongStart {
  const char* named;  ///< data set in the message
  std::function<void(io::BranchOrigin&)> change;
};

void set(std::vector<std::pair<std::string, double>>& values, const std::string& name, double to) {
  std::ranges::find(values, name, &std::pair<std::string, double>::first)->second = to;
}

void set(std::vector<std::pair<std::string, std::int64_t>>& values, const std::string& name,
         std::int64_t to) {
  std::ranges::find(values, name, &std::pair<std::string, std::int64_t>::first)->second = to;
}

WrongStart with_integer(const char* named, const std::string& name, std::int64_t to) {
  return {named, [=](io::BranchOrigin& branch) { set(branch.start.integers, name, to); }};
}

WrongStart with_real(const char* named, const std::string& name, double to) {
  return {named, [=](io::BranchOrigin& branch) { set(branch.start.reals, name, to); }};
}

WrongStart with_grain(const char* named, std::vector<double> Grains::*member, double to) {
  return {named, [=](io::BranchOrigin& branch) { (branch.start.world.grains.*member)[3] = to; }};
}

template <typename Value>
WrongStart with_world(const char* named, Value World::*member, Value to) {
  return {named, [=](io::BranchOrigin& branch) { branch.start.world.*member = to; }};
}

std::vector<WrongStart> wrong_starts() {
  constexpr std::int64_t huge = std::int64_t{1} << 62;
  return {
      {"/branch/frame", [](io::BranchOrigin& branch) { branch.frame = -1; }},
      {"/branch/frame", [](io::BranchOrigin& branch) { branch.frame = huge; }},
      {"/branch/run_hash", [](io::BranchOrigin& branch) { branch.run_hash = "no hash"; }},
      {"/branch/run_hash", [](io::BranchOrigin& branch) { branch.run_hash.replace(0, 4, "\x1b[2J"); }},
      with_world("/branch/integers/tilt_steps", &World::step, std::int64_t{10}),
      with_world("/branch/time", &World::time, -1.0),
      with_world("/branch/time", &World::time, nan),
      with_world("/branch/tilt", &World::tilt, 0.5),
      with_grain("/branch/x", &Grains::x, -1e4),
      with_grain("/branch/vx", &Grains::vx, 1e300),
      with_grain("/branch/vy", &Grains::vy, -1e9),
      with_grain("/branch/omega", &Grains::omega, 1e300),
      with_grain("/branch/radius", &Grains::radius, 1e-300),
      with_grain("/branch/radius", &Grains::radius, 0.0),
      with_grain("/branch/mass", &Grains::mass, 1.0),
      with_grain("/branch/inverse_mass", &Grains::inverse_mass, 0.0),
      with_grain("/branch/inverse_mass", &Grains::inverse_mass, 1e300),
      with_grain("/branch/inverse_inertia", &Grains::inverse_inertia, 0.0),
      with_grain("/branch/inverse_inertia", &Grains::inertia, 0.0),
      {"/branch/free_count", [](io::BranchOrigin& branch) { --branch.start.world.grains.free_count; }},
      {"/branch/free_count", [](io::BranchOrigin& branch) { branch.start.world.grains.free_count = -1; }},
      {"/branch/radius",
       [](io::BranchOrigin& branch) {
         Grains& grains = branch.start.world.grains;
         for (auto member : {&Grains::x, &Grains::y, &Grains::vx, &Grains::vy, &Grains::omega,
                             &Grains::radius, &Grains::inverse_mass, &Grains::inverse_inertia, &Grains::mass,
                             &Grains::inertia, &Grains::angle})
           (grains.*member).pop_back();
         grains.image.pop_back();
         branch.start.world.contacts.resize(0);
       }},
      {"/branch/periodic", [](io::BranchOrigin& branch) { branch.start.world.boundary.periodic = true; }},
      {"/branch/length", [](io::BranchOrigin& branch) { branch.start.world.boundary.length *= 2.0; }},
      {"/branch/plane_normal",
       [](io::BranchOrigin& branch) {
         branch.start.world.boundary.planes.pop_back();
         branch.start.world.contacts.resize(0);
       }},
      {"/branch/plane_normal",
       [](io::BranchOrigin& branch) { branch.start.world.boundary.planes[0].normal.x = 0.0; }},
      {"/branch/plane_normal",
       [](io::BranchOrigin& branch) { branch.start.world.boundary.planes[0].offset = 0.05; }},
      {"/branch/contact_pair",
       [](io::BranchOrigin& branch) {
         Contacts& contacts = branch.start.world.contacts;
         std::ranges::reverse(contacts.a);
         std::ranges::reverse(contacts.b);
       }},
      {"/branch/contact_shift", [](io::BranchOrigin& branch) { branch.start.world.contacts.shift[0] = 101; }},
      with_integer("/branch/integers/phase", "phase", 0),
      with_integer("/branch/integers/phase", "phase", 2),
      with_integer("/branch/integers/phase", "phase", 3),
      with_integer("/branch/integers/tilt_steps", "tilt_steps", huge),
      with_integer("/branch/tilt", "tilt_steps", 100),
      with_integer("/branch/integers/quiet_steps", "quiet_steps", huge / 1024),
      with_integer("/branch/integers/tilt_since", "tilt_since", huge / 1024),
      with_integer("/branch/integers/drag_grain", "drag_grain", 1000),
      with_integer("/branch/integers/drag_grain", "drag_grain", -1),
      {"/branch/integers/phase", [](io::BranchOrigin& branch) { branch.start.integers.clear(); }},
      {"/branch/reals/", [](io::BranchOrigin& branch) { branch.start.reals.clear(); }},
      {"/branch/integers/last_tilt_step",
       [](io::BranchOrigin& branch) { branch.start.integers.emplace_back("last_tilt_step", 3); }},
      with_real("/branch/reals/friction", "friction", -1.0),
      with_real("/branch/reals/friction", "friction", 1e300),
      with_real("/branch/tilt", "tilt_from", 1.0),
      with_real("/branch/reals/baseline_volume", "baseline_volume", 0.0),
      with_real("/branch/reals/surface_height", "surface_height", std::numeric_limits<double>::infinity()),
      with_real("/branch/reals/drag_x", "drag_x", 1e300),
  };
}

TEST_F(HostileBranch, that_begins_with_no_state_of_its_run_is_refused_by_name) {
  for (const WrongStart& wrong : wrong_starts()) {
    SCOPED_TRACE(wrong.named);
    const std::string path = with_start(wrong.change);
    const std::optional<std::string> message = refusal(path);
    ASSERT_TRUE(message) << "was accepted";
    // The message begins with a file of the folder, or with the run.
    EXPECT_TRUE(has(*message, std::string("data set ") + wrong.named));
  }
}

/// Expects one message without terminal control sequences.
void expect_reported(const Outcome& outcome, bool refused) {
  EXPECT_EQ(outcome.exit_code, refused ? bad_data : done) << outcome.err;
  test::expect_no_controls(outcome);
  if (!refused) return;
  EXPECT_EQ(test::count_of(outcome.err, "talus: error: "), 1u) << outcome.err;
  EXPECT_TRUE(has(outcome.err + outcome.out, "/branch/")) << outcome.err << outcome.out;
}

/// Unreadable data are reported by every command; readable data that are no state of the scenario are
/// reported by the commands that use them.
TEST_F(HostileBranch, is_told_by_every_command) {
  const auto in = [](const char* named, bool read, const std::function<void(io::BranchOrigin&)>& change) {
    SCOPED_TRACE(named);
    with_start(change);
    fs::remove(folder->path("view.png"));
    expect_reported(talus({"info", "changed.h5"}), !read);
    expect_reported(talus({"info", "changed.h5", "--json"}), !read);
    expect_reported(talus({"check", "changed.h5"}), true);
    expect_reported(talus({"replay", "changed.h5"}), true);
    expect_reported(
        talus({"render", "changed.h5", "--map", "pressure", "--at", "1.3", "-o", "maps", "--overwrite"}),
        !read);
    const Outcome view = talus({"view", "changed.h5", "--screenshot", "view.png", "--size", "400x300"});
    if (!has(view.err, "without its window")) expect_reported(view, !read);
    EXPECT_TRUE(read || !folder->has_file("view.png"));
    expect_reported(talus({"repair", "changed.h5", "-o", "repaired.h5"}), !read);
    EXPECT_FALSE(folder->has_file("repaired.h5"));
    expect_reported(talus({"run", "--resume", "changed.h5", "-q"}), !read);
  };
  in("a bed of other grains", false,
     [](io::BranchOrigin& origin) { origin.start.world.grains.radius[3] *= 1.1; });
  in("a frame out of range", false, [](io::BranchOrigin& origin) { origin.frame = std::int64_t{1} << 40; });
  in("a tilt that is none", false, [](io::BranchOrigin& origin) { origin.start.world.tilt = nan; });
  in("another tilt", true, [](io::BranchOrigin& origin) { origin.start.world.tilt = 0.3; });
  in("a friction that is none", true,
     [](io::BranchOrigin& origin) { set(origin.start.reals, "friction", nan); });
  in("no phase", true, [](io::BranchOrigin& origin) { origin.start.integers.clear(); });
}

TEST_F(HostileBranch, names_reach_no_terminal_raw) {
  const std::string attack =
      "\x1b]0;owned\a\x1b[2J\xc2\x9b"
      "31m\r\xff\x7f";
  const std::string path = with_start([&attack](io::BranchOrigin& branch) {
    branch.run = attack;
    branch.start.integers.emplace_back(attack, 1);
    branch.start.reals.emplace_back(attack, nan);
  });
  EXPECT_EQ(refusal(path), std::nullopt) << "a name that is never requested";
  for (const Words& words : {Words{"info", "changed.h5"},
                             {"info", "changed.h5", "--json"},
                             {"check", "changed.h5"},
                             {"replay", "changed.h5"},
                             {"repair", "changed.h5", "-o", "repaired.h5"},
                             {"run", "--resume", "changed.h5"}}) {
    const Outcome outcome = talus(words);
    EXPECT_EQ(outcome.exit_code, done) << words[0] << ": " << outcome.err;
    test::expect_no_controls(outcome);
  }
  EXPECT_TRUE(has(talus({"info", "changed.h5"}).out, "branch of           \\x1b]0;owned"));
}

TEST_F(HostileBranch, of_another_run_is_told_by_check_and_by_replay) {
  const io::RunFile parent = io::RunFile::open(folder->path("parent.h5"));
  const io::Checkpoint elsewhere = session::checkpoint_at_frame(parent, 3);
  with_start([&elsewhere](io::BranchOrigin& branch) { branch.start = elsewhere; });
  const Outcome check = talus({"check", "changed.h5"});
  EXPECT_EQ(check.exit_code, bad_data);
  EXPECT_TRUE(has(check.out, "/branch: is not the state of the first frame"));
  EXPECT_NE(talus({"replay", "changed.h5", "-q"}).exit_code, done);
}

/// The repaired run has no start, can be used like any other, and reports what is missing.
TEST_F(HostileBranch, of_which_the_start_is_damaged_is_repaired_without_it) {
  const std::string path = bad(spoilt(good, std::vector<Spoil>{{"/branch/vx", Harm::one_value, 2, 10, {}}}));
  const Outcome check = talus({"check", "bad.h5"});
  EXPECT_EQ(check.exit_code, bad_data);
  EXPECT_TRUE(has(check.out, "fault: /branch/vx: is not as it was written"));
  fs::remove(folder->path("kept.h5"));
  const Outcome repair = talus({"repair", "bad.h5", "-o", "kept.h5"});
  EXPECT_EQ(repair.exit_code, done) << repair.err;
  EXPECT_TRUE(has(repair.out + repair.err, "all of /branch is left out")) << repair.out;
  const io::RunFile kept = io::RunFile::open(folder->path("kept.h5")),
                    whole = io::RunFile::open(folder->path("good.h5"));
  EXPECT_FALSE(kept.header().branch);
  EXPECT_EQ(kept.all_frame_tilts(), whole.all_frame_tilts());
  EXPECT_EQ(talus({"info", "kept.h5"}).exit_code, done);
  EXPECT_TRUE(ends(talus({"check", "kept.h5"}), done));
  EXPECT_TRUE(ends(talus({"replay", "kept.h5"}), bad_data, {"its first state is lost"}));
  EXPECT_THROW(session::checkpoint_at_frame(kept, 1), Error) << "earlier settings are no longer known";
}

/// Expects the repaired data to equal the original and to pass every check; another branch either begins with
/// all settings in effect, or does not begin.
void expect_kept(const io::RunFile& kept, const io::RunFile& whole) {
  const session::RunCheck check = session::check_run(kept, {});
  EXPECT_TRUE(check.faults.empty()) << check.faults.front();
  for (std::size_t k = 0; k < kept.all_frame_tilts().size(); ++k) {
    const Frame frame = kept.frame(k);
    std::size_t same = 0;
    while (same < whole.all_frame_tilts().size() && whole.frame(same).step != frame.step) ++same;
    ASSERT_LT(same, whole.all_frame_tilts().size());
    EXPECT_EQ(frame.x, whole.frame(same).x);
    EXPECT_EQ(frame.contacts.fn, whole.frame(same).contacts.fn);
    try {
      const io::Checkpoint start = session::checkpoint_at_frame(kept, k),
                           expected = session::checkpoint_at_frame(whole, same);
      EXPECT_EQ(start.integers, expected.integers) << kept.lost();
      EXPECT_EQ(start.reals, expected.reals) << kept.lost();
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ExitCode::bad_data || error.code() == ExitCode::usage) << error.what();
    }
  }
}

TEST_F(HostileBranch, with_damage_of_chance_is_repaired_to_what_was_written) {
  const io::RunFile whole = io::RunFile::open(folder->path("good.h5"));
  const std::string out = folder->path("out.h5");
  Random random(62);
  int repaired = 0, without_start = 0, refused = 0;
  for (int k = 0; k < tries(45) && !HasFailure(); ++k) {
    SCOPED_TRACE("try " + std::to_string(k));
    Bytes bytes = good;
    damage(bytes, damages[static_cast<std::size_t>(k) % damages.size()], random);
    const std::string path = bad(bytes);
    try {
      if (io::repair_run({path, out, true}).was_whole) continue;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data) << error.what();
      ++refused;
      continue;
    }
    const io::RunFile kept = io::RunFile::open(out);
    ++repaired;
    without_start += kept.header().branch ? 0 : 1;
    expect_kept(kept, whole);
  }
  std::printf("%d repaired, %d of them without their start; %d refused\n", repaired, without_start, refused);
  EXPECT_GT(repaired, 0);
}

TEST_F(HostileBranch, with_a_byte_flipped_in_its_header_is_refused_as_a_folder) {
  const fs::path header = test::path_beginning(io::run_folder(folder->path("stopped.h5")), "header_");
  const Bytes whole = read_bytes(header);
  Random random(61);
  for (int k = 0; k < tries(60); ++k) {
    Bytes bytes = whole;
    const std::size_t at = flip(bytes, random);
    write_bytes(header, bytes);
    EXPECT_TRUE(refusal(folder->path("stopped.h5"))) << "byte " << at;
  }
  write_bytes(header, whole);
}

}  // namespace
}  // namespace talus::hostile
