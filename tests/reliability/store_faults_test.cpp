/// Faults at any call: committed data are kept, and the run can be brought to the same end. While an analysis
/// is stored, the file still holds the run, and the old or the new analysis.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "base/errors.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "reliability/faults.h"
#include "unit/io/example_analysis.h"

namespace talus {
namespace {

constexpr int commits = 3;
constexpr int defect = 98;  // exit code of a child that detected an error

/// Report of a child process to its parent, in shared memory.
struct ChildReport {
  int committed = 0;
  int calls = 0;
  int begun = 0;   ///< number of calls up to the end of the first commit
  int ending = 0;  ///< number of calls up to packing
};

struct SharedReport {
  SharedReport()
      : reported(static_cast<ChildReport*>(
            mmap(nullptr, sizeof(ChildReport), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  ~SharedReport() { munmap(reported, sizeof(ChildReport)); }
  ChildReport* reported;
};

/// Performs an action, and repeats it if it throws.
template <typename Action>
void persist(const Action& action) {
  try {
    action();
  } catch (const Error&) {
    action();
  }
}

/// Computes the entire run in place of what exists under its name; `again` repeats each call that throws,
/// once.
void compute(const std::string& path, bool again, ChildReport& reported) {
  const auto attempt = [again](const auto& action) { again ? persist(action) : action(); };
  std::optional<io::RunStore> store;
  attempt([&] { store = io::RunStore::create(path, example::header(), true); });
  for (int k = 0; k < commits; ++k) {
    attempt([&] { store->commit(example::segment(k), example::checkpoint(k)); });
    reported.committed = k + 1;
    if (k == 0) reported.begun = faults::calls();
  }
  reported.ending = faults::calls();
  attempt([&] { store->pack(); });
}

/// Performs an action in a child process under a fault. Returns the exit code of the child, which is that of
/// the action or of its error; `calls` receives the number of its calls.
template <typename Action>
int code_under(const faults::Fault& fault, const Action& action, int* calls = nullptr) {
  const pid_t child = fork();
  if (child == 0) {
    int code = defect;
    try {
      faults::arm(fault);
      code = action();
    } catch (const Error& error) {
      code = static_cast<int>(error.code());
    } catch (...) {
    }
    if (calls != nullptr) *calls = faults::calls();
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Computes the run in a child process under a fault, and returns the exit code of the child.
int compute_under(const faults::Fault& fault, bool again, const std::string& path, ChildReport& reported) {
  reported = {};
  const auto action = [&] {
    compute(path, again, reported);
    return 0;
  };
  return code_under(fault, action, &reported.calls);
}

/// Opens the remains after a fault, and returns how many commits they hold, all of them intact.
int commits_in(const std::string& path) {
  if (io::run_presence(path) == io::RunPresence::none) return 0;
  const io::RunFile run = io::RunFile::open(path);
  const int found = static_cast<int>(run.steps().size() / 5);
  EXPECT_EQ(run.checkpoint().world.step, example::checkpoint(found - 1).world.step);
  EXPECT_EQ(state_hash(run.checkpoint().world), state_hash(example::checkpoint(found - 1).world));
  std::size_t frames = 0;
  for (int k = 0; k < found; ++k) frames += example::segment(k).frames.size();
  EXPECT_EQ(run.frame_count(), frames);
  for (std::size_t k = 0; k < run.frame_count(); ++k)
    EXPECT_EQ(run.frame(k).grain_count(), example::grain_count);
  return found;
}

/// Completes the remains after a fault, as `talus run --resume` does.
void finish_run(const std::string& path, int found) {
  if (io::run_presence(path) == io::RunPresence::packed) return;
  io::RunHeader header;
  io::Checkpoint checkpoint;
  io::RunStore store = io::run_presence(path) == io::RunPresence::folder
                           ? io::RunStore::resume(path, header, checkpoint)
                           : io::RunStore::create(path, example::header(), true);
  for (int k = found; k < commits; ++k) store.commit(example::segment(k), example::checkpoint(k));
  store.pack();
  EXPECT_FALSE(std::filesystem::exists(io::run_folder(path))) << "leftovers";
}

/// Injects a fault at every call of a run in turn.
class StoreFaults : public testing::Test {
 protected:
  StoreFaults() {
    example::store_with_commits(folder_.path("reference.h5"), commits).pack();
    reference_ = test::text_of(folder_.path("reference.h5"));
    EXPECT_EQ(compute_under({}, false, folder_.path("counted.h5"), *shared_.reported), 0);
    calls_ = shared_.reported->calls;
    EXPECT_GT(calls_, 60);
  }

  void strike_every_call(faults::Fault fault, bool again, const std::vector<int>& allowed_codes) {
    for (fault.call = 1; fault.call <= calls_; ++fault.call) {
      SCOPED_TRACE("call " + std::to_string(fault.call));
      const std::string path = folder_.path("run" + std::to_string(fault.call) + ".h5");
      const int code = compute_under(fault, again, path, *shared_.reported);
      EXPECT_TRUE(std::ranges::count(allowed_codes, code) == 1) << "exit code " << code;
      const int acknowledged = shared_.reported->committed;
      const int found = commits_in(path);
      EXPECT_GE(found, acknowledged) << "lost";
      EXPECT_LE(found, acknowledged + 1);
      finish_run(path, found);
      EXPECT_TRUE(test::text_of(path) == reference_) << "the end differs";
    }
  }

  example::TemporaryFolder folder_;
  SharedReport shared_;
  std::string reference_;

 private:
  int calls_ = 0;
};

/// Begins a run with another seed, complete or left after its first commit.
void begin_old_run(const std::string& path, bool is_whole) {
  io::RunHeader header = example::header();
  ++header.seed;
  io::RunStore old = io::RunStore::create(path, header, false);
  old.commit(example::segment(0), example::checkpoint(0));
  if (is_whole) old.pack();
}

/// Checks the remains after a kill during the replacement of a run: either run is found, and the new one as
/// soon as its file has the name. Returns whether it is the new one.
bool finds_new_run(const std::string& path, const std::string& old, const std::string& reference) {
  EXPECT_NE(io::run_presence(path), io::RunPresence::none) << "neither is found";
  if (io::run_presence(path) == io::RunPresence::none) return false;
  const std::string file = std::filesystem::exists(path) ? test::text_of(path) : "";
  const io::RunFile run = io::RunFile::open(path);
  EXPECT_TRUE(file == old || file == reference);
  EXPECT_EQ(run.complete(),
            file == reference || (!old.empty() && io::run_presence(path) == io::RunPresence::packed));
  if (file != reference) return run.header().seed == example::header().seed;
  EXPECT_EQ(io::run_presence(path), io::RunPresence::packed) << "the finished run is hidden by its folder";
  EXPECT_EQ(run.header().seed, example::header().seed);
  return true;
}

/// Kills at each call of the first commit and of packing; between them nothing is replaced.
class ReplacedRun : public StoreFaults, public testing::WithParamInterface<bool> {
 protected:
  ReplacedRun() {
    begin_old_run(old_path_, is_whole_);
    if (is_whole_) old_ = test::text_of(old_path_);
    restore_old_run();
    EXPECT_EQ(compute_under({}, false, path_, *shared_.reported), 0);
    all_ = *shared_.reported;
  }

  void restore_old_run() const {
    namespace fs = std::filesystem;
    fs::remove_all(io::run_folder(path_));
    fs::remove(path_);
    fs::copy(is_whole_ ? old_path_ : io::run_folder(old_path_), is_whole_ ? path_ : io::run_folder(path_));
  }

  /// A kill after the rename has left the folder: the file is still found, also by an analysis.
  void expect_found_by_analysis() const {
    io::store_analysis(path_, example::analysis(2, 1), example::analysed_state());
    EXPECT_EQ(io::run_presence(path_), io::RunPresence::packed) << "hidden after the analysis";
  }

  void finish_new_run(bool is_begun) const {
    ChildReport reported;
    if (is_begun)
      finish_run(path_, commits_in(path_));
    else
      compute(path_, false, reported);
    EXPECT_TRUE(test::text_of(path_) == reference_) << "the end differs";
  }

  bool is_whole_ = GetParam();
  std::string path_ = folder_.path("replaced.h5"), old_path_ = folder_.path("old.h5"), old_;
  ChildReport all_;
};

TEST_P(ReplacedRun, or_the_new_one_is_found_after_a_kill_at_any_call) {
  int left_folders = 0;
  for (int call = 1; call <= all_.calls; ++call) {
    if (call > all_.begun && call <= all_.ending) continue;
    SCOPED_TRACE("call " + std::to_string(call));
    restore_old_run();
    ASSERT_EQ(compute_under({.kind = faults::Kind::kill, .call = call}, false, path_, *shared_.reported),
              faults::killed);
    const bool is_new = finds_new_run(path_, old_, reference_);
    EXPECT_TRUE(is_new || shared_.reported->committed == 0) << "lost";
    const bool is_ended = is_new && io::run_presence(path_) == io::RunPresence::packed;
    if (is_ended && std::filesystem::exists(io::run_folder(path_)) && ++left_folders > 0)
      expect_found_by_analysis();
    else
      finish_new_run(is_new);
    EXPECT_FALSE(std::filesystem::exists(io::run_folder(path_))) << "leftovers";
  }
  EXPECT_GT(left_folders, 2);
  std::printf("%d of %d calls\n", all_.calls - all_.ending + all_.begun, all_.calls);
}

INSTANTIATE_TEST_SUITE_P(ThatWas, ReplacedRun, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "whole" : "not_ended"; });

constexpr int io_error = static_cast<int>(ExitCode::io_error);
constexpr int cannot_create = static_cast<int>(ExitCode::cannot_create);
constexpr int missing_input = static_cast<int>(ExitCode::missing_input);

TEST_F(StoreFaults, kill_at_every_call) {
  strike_every_call({.kind = faults::Kind::kill}, false, {faults::killed});
}

TEST_F(StoreFaults, full_disk_from_every_call_on) {
  strike_every_call({.kind = faults::Kind::error, .errno_value = ENOSPC, .lasting = true}, false,
                    {0, io_error, cannot_create, missing_input});
}

TEST_F(StoreFaults, one_error_at_every_call_and_a_second_attempt) {
  strike_every_call({.kind = faults::Kind::error, .errno_value = EIO}, true, {0});
}

/// A writer that is stopped at some call and continues after another process, to which its lock is invisible,
/// as between machines, has taken its run over.
class TakenOver : public testing::Test {
 protected:
  TakenOver() { replaces_ = false; }

  static bool is_complete() {
    return io::run_presence(path_) == io::RunPresence::packed &&
           io::RunFile::open(path_).header().seed == example::header().seed;
  }

  /// Lets the successor commit once; it continues when the other has woken.
  static void take_over() {
    visited_ = true;
    if (is_complete()) return;
    std::filesystem::remove(io::run_folder(path_) + "/lock");
    io::RunHeader header;
    io::Checkpoint checkpoint;
    const bool is_begun = io::run_presence(path_) == io::RunPresence::folder;
    successor_ = is_begun ? io::RunStore::resume(path_, header, checkpoint)
                          : io::RunStore::create(path_, example::header(), true);
    done_ = is_begun ? commits_at(checkpoint) : 0;
    marked_ = 0;
    commit_next();
  }

  static constexpr double mark =
      777.0;  ///< value in the successor's commits, which distinguishes their bytes

  static void commit_next() {
    io::Segment segment = example::segment(done_);
    io::Checkpoint checkpoint = example::checkpoint(done_);
    segment.observables[0][0] = checkpoint.timing[0].second = mark;
    successor_->commit(segment, checkpoint);
    ++done_;
    ++marked_;
  }

  static int commits_at(const io::Checkpoint& checkpoint) {
    return static_cast<int>(checkpoint.world.step - example::checkpoint(0).world.step) + 1;
  }

  /// Visits each call of `action` in turn, on a store made by `prepare`.
  void visit_every_call(const std::function<std::optional<io::RunStore>()>& prepare,
                        const std::function<void(std::optional<io::RunStore>&)>& action) {
    int calls = 0, ousted = 0;
    for (visited_ = true; visited_; ++calls) {
      SCOPED_TRACE("call " + std::to_string(calls + 1));
      path_ = folder_.path("run" + std::to_string(calls) + ".h5");
      if (replaces_) std::filesystem::copy(old_path_, path_);
      std::optional<io::RunStore> store = prepare();
      visited_ = false;
      faults::arm({.kind = faults::Kind::visit, .call = calls + 1, .visit = &TakenOver::take_over});
      try {
        action(store);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::cannot_create) << error.what();
        // Within one process locks are visible if the other comes first.
        const std::string text = error.what();
        EXPECT_TRUE(text.find("another process has taken the run over") != std::string::npos ||
                    text.find("is being written by") != std::string::npos)
            << text;
        ++ousted;
      }
      faults::arm({});
      if (successor_) finish(store, calls % 8 == 0);
      store.reset();
      std::filesystem::remove_all(io::run_folder(path_));
      std::filesystem::remove(path_);
    }
    EXPECT_GT(ousted, 5) << "of " << calls;
  }

  /// Expects the writer that took the lock last to continue; the other is rejected and leaves the files
  /// unchanged.
  void finish(std::optional<io::RunStore>& store, bool packs) {
    try {
      commit_next();
      EXPECT_FALSE(is_complete()) << "by the writer that lost the lock";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::cannot_create) << error.what();
      successor_.reset();
      done_ = commits_in(path_);
      return;
    }
    EXPECT_EQ(commits_in(path_), done_);
    const io::RunFile run = io::RunFile::open(path_);
    EXPECT_EQ(run.checkpoint().timing[0].second, mark);
    EXPECT_EQ(
        std::ranges::count(run.all_observables(), mark, [](const ObservableRow& row) { return row[0]; }),
        marked_);
    store.reset();
    if (packs) {  // packing takes longest
      successor_->pack();
      EXPECT_EQ(commits_in(path_), done_);
      EXPECT_FALSE(std::filesystem::exists(io::run_folder(path_))) << "leftovers";
    }
    successor_.reset();
  }

  static std::optional<io::RunStore> begun(int count) {
    io::RunStore store = io::RunStore::create(path_, example::header(), true);
    for (int k = 0; k < count; ++k) store.commit(example::segment(k), example::checkpoint(k));
    return store;
  }

  example::TemporaryFolder folder_;
  std::string old_path_ = folder_.path("old.h5");
  static inline std::string path_;
  static inline std::optional<io::RunStore> successor_;
  static inline int done_ = 0, marked_ = 0;
  static inline bool visited_ = false, replaces_ = false;
};

TEST_F(TakenOver, when_it_begins_a_run_it_leaves_that_of_its_successor_whole) {
  visit_every_call([] { return std::nullopt; },
                   [](std::optional<io::RunStore>& store) {
                     store = io::RunStore::create(path_, example::header(), true);
                     store->commit(example::segment(0), example::checkpoint(0));
                   });
}

TEST_F(TakenOver, within_a_commit_it_leaves_the_run_of_its_successor_whole) {
  visit_every_call(
      [] { return begun(1); },
      [](std::optional<io::RunStore>& store) { store->commit(example::segment(1), example::checkpoint(1)); });
}

TEST_F(TakenOver, when_it_resumes_it_leaves_the_run_of_its_successor_whole) {
  visit_every_call(
      [] {
        begun(2);
        return std::nullopt;
      },
      [](std::optional<io::RunStore>& store) {
        io::RunHeader header;
        io::Checkpoint checkpoint;
        store = io::RunStore::resume(path_, header, checkpoint);
        if (const int next = commits_at(checkpoint); next < commits)
          store->commit(example::segment(next), example::checkpoint(next));
      });
}

/// The run replaces another one, whose file hides the folder or not, as its manifest says.
TEST_F(TakenOver, when_it_packs_it_leaves_the_run_of_its_successor_whole) {
  begin_old_run(old_path_, true);
  replaces_ = true;
  visit_every_call([] { return begun(1); }, [](std::optional<io::RunStore>& store) { store->pack(); });
}

constexpr int calls_at_most = 60;  // limit for one store_analysis; the tests check that it takes fewer
constexpr int done = 0;

/// Stores an analysis in a child process under a fault, and returns the exit code of the child.
int store_under(const faults::Fault& fault, const std::string& path) {
  return code_under(fault, [&] {
    io::store_analysis(path, example::analysis(2, 2), example::analysed_state());
    return faults::calls() < calls_at_most ? done : defect;
  });
}

/// Injects a fault at every call in turn while the second analysis of a file replaces the first.
void strike_every_call(faults::Fault fault, const std::vector<int>& allowed_codes) {
  const example::TemporaryFolder folder;
  const std::string path = folder.path("run.h5");
  example::store_with_commits(path, example::analysis_commits).pack();
  io::store_analysis(path, example::analysis(2, 1), example::analysed_state());
  const std::string before = test::text_of(path);
  ASSERT_EQ(store_under({}, path), done);
  const std::string after = test::text_of(path);
  ASSERT_TRUE(before != after);
  int kept = 0;
  for (fault.call = 1; fault.call < calls_at_most; ++fault.call) {
    SCOPED_TRACE("call " + std::to_string(fault.call));
    example::write_text(path, before);
    const int code = store_under(fault, path);
    EXPECT_TRUE(std::ranges::count(allowed_codes, code) == 1) << "exit code " << code;
    const std::string found = test::text_of(path);
    EXPECT_TRUE(found == before || found == after) << "neither the old nor the new analysis";
    EXPECT_TRUE(code != done || found == after) << "reported as stored";
    kept += found == before ? 1 : 0;
  }
  EXPECT_GT(kept, 5) << "no fault occurred, so nothing was tested";
}

TEST(AnalysisFaults, kill_at_every_call) {
  strike_every_call({.kind = faults::Kind::kill}, {done, faults::killed});
}

TEST(AnalysisFaults, full_disk_from_every_call_on) {
  strike_every_call({.kind = faults::Kind::error, .errno_value = ENOSPC, .lasting = true},
                    {done, static_cast<int>(ExitCode::io_error), static_cast<int>(ExitCode::missing_input),
                     static_cast<int>(ExitCode::bad_data)});
}

}  // namespace
}  // namespace talus
