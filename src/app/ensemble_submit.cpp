#include "app/ensemble_submit.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <memory>

#include "app/ensemble_report.h"
#include "app/options.h"
#include "app/other_programs.h"
#include "app/program_end.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "ensemble/member_state.h"
#include "ensemble/slurm.h"
#include "ensemble/worker.h"
#include "io/durable_file.h"
#include "session/estimate.h"

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
  for (std::size_t task = 0; task < tasks; ++task) print("{}\n", command);
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
    throw Error(ExitCode::unavailable, "sbatch submitted nothing{}",
                said.empty() ? "" : "; it says:\n" + said);
  }
  job->tasks = tasks;
  ensemble::record_job(arguments.folder, *job);
  if (!output.err.empty()) print_error("{}\n", output.err);
  return *job;
}

/// Returns "; a member takes about 2 h 05 min on one core, and up to 300 MB of memory": the largest of the
/// variants. Empty if it cannot be estimated.
std::string cost_text(const ensemble::EnsemblePlan& plan) {
  session::Estimate largest;
  try {
    for (const ensemble::Variant& variant : plan.variants) {
      const session::Estimate each = session::estimate(variant.scenario);
      largest.seconds = std::max(largest.seconds, each.seconds);
      largest.memory = std::max(largest.memory, each.memory);
    }
  } catch (const Error&) {
    return "";  // the file of a bed is missing; the members report it
  }
  return fmt::format("; a member takes about {} on one core, and up to {} of memory",
                     session::duration_text(largest.seconds), session::size_text(largest.memory));
}

void submit(const SubmitArguments& arguments) {
  ensemble::KnownMembers known;
  const EnsembleView view = view_of_ensemble(arguments.folder, known);
  const std::size_t missing = view.states.size() - count_ended(view);
  if (missing == 0) {
    (arguments.engine == "print" ? print_error_text : print_text)(nothing_text(view));
    return;
  }
  if (arguments.engine == "print") return print_commands(arguments, missing);
  const EnsembleJobs jobs = jobs_of_ensemble(arguments.folder);
  std::size_t queued = 0;
  for (const auto& [id, tasks] : jobs.queue) queued += ensemble::total(tasks);
  const std::string folder = shell_quoted(ensemble::path_word(arguments.folder));
  if (arguments.tasks == 0 && queued >= missing) {
    print("{}: {} missing, {} in the queue already; use --tasks to add more\n{}", arguments.folder,
          counted(missing, "member"), counted(queued, "task"), jobs_text(jobs));
    return;
  }
  const std::size_t tasks =
      arguments.tasks > 0 ? arguments.tasks : std::min(missing - queued, ensemble::usual_tasks);
  const ensemble::SlurmJob job = submit_array(arguments, tasks);
  if (jobs.unknown.empty())
    for (const ensemble::SlurmJob& before : jobs.recorded)
      if (!jobs.queue.contains(before.id) && before.id != job.id)
        ensemble::forget_job(arguments.folder, before);
  print(
      "job {0}: {1} for {2}{3}; talus ensemble status {4} shows them, talus ensemble cancel {4} ends them\n",
      job.id, counted(tasks, "task"), counted(missing, "missing member"), cost_text(view.plan), folder);
}

void cancel(const std::string& folder) {
  const std::vector<ensemble::SlurmJob> recorded = ensemble::recorded_jobs(folder);
  if (recorded.empty()) {
    print("{}: no job of this ensemble is known\n", folder);
    return;
  }
  for (const auto& [cluster, jobs] : ensemble::by_cluster(recorded)) {
    const ProgramOutput output =
        output_of(ensemble::scancel_words(jobs), ".", ProgramEnvironment::whole,
                  "scancel is not on PATH: run this command on a machine from which jobs can be submitted");
    // A job that has ended and is unknown to Slurm needs no cancelling.
    if (output.status != 0 && output.err.find("Invalid job id") == std::string::npos)
      throw Error(ExitCode::unavailable, "scancel failed; it says:\n{}", output.err);
    for (const ensemble::SlurmJob& job : jobs) {
      ensemble::forget_job(folder, job);
      print("job {} is cancelled\n", job.id);
    }
  }
  print("computed data are kept; talus ensemble submit {} continues\n",
        shell_quoted(ensemble::path_word(folder)));
}

/// Returns a number that Slurm sets in the environment of each task.
std::string slurm_number(const char* variable) {
  const char* const value = std::getenv(variable);
  if (value == nullptr || !ensemble::is_slurm_number(value))
    throw Error(ExitCode::usage, "{} is not a number: this command is for tasks of a job array", variable);
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
                "the task is not queued again: {} consecutive starts made no progress on any member; give "
                "more --time or memory, and submit again",
                ensemble::max_idle_starts);
  print("queued again\n");
  std::fflush(stdout);  // Slurm ends this process too
  const ProgramOutput output = output_of(ensemble::requeue_words(job, task), ".", ProgramEnvironment::whole,
                                         "scontrol is not on PATH, so the task cannot be queued again");
  if (output.status != 0)
    throw Error(ExitCode::unavailable, "the task cannot be queued again; scontrol says:\n{}", output.err);
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
  add_option(*command, "--tasks", arguments->tasks, "N",
             "Number of workers [as many as members are missing and not yet queued for, at most 100]")
      ->check(in_range(std::size_t{1}, ensemble::max_tasks));
  add_option(*command, "--time", arguments->time, "HH:MM[:SS]",
             "Time limit of a task; its worker stops in time, and the task is queued again");
  add_option(*command, "--stale", arguments->stale, "S",
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

namespace {

/// Queries squeue for the jobs of one cluster.
void query_squeue(const std::vector<ensemble::SlurmJob>& jobs, EnsembleJobs& found) {
  try {
    const ProgramOutput output =
        output_of(ensemble::squeue_words(jobs), ".", ProgramEnvironment::whole,
                  "squeue is not on PATH: this machine is not part of a Slurm cluster");
    // Jobs that Slurm has forgotten are an error of squeue if it is asked for no other job.
    const bool gone = output.err.find("Invalid job id") != std::string::npos;
    if (output.status != 0 && !gone) found.unknown = output.err.empty() ? "squeue failed" : output.err;
    found.queue.merge(ensemble::parse_queue(output.out));
  } catch (const Error& error) {
    if (error.code() != ExitCode::unavailable) throw;
    found.unknown = error.what();
  }
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string tasks_text(const ensemble::QueuedTasks& tasks) {
  std::vector<std::string> parts;
  for (const auto& [state, count] : tasks.count) {
    const std::string why = state == "PENDING" && !tasks.reasons.empty()
                                ? fmt::format(" ({})", visible_word(joined(tasks.reasons, ", "), 120))
                                : "";
    parts.push_back(fmt::format("{} {}{}", count, lower(visible_word(state)), why));
  }
  return joined(parts, ", ");
}

Json tasks_json(const ensemble::QueuedTasks& tasks) {
  Json states = Json::object();
  for (const auto& [state, count] : tasks.count) states[lower(state)] = count;
  return states;
}

}  // namespace

EnsembleJobs jobs_of_ensemble(const std::string& folder) {
  EnsembleJobs found{ensemble::recorded_jobs(folder), {}, ""};
  for (const auto& [cluster, jobs] : ensemble::by_cluster(found.recorded)) query_squeue(jobs, found);
  return found;
}

std::string jobs_text(const EnsembleJobs& jobs) {
  std::string text;
  for (const ensemble::SlurmJob& job : jobs.recorded) {
    const auto tasks = jobs.queue.find(job.id);
    if (tasks != jobs.queue.end())
      text += fmt::format("job {}: {}\n", job.id, tasks_text(tasks->second));
    else if (jobs.unknown.empty())
      text += fmt::format("job {}: no longer in the queue\n", job.id);
    else
      text += fmt::format("job {}: unknown, {}\n", job.id, visible(jobs.unknown));
  }
  return text;
}

Json jobs_json(const EnsembleJobs& jobs) {
  Json json = Json::object();
  for (const ensemble::SlurmJob& job : jobs.recorded) {
    const auto found = jobs.queue.find(job.id);
    const bool known = found != jobs.queue.end();
    const ensemble::QueuedTasks tasks = known ? found->second : ensemble::QueuedTasks{};
    json[job.id] = {{"cluster", job.cluster},
                    {"tasks", job.tasks},
                    {"queued", known || jobs.unknown.empty() ? tasks_json(tasks) : Json()},
                    {"reasons", tasks.reasons}};
  }
  return json;
}

}  // namespace talus::app
