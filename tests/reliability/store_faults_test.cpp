/// Whatever happens at whichever call, what was committed is kept and the run can be brought to the same end.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>

#include "core/errors.h"
#include "io/run_file.h"
#include "reliability/faults.h"
#include "unit/io/example_run.h"

namespace talus {
namespace {

constexpr int commits = 3;
constexpr int defect = 98;  // exit code of a child that saw what must not happen

/// What a child process tells its parent, in shared memory.
struct Told {
  int committed = 0;
  int calls = 0;
};

struct SharedTold {
  SharedTold()
      : told(static_cast<Told*>(
            mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  ~SharedTold() { munmap(told, sizeof(Told)); }
  Told* told;
};

/// Does it, and does it again where that throws.
template <typename Action>
void persist(const Action& action) {
  try {
    action();
  } catch (const Error&) {
    action();
  }
}

/// The whole run in one go; `again` repeats each call that throws once.
void compute(const std::string& path, bool again, Told& told) {
  const auto attempt = [again](const auto& action) { again ? persist(action) : action(); };
  std::optional<RunStore> store;
  attempt([&] { store = RunStore::create(path, example::header(), false); });
  for (int k = 0; k < commits; ++k) {
    attempt([&] { store->commit(example::segment(k), example::checkpoint(k)); });
    told.committed = k + 1;
  }
  attempt([&] { store->pack(); });
}

/// Computes the run in a child process under a fault, and returns the exit code of the child.
int compute_under(const faults::Fault& fault, bool again, const std::string& path, Told& told) {
  told = {};
  const pid_t child = fork();
  if (child == 0) {
    int code = defect;
    try {
      faults::arm(fault);
      compute(path, again, told);
      code = 0;
    } catch (const Error& error) {
      code = static_cast<int>(error.code());
    } catch (...) {
    }
    told.calls = faults::calls();
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Opens what a fault left, and returns how many commits it holds, all of them whole.
int commits_in(const std::string& path) {
  if (run_presence(path) == RunPresence::none) return 0;
  const RunFile run = RunFile::open(path);
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

/// Brings what a fault left to its end, as `talus run --resume` does.
void bring_to_end(const std::string& path, int found) {
  if (run_presence(path) == RunPresence::packed) return;
  RunHeader header;
  Checkpoint checkpoint;
  RunStore store = run_presence(path) == RunPresence::folder
                       ? RunStore::resume(path, header, checkpoint)
                       : RunStore::create(path, example::header(), false);
  for (int k = found; k < commits; ++k) store.commit(example::segment(k), example::checkpoint(k));
  store.pack();
  EXPECT_FALSE(std::filesystem::exists(run_folder(path))) << "leftovers";
}

/// Strikes every call of a run in turn.
class StoreFaults : public testing::Test {
 protected:
  StoreFaults() {
    example::store_with_commits(folder_.path("reference.h5"), commits).pack();
    reference_ = example::file_text(folder_.path("reference.h5"));
    EXPECT_EQ(compute_under({}, false, folder_.path("counted.h5"), *shared_.told), 0);
    calls_ = shared_.told->calls;
    EXPECT_GT(calls_, 60);
  }

  void strike_every_call(faults::Fault fault, bool again, const std::vector<int>& allowed_codes) {
    for (fault.call = 1; fault.call <= calls_; ++fault.call) {
      SCOPED_TRACE("call " + std::to_string(fault.call));
      const std::string path = folder_.path("run" + std::to_string(fault.call) + ".h5");
      const int code = compute_under(fault, again, path, *shared_.told);
      EXPECT_TRUE(std::ranges::count(allowed_codes, code) == 1) << "exit code " << code;
      const int acknowledged = shared_.told->committed;
      const int found = commits_in(path);
      EXPECT_GE(found, acknowledged) << "lost";
      EXPECT_LE(found, acknowledged + 1);
      bring_to_end(path, found);
      EXPECT_TRUE(example::file_text(path) == reference_) << "the end is another one";
    }
  }

 private:
  example::TemporaryFolder folder_;
  SharedTold shared_;
  std::string reference_;
  int calls_ = 0;
};

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

}  // namespace
}  // namespace talus
