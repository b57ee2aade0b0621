/// Ensembles as job arrays: the script of a task, arguments of Slurm's commands, and their output.

#include "ensemble/slurm.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.h"
#include "support/exit_code.h"

namespace talus::ensemble {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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
  EXPECT_TRUE(has(script, "\n\"$talus\" ensemble work . --stale 120 --max-wall 03:58:00 &\n")) << script;
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
  const std::vector<std::string> expected = {"sbatch",
                                             "--parsable",
                                             "--array=1-3",
                                             "--ntasks=1",
                                             "--requeue",
                                             "--open-mode=append",
                                             "--signal=B:USR1@60",
                                             "--job-name=-x",
                                             "--output=workers/slurm-%A_%a.log",
                                             "--time=04:00:00",
                                             "--partition=long",
                                             "-A",
                                             "me",
                                             "slurm/job.sh"};
  EXPECT_EQ(words, expected);
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

}  // namespace
}  // namespace talus::ensemble
