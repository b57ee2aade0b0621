/// Job arrays of Slurm.

#include "ensemble/slurm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <span>

#include "base/errors.h"
#include "base/text.h"
#include "io/run_folder.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

using test::has;

bool has_word(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

SlurmArray array_in(const std::string& folder) {
  return {"/opt/my programs/talus", folder, 3, 14400.0, 120.0};
}

TEST(SlurmTimes, leave_the_worker_time_for_its_checkpoint) {
  EXPECT_EQ(time_text(14400.0 - 2.0 * time_reserve(14400.0)), "03:58:00");
  EXPECT_EQ(time_text(60.0 - 2.0 * time_reserve(60.0)), "00:00:48");
  EXPECT_EQ(time_text(0.4), "00:00:01");
  EXPECT_EQ(time_text(100.0 * 3600.0), "100:00:00");
}

TEST(SlurmScript, holds_paths_as_words_of_a_shell) {
  const std::string script = job_script(array_in("/shared/it's $(rm x)\n-b"));
  EXPECT_TRUE(script.starts_with("#!/bin/bash\n"));
  EXPECT_TRUE(has(script, "\ntalus='/opt/my programs/talus'\n")) << script;
  EXPECT_TRUE(has(script, "\ncd -- $'/shared/it\\'s $(rm x)\\x0a-b' || exit 66\n")) << script;
  EXPECT_TRUE(has(script, "\n  \"$talus\" ensemble work . --stale 120 --max-wall 03:58:00 &\n")) << script;
}

TEST(SlurmScript, of_a_task_without_end_has_no_limit) {
  SlurmArray array = array_in("/shared/e");
  array.time.reset();
  EXPECT_FALSE(has(job_script(array), "--max-wall"));
  EXPECT_TRUE(has_word(sbatch_arguments(array, {}), "--signal=B:USR1@120"));
}

TEST(SbatchWords, name_no_path_and_end_with_the_options_of_the_user) {
  const std::vector<std::string> words =
      sbatch_arguments(array_in("/shared/-x"), {"--partition=long", "-A", "me"});
  EXPECT_EQ(
      joined(words, "|"),
      "sbatch|--parsable|--array=1-3|--ntasks=1|--requeue|--open-mode=append|--signal=B:USR1@60|"
      "--job-name=-x|--output=workers/slurm-%A_%a.log|--time=04:00:00|--partition=long|-A|me|slurm/job.sh");
}

TEST(SbatchWords, let_slurm_write_no_log_where_it_would_mistake_the_folder) {
  for (const char* folder : {"/shared/50%j", "/sha\\red/e"})
    EXPECT_TRUE(has_word(sbatch_arguments(array_in(folder), {}), "--output=/dev/null")) << folder;
  EXPECT_TRUE(has(job_script(array_in("/shared/50%j")),
                  "exec >>\"workers/slurm-${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID.log\" 2>&1\n"));
}

TEST(WorkerCommand, is_one_line_of_a_shell) {
  EXPECT_EQ(worker_command(array_in("/shared/a b")),
            "'/opt/my programs/talus' ensemble work '/shared/a b' --stale 120 --max-wall 03:58:00");
  EXPECT_EQ(test::exit_code_of([] { worker_command(array_in("/shared/a\nrm x")); }), ExitCode::usage);
}

TEST(Submitted, is_the_last_line_of_sbatch) {
  EXPECT_EQ(parse_submitted("12").value().id, "12");
  EXPECT_EQ(parse_submitted("12;far").value().cluster, "far");
  EXPECT_EQ(parse_submitted("welcome to the cluster\n345").value().id, "345");
  for (const char* text : {"", "Submitted batch job 12", "-1", "12 ", "1\x1b[m", "12;a\nb", "12;a,b",
                           "9999999999999999999", "0x12", "12_1"})
    EXPECT_FALSE(parse_submitted(text).has_value()) << text;
}

TEST(Queue, counts_tasks_by_their_states) {
  const auto queue = parse_queue(
      "CLUSTER: far\n12|RUNNING|None\n12|PENDING|Resources\n12|PENDING|Priority\n12|PENDING|Resources\n"
      "12|COMPLETED|None\n15|SUSPENDED|None\n16|CANCELLED|None\nnonsense|x|y\n17|PENDING\n");
  ASSERT_EQ(queue.size(), 2u);
  const QueuedTasks& tasks = queue.at("12");
  EXPECT_EQ(tasks.count.at("RUNNING"), 1u);
  EXPECT_EQ(tasks.count.at("PENDING"), 3u);
  EXPECT_EQ(total(tasks), 4u);
  EXPECT_EQ(tasks.reasons, (std::vector<std::string>{"Resources", "Priority"}));
  EXPECT_EQ(total(queue.at("15")), 1u);
}

TEST(SlurmCommands, ask_one_cluster_at_a_time) {
  const std::vector<SlurmJob> jobs = {{"12", "", 1}, {"13", "far", 1}, {"14", "", 1}};
  const auto clusters = by_cluster(jobs);
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_EQ(scancel_words(clusters.at("")), (std::vector<std::string>{"scancel", "12", "14"}));
  EXPECT_EQ(scancel_words(clusters.at("far")), (std::vector<std::string>{"scancel", "--clusters=far", "13"}));
  EXPECT_TRUE(has_word(squeue_words(clusters.at("")), "--jobs=12,14"));
  EXPECT_TRUE(has_word(squeue_words(clusters.at("far")), "--clusters=far"));
}

TEST(SlurmCommands, queue_one_task_again_and_not_its_array) {
  EXPECT_EQ(requeue_words("12", "3"), (std::vector<std::string>{"scontrol", "requeue", "12_3"}));
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

class SlurmFolder : public test::FolderTest {
 protected:
  SlurmFolder() { std::filesystem::create_directory(slurm_folder(path)); }

  const std::string path = folder.path().string();
};

TEST(SlurmJobs, of_no_folder_are_none) { EXPECT_TRUE(recorded_jobs("/nowhere").empty()); }

TEST_F(SlurmFolder, jobs_are_remembered_until_they_are_forgotten) {
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

TEST_F(SlurmFolder, jobs_that_are_damaged_are_named) {
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

TEST_F(SlurmFolder, remembers_starts_from_one_to_the_next) {
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
