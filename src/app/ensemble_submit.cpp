#include "app/ensemble_submit.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <memory>

#include "app/choices.h"
#include "app/ensemble_jobs.h"
#include "app/ensemble_report.h"
#include "app/program_output.h"
#include "app/stop_signals.h"
#include "app/terminal.h"
#include "app/wall_time.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/paths.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "ensemble/claim.h"
#include "ensemble/pool.h"
#include "ensemble/slurm.h"
#include "ensemble/slurm_jobs.h"
#include "io/durable_file.h"

namespace talus::app {
namespace {

namespace fs = std::filesystem;

struct SubmitArguments {
  std::string folder;
  std::string engine = "slurm";
  std::size_t tasks = 0;  ///< 0: as many as are useful
  std::string time;       ///< HH:MM; empty: the limit of the partition
  double stale = ensemble::ClaimTimes{}.stale;
  std::vector<std::string> options;  ///< passed to sbatch
};

ensemble::SlurmArray array_of(const SubmitArguments& arguments, std::size_t tasks) {
  ensemble::SlurmArray array;
  std::error_code error;
  array.program = fs::read_symlink("/proc/self/exe", error).string();
  if (error) throw system_error(ExitCode::unavailable, "read the link", "/proc/self/exe", error.value());
  // Links are not resolved, because their targets may differ between machines.
  array.folder = fs::path(absolute_path(arguments.folder)).lexically_normal().string();
  if (array.folder.size() > 1 && array.folder.ends_with('/')) array.folder.pop_back();
  array.tasks = tasks;
  if (!arguments.time.empty()) array.time = parse_wall_time("--time", arguments.time);
  array.stale = arguments.stale;
  return array;
}

/// Explains why nothing is submitted if no member is missing.
std::string nothing_text(const EnsembleView& view) {
  const bool failed = ensemble::count_of(view.states, ensemble::MemberStage::failed) > 0;
  return fmt::format("{}: {}; nothing is missing{}\n", visible(view.folder), count_text(view),
                     failed ? fmt::format("; talus ensemble retry {} queues the failed members again",
                                          shell_quoted(ensemble::path_word(view.folder)))
                            : "");
}

/// Prints one worker command per line, for a program that runs lines in parallel.
void print_commands(const SubmitArguments& arguments, std::size_t missing) {
  if (!arguments.options.empty())
    throw Error(ExitCode::usage, "options of sbatch have no effect with --engine print; omit them");
  const std::size_t tasks = arguments.tasks > 0 ? arguments.tasks : std::min(missing, ensemble::usual_tasks);
  const std::string command = ensemble::worker_command(array_of(arguments, tasks));
  for (std::size_t task = 0; task < tasks; ++task) print("%s\n", command.c_str());
}

/// Submits and records the job as one unit: a signal takes effect only after the job is recorded.
ensemble::SlurmJob submit_array(const SubmitArguments& arguments, std::size_t tasks) {
  const ensemble::SlurmArray array = array_of(arguments, tasks);
  prepare_folder(ensemble::slurm_folder(arguments.folder));
  prepare_folder((fs::path(arguments.folder) / "workers").string());
  io::write_text((fs::path(ensemble::slurm_folder(arguments.folder)) / "job.sh").string(),
                 ensemble::job_script(array));
  const CommitOnSignals commit;
  const ProgramOutput output = output_of(
      ensemble::sbatch_arguments(array, arguments.options), arguments.folder, ProgramEnvironment::whole,
      "sbatch is not on PATH: run this command on a machine from which jobs can be submitted; without Slurm, "
      "start workers with talus ensemble work, or print their commands with --engine print",
      true);
  std::optional<ensemble::SlurmJob> job =
      output.status == 0 ? ensemble::parse_submitted(output.out) : std::nullopt;
  if (!job) {
    stop_if_asked();
    const std::string said = output.err.empty() ? output.out : output.err;
    throw Error(ExitCode::unavailable,
                fmt::format("sbatch submitted nothing{}", said.empty() ? "" : "; it says:\n" + said));
  }
  job->tasks = tasks;
  ensemble::record_job(arguments.folder, *job);
  if (!output.err.empty()) print_error("%s\n", output.err.c_str());
  return *job;
}

void submit(const SubmitArguments& arguments) {
  ensemble::KnownMembers known;
  const EnsembleView view = view_of_ensemble(arguments.folder, known);
  const std::size_t missing = view.states.size() - count_ended(view);
  if (missing == 0) {
    const std::string text = nothing_text(view);
    if (arguments.engine == "print")
      print_error("%s", text.c_str());
    else
      print_text(text);
    return;
  }
  if (arguments.engine == "print") return print_commands(arguments, missing);
  const EnsembleJobs jobs = jobs_of_ensemble(arguments.folder);
  const std::size_t queued = count_queued(jobs);
  const std::string folder = shell_quoted(ensemble::path_word(arguments.folder));
  if (arguments.tasks == 0 && queued >= missing) {
    print(
        "%s: %zu members are missing, and %zu tasks for them are already in the queue; use --tasks to add "
        "more\n%s",
        arguments.folder.c_str(), missing, queued, jobs_text(jobs).c_str());
    return;
  }
  const std::size_t tasks =
      arguments.tasks > 0 ? arguments.tasks : std::min(missing - queued, ensemble::usual_tasks);
  const ensemble::SlurmJob job = submit_array(arguments, tasks);
  if (jobs.unknown.empty())
    for (const ensemble::SlurmJob& before : jobs.recorded)
      if (!jobs.is_queued(before) && before.id != job.id) ensemble::forget_job(arguments.folder, before);
  print(
      "job %s: %zu task%s for %zu missing members; talus ensemble status %s shows them, talus ensemble "
      "cancel %s ends them\n",
      job.id.c_str(), tasks, tasks == 1 ? "" : "s", missing, folder.c_str(), folder.c_str());
}

void cancel(const std::string& folder) {
  const std::vector<ensemble::SlurmJob> recorded = ensemble::recorded_jobs(folder);
  if (recorded.empty()) {
    print("%s: no job of this ensemble is known\n", folder.c_str());
    return;
  }
  for (const auto& [cluster, jobs] : ensemble::by_cluster(recorded)) {
    const ProgramOutput output =
        output_of(ensemble::scancel_words(jobs), ".", ProgramEnvironment::whole,
                  "scancel is not on PATH: run this command on a machine from which jobs can be submitted");
    // A job that has ended and is unknown to Slurm needs no cancelling.
    if (output.status != 0 && output.err.find("Invalid job id") == std::string::npos)
      throw Error(ExitCode::unavailable, fmt::format("scancel failed; it says:\n{}", output.err));
    for (const ensemble::SlurmJob& job : jobs) {
      ensemble::forget_job(folder, job);
      print("job %s is cancelled\n", job.id.c_str());
    }
  }
  print("computed data are kept; talus ensemble submit %s continues\n",
        shell_quoted(ensemble::path_word(folder)).c_str());
}

/// Returns a number that Slurm sets in the environment of each task.
std::string slurm_number(const char* variable) {
  const char* const value = std::getenv(variable);
  if (value == nullptr || !ensemble::is_slurm_number(value))
    throw Error(ExitCode::usage,
                fmt::format("{} is not a number: this command is for tasks of a job array", variable));
  return value;
}

/// Lets Slurm restart a task whose worker was stopped or killed, if members are missing and recent starts
/// have made progress.
void requeue(const std::string& folder) {
  const std::string job = slurm_number("SLURM_ARRAY_JOB_ID"), task = slurm_number("SLURM_ARRAY_TASK_ID");
  ensemble::KnownMembers known;
  const EnsembleView view = view_of_ensemble(folder, known);
  if (count_ended(view) == view.states.size()) {
    print("nothing is missing\n");
    return;
  }
  const ensemble::TaskMemory memory =
      ensemble::after_start(ensemble::read_memory(folder, job, task), ensemble::mark_of(view.plan));
  ensemble::write_memory(folder, job, task, memory);
  if (memory.idle_starts >= ensemble::max_idle_starts)
    throw Error(ExitCode::stopped,
                fmt::format("the task is not queued again: {} consecutive starts made no progress on any "
                            "member; give more --time or memory, and submit again",
                            ensemble::max_idle_starts));
  print("queued again\n");
  std::fflush(stdout);  // Slurm ends this process too
  const ProgramOutput output = output_of(ensemble::requeue_words(job, task), ".", ProgramEnvironment::whole,
                                         "scontrol is not on PATH, so the task cannot be queued again");
  if (output.status != 0)
    throw Error(ExitCode::unavailable,
                fmt::format("the task cannot be queued again; scontrol says:\n{}", output.err));
}

void add_submit(CLI::App& ensemble) {
  auto arguments = std::make_shared<SubmitArguments>();
  CLI::App* command =
      ensemble.add_subcommand("submit", "Compute missing members on a cluster, by a job array of workers");
  command->add_option("FOLDER", arguments->folder, "Folder of the ensemble")->required();
  command
      ->add_option("--engine", arguments->engine,
                   "slurm, or print to write one worker command per line, for GNU parallel")
      ->capture_default_str()
      ->check(one_of({"slurm", "print"}));
  command
      ->add_option("--tasks", arguments->tasks,
                   "Number of workers [as many as members are missing and not yet queued for, at most 100]")
      ->check(in_range(std::size_t{1}, ensemble::max_tasks));
  command->add_option(
      "--time", arguments->time,
      "Time limit of a task, HH:MM or HH:MM:SS; its worker stops in time, and the task is queued again");
  command
      ->add_option("--stale", arguments->stale,
                   "Seconds without a heartbeat after which a worker on another machine is considered dead")
      ->capture_default_str()
      ->check(in_range(1.0, 86400.0));
  command->add_option("options", arguments->options,
                      "Options of sbatch, after --: -- --partition=long --mem=2G");
  command->callback([arguments] { submit(*arguments); });
}

}  // namespace

void add_submit_commands(CLI::App& ensemble) {
  add_submit(ensemble);
  auto folder = std::make_shared<std::string>();
  CLI::App* command = ensemble.add_subcommand("cancel", "Cancel the submitted jobs");
  command->add_option("FOLDER", *folder, "Folder of the ensemble")->required();
  command->callback([folder] { cancel(*folder); });
  command = ensemble.add_subcommand("requeue", "Queue a task of a job array again");
  command->add_option("FOLDER", *folder, "Folder of the ensemble")->required();
  command->group("");  // internal: called by the script of a task
  command->callback([folder] { requeue(*folder); });
}

}  // namespace talus::app
