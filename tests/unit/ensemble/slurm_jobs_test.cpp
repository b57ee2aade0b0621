/// Jobs found in the folder of an ensemble, and conditions under which a task is not queued again.

#include "ensemble/slurm_jobs.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <span>

#include "io/manifest.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

TEST(SlurmJobs, are_remembered_until_they_are_forgotten) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  EXPECT_TRUE(recorded_jobs(path).empty());
  std::filesystem::create_directory(slurm_folder(path));
  record_job(path, {"100", "", 8});
  record_job(path, {"9", "far", 3});
  write_memory(path, "9", "2", {{1, 50}, 1});
  write(slurm_folder(path) + "/job-x.csv", "no job");
  std::vector<SlurmJob> jobs = recorded_jobs(path);
  ASSERT_EQ(jobs.size(), 2u);
  EXPECT_EQ(jobs[0].id, "9");
  EXPECT_EQ(jobs[0].cluster, "far");
  EXPECT_EQ(jobs[0].tasks, 3u);
  EXPECT_EQ(jobs[1].id, "100");
  forget_job(path, jobs[0]);
  EXPECT_EQ(recorded_jobs(path).size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(slurm_folder(path) + "/task-9_2.csv"));
}

TEST(SlurmJobs, that_are_damaged_are_named) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  std::filesystem::create_directory(slurm_folder(path));
  for (const char* text : {"", "job,cluster,tasks\n13,,2\n", "job,cluster,tasks\n12,,x\n", "12,,2\n"}) {
    write(slurm_folder(path) + "/job-12.csv", text);
    EXPECT_EQ(test::exit_code_of([&] { recorded_jobs(path); }), ExitCode::bad_data) << text;
  }
}

TEST(Starts, that_bring_no_member_further_are_counted) {
  TaskMemory memory = after_start({}, {0, 10});
  EXPECT_EQ(memory.idle_starts, 0);
  memory = after_start(memory, {0, 10});
  memory = after_start(memory, {0, 10});
  EXPECT_EQ(memory.idle_starts, 2);
  EXPECT_EQ(after_start(memory, {0, 11}).idle_starts, 0) << "steps";
  EXPECT_EQ(after_start(memory, {1, 0}).idle_starts, 0) << "a finished member";
  EXPECT_EQ(after_start(memory, {0, 10}).idle_starts, max_idle_starts);
}

TEST(Starts, are_remembered_from_one_to_the_next) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path().string();
  std::filesystem::create_directory(slurm_folder(path));
  EXPECT_EQ(read_memory(path, "12", "3").idle_starts, 0);
  write_memory(path, "12", "3", {{1, 30}, 2});
  const TaskMemory memory = read_memory(path, "12", "3");
  EXPECT_EQ(memory.idle_starts, 2);
  EXPECT_EQ(memory.mark, (EnsembleMark{1, 30}));
  write(slurm_folder(path) + "/task-12_3.csv", "done\nx");
  EXPECT_EQ(read_memory(path, "12", "3").idle_starts, 0);
}

TEST(EnsembleMark, counts_members_and_committed_steps) {
  const test::TemporaryFolder folder;
  const EnsemblePlan plan = plan_ensemble({1, 2, 3, 4}, {{"", "", {}}}, folder.path().string());
  write(folder.path("seed-1.h5"), "");
  write(folder.path("seed-2.failed"), "");
  std::filesystem::create_directory(folder.path("seed-3.h5.run"));
  io::Manifest manifest;
  const std::string bytes = "x";
  const io::StoredFile file = io::describe("header.h5", std::as_bytes(std::span(bytes)));
  manifest.header = manifest.checkpoint = file;
  manifest.segments = {{file, 1, 0, 1, 40}, {file, 1, 0, 1, 2}};
  write(folder.path("seed-3.h5.run/manifest"), io::manifest_text(manifest));
  EXPECT_EQ(mark_of(plan), (EnsembleMark{2, 42}));
}

}  // namespace
}  // namespace talus::ensemble
