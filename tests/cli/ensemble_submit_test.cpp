/// Job arrays as users submit them, with fake Slurm commands that record their arguments. tests/slurm repeats
/// this with a real Slurm.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "support/commands.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

/// Ensemble of four beds that have not begun, with a folder of fake commands.
class EnsembleSubmit : public CommandTest {
 protected:
  void SetUp() override {
    write_file(folder_, "bed.toml", stable_bed);
    fs::create_directory(folder_.path() / "bin");
    ASSERT_TRUE(ends(talus({"ensemble", "bed.toml", "--seeds", "1-4", "--jobs", "0", "-o", "./" + name_}), 0,
                     {"0 of 4 done, 0 under way"}));
    command("squeue", "");
    command("scancel", "");
    command("sbatch", "echo 12");
  }

  /// Writes a command that appends its arguments to the file "called", one per line, and continues with
  /// `text`.
  void command(const std::string& name, const std::string& text) {
    const std::string called = folder_.path("called");
    write_file(folder_, "bin/" + name,
               "#!/bin/bash\nprintf '%s\\n' " + name + " \"$@\" >>'" + called + "'\n" + text + "\n");
    fs::permissions(folder_.path() / "bin" / name, fs::perms::owner_all);
  }

  Outcome talus(const Words& arguments, const Words& variables = {}) {
    return folder_.talus(arguments, Words{"PATH=" + folder_.path("bin") + ":/usr/bin:/bin"} + variables);
  }
  Outcome ensemble(const std::string& what, const Words& more = {}) {
    return talus(Words{"ensemble", what, "./" + name_} + more);
  }
  std::string called() { return folder_.text("called"); }
  std::string file(const std::string& name) { return folder_.path(name_ + "/" + name); }
  std::string name_ = "-it's \"$(touch oops)\"";
};

TEST_F(EnsembleSubmit, gives_sbatch_an_array_of_what_is_missing) {
  EXPECT_TRUE(ends(ensemble("submit", {"--time", "04:00", "--", "--partition=long", "-A", "it's me"}), 0,
                   {"job 12: 4 tasks for 4 missing members; a member takes about "}));
  EXPECT_TRUE(has(called(), "sbatch\n--parsable\n--array=1-4\n")) << called();
  EXPECT_TRUE(has(called(), "--time=04:00:00\n--partition=long\n-A\nit's me\nslurm/job.sh\n")) << called();
  EXPECT_EQ(text_of(file("slurm/job-12.csv")), "job,cluster,tasks\n12,,4\n");
  EXPECT_TRUE(has(text_of(file("slurm/job.sh")), "ensemble work . --stale 120 --max-wall 03:58:00 &"));
}

TEST_F(EnsembleSubmit, has_a_script_that_computes_members_by_itself) {
  ASSERT_EQ(ensemble("submit").exit_code, 0);
  const std::string run =
      "cd / && SLURM_ARRAY_JOB_ID=12 SLURM_ARRAY_TASK_ID=3 bash '" + folder_.path("job.sh") + "'";
  fs::copy_file(file("slurm/job.sh"), folder_.path() / "job.sh");
  EXPECT_EQ(std::system(run.c_str()), 0);
  EXPECT_TRUE(has(ensemble("status").out, "4 of 4 done")) << text_of(file("workers/slurm-12_3.log"));
  EXPECT_TRUE(has(text_of(file("workers/slurm-12_3.log")), "seed-4 done\n"));
  EXPECT_FALSE(folder_.has_file("oops")) << "the name of the folder was executed";
  EXPECT_TRUE(ends(ensemble("submit"), 0, {"4 of 4 done, 0 under way; nothing is missing\n"}));
}

TEST_F(EnsembleSubmit, has_a_worker_for_each_processor_of_a_task) {
  ASSERT_EQ(ensemble("submit", {"--tasks", "1", "--", "--cpus-per-task=2"}).exit_code, 0);
  fs::copy(folder_.path() / name_, folder_.path() / "plain", fs::copy_options::recursive);
  EXPECT_EQ(
      std::system(("cd '" + folder_.path("plain") + "' && sed -i 's/^cd .*/cd ./' slurm/job.sh && " +
                   "SLURM_CPUS_PER_TASK=2 SLURM_ARRAY_JOB_ID=12 SLURM_ARRAY_TASK_ID=1 bash slurm/job.sh")
                      .c_str()),
      0);
  const std::string log = text_of(folder_.path("plain/workers/slurm-12_1.log"));
  EXPECT_EQ(count_of(log, " failed here"), 2U) << log;
  for (int seed = 1; seed <= 4; ++seed)
    EXPECT_TRUE(has(log, "seed-" + std::to_string(seed) + " done\n")) << log;
}

TEST_F(EnsembleSubmit, adds_tasks_only_for_members_that_none_is_queued_for) {
  ASSERT_EQ(ensemble("submit", {"--tasks", "3"}).exit_code, 0);
  command("squeue", "printf '12|PENDING|Resources\\n12|PENDING|Resources\\n12|RUNNING|None\\n'");
  command("sbatch", "echo 13");
  EXPECT_TRUE(has(ensemble("submit").out, "job 13: 1 task for 4")) << called();
  command("squeue", "printf '13|PENDING|Priority\\n12|RUNNING|None\\n12|RUNNING|None\\n12|RUNNING|None\\n'");
  EXPECT_TRUE(ends(ensemble("submit"), 0, {"4 members missing, 4 tasks in the queue already"}));
  command("squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  command("sbatch", "echo 14");
  EXPECT_TRUE(has(ensemble("submit").out, "job 14: 4 tasks"));
  EXPECT_FALSE(fs::exists(file("slurm/job-12.csv"))) << "it has ended";
  EXPECT_TRUE(fs::exists(file("slurm/job-14.csv")));
}

TEST_F(EnsembleSubmit, shows_what_sbatch_says_and_obeys_nothing_of_it) {
  command("sbatch", "printf 'sbatch: error: no such \\033[31mpartition\\n' >&2; exit 1");
  const Outcome refused = ensemble("submit");
  EXPECT_TRUE(
      ends(refused, 69, {"sbatch submitted nothing; it says:\nsbatch: error: no such \\x1b[31mpartition"}));
  EXPECT_FALSE(has(refused.err, "\033"));
  command("sbatch", "echo 'Submitted batch job'");
  EXPECT_EQ(ensemble("submit").exit_code, 69) << "not a number";
  fs::remove(folder_.path() / "bin/sbatch");
  EXPECT_TRUE(ends(folder_.talus({"ensemble", "submit", "./" + name_}, {"PATH=" + folder_.path("bin")}), 69,
                   {"sbatch is not on PATH", "--engine print"}));
}

TEST_F(EnsembleSubmit, tells_status_of_its_tasks) {
  ASSERT_EQ(ensemble("submit").exit_code, 0);
  command("squeue",
          "printf '12|RUNNING|None\\n12|PENDING|\\033[31mResources\\n12|PENDING|\\033[31mResources\\n'");
  EXPECT_TRUE(has(ensemble("status").out, "\njob 12: 2 pending (\\x1b[31mResources), 1 running\n"));
  const std::string json = ensemble("status", {"--json"}).out;
  EXPECT_EQ(json_value(json, "pending"), "2") << json;
  EXPECT_EQ(json_value(json, "running"), "1") << json;
  command("squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1");
  EXPECT_TRUE(ends(ensemble("status"), 0, {"job 12: unknown, slurm_load_jobs error: Unable to contact"}));
  EXPECT_EQ(json_value(ensemble("status", {"--json"}).out, "queued"), "null");
}

TEST_F(EnsembleSubmit, can_be_cancelled) {
  EXPECT_TRUE(has(ensemble("cancel").out, "no job of this ensemble is known"));
  ASSERT_EQ(ensemble("submit").exit_code, 0);
  command("scancel", "echo 'scancel: error: no permission' >&2; exit 1");
  EXPECT_TRUE(ends(ensemble("cancel"), 69, {"no permission"}));
  EXPECT_TRUE(fs::exists(file("slurm/job-12.csv"))) << "it may still exist";
  command("scancel", "");
  EXPECT_TRUE(has(ensemble("cancel").out, "job 12 is cancelled\n"));
  EXPECT_TRUE(called().ends_with("scancel\n12\n")) << called();
  EXPECT_FALSE(fs::exists(file("slurm/job-12.csv")));
}

TEST_F(EnsembleSubmit, queues_a_task_again_while_members_come_further) {
  ASSERT_EQ(ensemble("submit").exit_code, 0);
  command("scontrol", "");
  const Words words = {"ensemble", "requeue", "./" + name_};
  const Words task = {"SLURM_ARRAY_JOB_ID=12", "SLURM_ARRAY_TASK_ID=3"};
  EXPECT_EQ(talus(words).exit_code, 64) << "no task";
  EXPECT_EQ(talus(words, task).exit_code, 0);
  EXPECT_TRUE(called().ends_with("scontrol\nrequeue\n12_3\n")) << called();
  EXPECT_EQ(talus(words, task).exit_code, 0);
  const std::string before = called();
  EXPECT_TRUE(ends(talus(words, task), 75, {"3 consecutive starts made no progress on any member"}));
  EXPECT_EQ(called(), before) << "it asks for no other start";
  std::ofstream(file("seed-1.h5")) << "done";
  std::ofstream(file("seed-2.failed")) << "exit code 65\n\n";
  fs::remove(file("seed-1.h5"));
  EXPECT_EQ(talus(words, task).exit_code, 0) << "a member has reached its end";
  command("scontrol", "echo 'Job is disabled' >&2; exit 1");
  std::ofstream(file("seed-3.failed")) << "exit code 65\n\n";
  EXPECT_EQ(talus(words, task).exit_code, 69);
  for (const char* member : {"seed-1.failed", "seed-4.failed"})
    std::ofstream(file(member)) << "exit code 65\n\n";
  EXPECT_TRUE(has(talus(words, task).out, "nothing is missing"));
}

TEST_F(EnsembleSubmit, prints_a_worker_on_each_line) {
  const Outcome printed = ensemble("submit", {"--engine", "print", "--time", "01:00"});
  EXPECT_TRUE(ends(printed, 0,
                   {" ensemble work '" + folder_.path("-it'\\''s \"$(touch oops)\"") +
                    "' --stale 120 --max-wall 00:58:00\n"}));
  EXPECT_EQ(std::ranges::count(printed.out, '\n'), 4) << printed.out;
  EXPECT_EQ(called(), "");
  EXPECT_EQ(ensemble("submit", {"--engine", "print", "--", "--mem=1G"}).exit_code, 64);
  write_file(folder_, "lines", printed.out);
  EXPECT_EQ(std::system(("cd / && bash '" + folder_.path("lines") + "' > /dev/null").c_str()), 0);
  EXPECT_TRUE(has(ensemble("status").out, "4 of 4 done"));
  EXPECT_EQ(ensemble("submit", {"--engine", "print"}).out, "") << "not a command, so nothing may be executed";
}

TEST_F(EnsembleSubmit, of_a_bad_form_is_refused) {
  EXPECT_EQ(ensemble("submit", {"--tasks", "0"}).exit_code, 64);
  EXPECT_EQ(ensemble("submit", {"--engine", "pbs"}).exit_code, 64);
  EXPECT_EQ(ensemble("submit", {"--time", "4"}).exit_code, 64);
  EXPECT_EQ(talus({"ensemble", "submit", "none"}).exit_code, 66);
  EXPECT_EQ(called(), "");
}

}  // namespace
}  // namespace talus::test
