/// File systems without features of a local disk: locks, or the removal of open files.

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>

#include "reliability/faults.h"
#include "reliability/outputs.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::test {
namespace {

std::vector<std::string> without_locks(int error) {
  std::vector<std::string> environment = with_fault("no-locks " + std::to_string(error));
  environment.emplace_back("HDF5_USE_FILE_LOCKING=TRUE");  // a possible setting of a site
  return environment;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class WithoutLocks : public testing::TestWithParam<int> {
 protected:
  Outcome talus(const std::vector<std::string>& arguments) {
    return run_talus(arguments, folder_.path(), without_locks(GetParam()));
  }
  TemporaryFolder folder_;
};

TEST_P(WithoutLocks, a_run_is_read_computed_and_resumed) {
  write_file(folder_, "bed.toml", tiny_bed);
  const std::string whole = take_run(folder_, "whole.h5", tiny_bed);
  const Outcome info = talus({"info", "whole.h5"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(info.err, "");
  const std::vector<std::string> run = {"run", "bed.toml", "-q", "-o"};
  const auto to = [&run](const std::string& output) {
    std::vector<std::string> words = run;
    words.push_back(output);
    return words;
  };
  const Outcome computed = talus(to("run.h5"));
  EXPECT_EQ(computed.exit_code, 0) << computed.err;
  EXPECT_EQ(count_of(computed.err, "talus: note: the file system has no locks"), 1u) << computed.err;
  EXPECT_EQ(digest(folder_.path("run.h5")), digest(whole));
  ASSERT_EQ(run_talus(to("part.h5"), folder_.path(), with_fault("kill 120")).exit_code, faults::killed);
  EXPECT_EQ(talus({"info", "part.h5"}).exit_code, 0);
  const Outcome resumed = talus({"run", "--resume", "part.h5", "-q"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(digest(folder_.path("part.h5")), digest(whole));
  EXPECT_FALSE(fs::exists(folder_.path("part.h5.run")) || fs::exists(folder_.path("run.h5.run")));
}

INSTANTIATE_TEST_SUITE_P(Errors, WithoutLocks,
                         testing::Values(ENOLCK, ENOSYS, EOPNOTSUPP, EROFS, EINVAL, EACCES, EPERM, EBADF));

class WithoutLockd : public testing::Test {
 protected:
  Outcome talus(const std::vector<std::string>& arguments) {
    return run_talus(arguments, folder_.path(), without_locks(ENOLCK));
  }
  TemporaryFolder folder_;
};

TEST_F(WithoutLockd, every_kind_of_output_is_written) {
  take_run(folder_, "run.h5", tiny_bed);
  const std::vector<std::vector<std::string>> commands = {
      {"analyze", "run.h5"},
      {"render", "run.h5", "--map", "gamma", "--theta-c", "20", "--at", "0", "-o", "maps"},
      {"export", "run.h5", "--to", "csv", "-o", "tables"},
      {"check", "run.h5"},
  };
  for (const std::vector<std::string>& words : commands) {
    const Outcome outcome = talus(words);
    EXPECT_EQ(outcome.exit_code, 0) << words[0] << ": " << outcome.err;
    EXPECT_EQ(outcome.err.find("malformed"), std::string::npos) << outcome.err;
  }
  fs::resize_file(folder_.path("run.h5"), fs::file_size(folder_.path("run.h5")) - 100);
  const Outcome repaired = talus({"repair", "run.h5", "-o", "new.h5"});
  EXPECT_EQ(repaired.exit_code, 0) << repaired.err;
}

TEST_F(WithoutLockd, workers_of_an_ensemble_go_by_heartbeats) {
  write_file(folder_, "bed.toml", tiny_bed);
  const Outcome ensemble = talus({"ensemble", "bed.toml", "--seeds", "1-4", "--jobs", "2", "-o", "e"});
  EXPECT_EQ(ensemble.exit_code, 0) << ensemble.err;
  EXPECT_EQ(count_of(ensemble.err, "talus: note: the file system has no locks"), 1u) << ensemble.err;
  std::string begun;
  for (const auto& log : fs::directory_iterator(folder_.path("e/workers")))
    begun += text_of(log.path().string());
  EXPECT_EQ(count_of(begun, " begun\n"), 4u) << begun;
  for (const std::string& name : names_in(folder_.path("e")))
    EXPECT_FALSE(name.ends_with(".lock") || name.find(".claim-") != std::string::npos ||
                 name.ends_with(".failed"))
        << name;
}

TEST_F(WithoutLockd, a_run_is_read_by_python) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-h5py is not installed";
  take_run(folder_, "run.h5", tiny_bed);
  for (const char* wish : {"", "HDF5_USE_FILE_LOCKING=TRUE", "HDF5_USE_FILE_LOCKING=BEST_EFFORT"}) {
    const std::string command =
        "cd " + folder_.path().string() + " && " + wish + " LD_PRELOAD=" + faults_library() +
        " TALUS_FAULT='no-locks 37' PYTHONPATH=" + source_folder() +
        "/python /usr/bin/python3 -c \"import talus; print(len(talus.open('run.h5').frames))\"" +
        " > read.txt 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << wish << text_of(folder_.path("read.txt"));
    EXPECT_EQ(text_of(folder_.path("read.txt")), "8\n");
  }
}

TEST(OnNfs, where_a_file_that_is_open_is_not_removed_nothing_is_left_of_a_run) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const std::vector<std::string> environment = with_fault("keeps-open");
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"run", "bed.toml", "-o", "run.h5", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return run_talus(words, folder.path(), environment).exit_code;
  };
  EXPECT_EQ(run({}), 0);
  EXPECT_FALSE(fs::exists(folder.path("run.h5.run")));
  EXPECT_EQ(run({"--overwrite"}), 0);
  EXPECT_EQ(run({"--resume"}), 0) << "of a run that is complete";
  EXPECT_FALSE(fs::exists(folder.path("run.h5.run")));
}

}  // namespace
}  // namespace talus::test
