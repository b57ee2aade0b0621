/// Faults at any call while an analysis is stored: the file still holds the run, and the old or the new
/// analysis.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/errors.h"
#include "io/analysis_file.h"
#include "io/run_file.h"
#include "reliability/faults.h"
#include "unit/io/example_analysis.h"

namespace talus {
namespace {

constexpr int defect = 98;         // exit code of a child that detected an error
constexpr int calls_at_most = 60;  // limit for one store_analysis; the tests check that it takes fewer
constexpr int done = 0;

/// Stores an analysis in a child process under a fault, and returns the exit code of the child.
int store_under(const faults::Fault& fault, const std::string& path) {
  const pid_t child = fork();
  if (child == 0) {
    int code = defect;
    try {
      faults::arm(fault);
      io::store_analysis(path, example::analysis(2, 2), example::analysed_state());
      code = faults::calls() < calls_at_most ? done : defect;
    } catch (const Error& error) {
      code = static_cast<int>(error.code());
    } catch (...) {
    }
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/// Injects a fault at every call in turn while the second analysis of a file replaces the first.
void strike_every_call(faults::Fault fault, const std::vector<int>& allowed_codes) {
  const example::TemporaryFolder folder;
  const std::string path = folder.path("run.h5");
  example::store_with_commits(path, example::analysis_commits).pack();
  io::store_analysis(path, example::analysis(2, 1), example::analysed_state());
  const std::string before = example::file_text(path);
  ASSERT_EQ(store_under({}, path), done);
  const std::string after = example::file_text(path);
  ASSERT_TRUE(before != after);
  int kept = 0;
  for (fault.call = 1; fault.call < calls_at_most; ++fault.call) {
    SCOPED_TRACE("call " + std::to_string(fault.call));
    example::write_text(path, before);
    const int code = store_under(fault, path);
    EXPECT_TRUE(std::ranges::count(allowed_codes, code) == 1) << "exit code " << code;
    const std::string found = example::file_text(path);
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
