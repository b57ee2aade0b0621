#include "ensemble/slurm.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/core.h>
#include <regex>
#include <sstream>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "ensemble/member_state.h"
#include "io/durable_file.h"
#include "io/run_folder.h"
#include "io/run_store.h"

namespace talus::ensemble {

namespace {

/// Final states of tasks; every other state, also an unknown one, counts as unfinished.
constexpr std::array<const char*, 10> ended_states = {"BOOT_FAIL", "CANCELLED", "COMPLETED", "DEADLINE",
                                                      "FAILED",    "NODE_FAIL", "PREEMPTED", "OUT_OF_MEMORY",
                                                      "TIMEOUT",   "REVOKED"};

/// Adds the option for the cluster of jobs, if sbatch named one.
void add_cluster(std::vector<std::string>& words, const std::vector<SlurmJob>& jobs) {
  if (!jobs.empty() && !jobs.front().cluster.empty()) words.push_back("--clusters=" + jobs.front().cluster);
}

std::vector<std::string> worker_words(const SlurmArray& array) {
  std::vector<std::string> words = {"--stale", fmt::format("{}", array.stale)};
  if (array.time)
    words.insert(words.end(), {"--max-wall", time_text(*array.time - 2.0 * time_reserve(array.time))});
  return words;
}

/// Returns the option for the log of Slurm's own messages, for example about exceeded time or memory. Slurm
/// would expand % and interpret backslashes in a path, so a folder with these gets no such log.
std::string output_word(const std::string& folder) {
  const bool plain = folder.find_first_of("%\\") == std::string::npos;
  return plain ? "--output=workers/slurm-%A_%a.log" : "--output=/dev/null";
}

}  // namespace

double time_reserve(const std::optional<double>& time) { return time ? std::min(60.0, *time / 10.0) : 120.0; }

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(std::max(1.0, seconds));
  return fmt::format("{:02}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string worker_command(const SlurmArray& array) {
  if ((array.program + array.folder).find('\n') != std::string::npos)
    throw Error(ExitCode::usage,
                "{}: a command line cannot contain a path with a line break; give the folder another name",
                array.folder);
  return fmt::format("{} ensemble work {} {}", shell_quoted(array.program), shell_quoted(array.folder),
                     joined(worker_words(array), " "));
}

std::string job_script(const SlurmArray& array) {
  return fmt::format(R"(#!/bin/bash
# One task of a job array: a worker of the ensemble in this folder for each processor of the task (--cpus-per-task).
# Written by talus ensemble submit. Slurm uses its own copy, so changes here have no effect.
talus={}
cd -- {} || exit 66
exec >>"workers/slurm-${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID.log" 2>&1

# USR1 signals that the time is nearly over. TERM signals that the job is cancelled, preempted or requeued; this script
# must then not requeue it. A worker may have received TERM itself: it takes repetitions within a second for one.
workers=()
signalled=''
cancelled=''
trap 'signalled=yes; kill -TERM "${{workers[@]}}"' USR1
trap 'signalled=yes; cancelled=yes; kill -TERM "${{workers[@]}}"' TERM INT
for ((k = 0; k < ${{SLURM_CPUS_PER_TASK:-1}}; k++)); do
  [[ ! $signalled ]] || break
  "$talus" ensemble work . {} &
  workers+=("$!")
done

# 75: stopped with its member at a checkpoint; above 128: killed. Any other code is final.
result=0
stopped=''
for worker in "${{workers[@]}}"; do
  while :; do
    signalled=''
    wait "$worker"
    code=$?
    [[ $signalled ]] || break # a signal interrupts the wait, not the worker
  done
  ((code == 0)) || result=$code
  ((code != 75 && code <= 128)) || stopped=yes
done
if [[ $cancelled || ! $stopped ]]; then
  exit "$result"
fi
exec "$talus" ensemble requeue .
)",
                     shell_quoted(array.program), shell_quoted(array.folder),
                     joined(worker_words(array), " "));
}

std::vector<std::string> sbatch_arguments(const SlurmArray& array, const std::vector<std::string>& options) {
  const std::string name = std::filesystem::path(array.folder).filename().string();
  std::vector<std::string> words = {
      "sbatch",
      "--parsable",
      fmt::format("--array=1-{}", array.tasks),
      "--ntasks=1",
      "--requeue",
      "--open-mode=append",
      fmt::format("--signal=B:USR1@{:.0f}", std::max(1.0, time_reserve(array.time))),
      "--job-name=" + visible_word(name, 40),
      output_word(array.folder),
  };
  if (array.time) words.push_back("--time=" + time_text(*array.time));
  words.insert(words.end(), options.begin(), options.end());
  words.emplace_back("slurm/job.sh");
  return words;
}

bool is_slurm_number(const std::string& text) {
  return !text.empty() && text.size() <= 18 && text.find_first_not_of("0123456789") == std::string::npos;
}

std::optional<SlurmJob> parse_submitted(const std::string& printed) {
  const std::string line = split(printed, '\n').back();
  const std::size_t end = line.find(';');
  SlurmJob job{line.substr(0, end), end == std::string::npos ? "" : line.substr(end + 1), 0};
  const bool plain = visible_word(job.cluster) == job.cluster && job.cluster.find(',') == std::string::npos;
  if (!is_slurm_number(job.id) || !plain) return std::nullopt;
  return job;
}

std::size_t total(const QueuedTasks& tasks) {
  std::size_t sum = 0;
  for (const auto& [state, count] : tasks.count) sum += count;
  return sum;
}

std::vector<std::string> squeue_words(const std::vector<SlurmJob>& jobs) {
  std::vector<std::string> words = {"squeue", "--noheader", "--array", "--format=%F|%T|%r",
                                    "--jobs=" + joined(jobs, ",", &SlurmJob::id)};
  add_cluster(words, jobs);
  return words;
}

std::vector<std::string> scancel_words(const std::vector<SlurmJob>& jobs) {
  std::vector<std::string> words = {"scancel"};
  add_cluster(words, jobs);
  for (const SlurmJob& job : jobs) words.push_back(job.id);
  return words;
}

std::vector<std::string> requeue_words(const std::string& job, const std::string& task) {
  return {"scontrol", "requeue", fmt::format("{}_{}", job, task)};
}

std::map<std::string, QueuedTasks> parse_queue(const std::string& printed) {
  std::map<std::string, QueuedTasks> queue;
  for (const std::string& line : split(printed, '\n')) {
    const std::vector<std::string> fields = split(line, '|');
    if (fields.size() < 3 || !is_slurm_number(fields[0])) continue;
    const std::string &state = fields[1], &reason = fields[2];
    if (state.empty() || std::ranges::find(ended_states, state) != ended_states.end()) continue;
    QueuedTasks& tasks = queue[fields[0]];
    ++tasks.count[state];
    if (state == "PENDING" && reason != "None" && !reason.empty() &&
        std::ranges::find(tasks.reasons, reason) == tasks.reasons.end())
      tasks.reasons.push_back(reason);
  }
  return queue;
}

std::map<std::string, std::vector<SlurmJob>> by_cluster(const std::vector<SlurmJob>& jobs) {
  std::map<std::string, std::vector<SlurmJob>> clusters;
  for (const SlurmJob& job : jobs) clusters[job.cluster].push_back(job);
  return clusters;
}

namespace {

constexpr const char* job_header = "job,cluster,tasks\n";

std::string job_path(const std::string& folder, const std::string& id) {
  return path_in(slurm_folder(folder), "job-" + id + ".csv");
}

std::string memory_path(const std::string& folder, const std::string& job, const std::string& task) {
  return path_in(slurm_folder(folder), fmt::format("task-{}_{}.csv", job, task));
}

/// Returns the number in "job-12.csv"; empty for another name.
std::string id_in(const std::string& name) {
  static const std::regex form("job-([0-9]{1,18})[.]csv");
  std::smatch found;
  return std::regex_match(name, found, form) ? found[1].str() : "";
}

SlurmJob read_job(const std::string& folder, const std::string& id) {
  const std::string path = job_path(folder, id);
  const std::vector<std::string> lines = lines_of(io::read_text(path));
  const std::vector<std::string> fields = split(lines.size() > 1 ? lines[1] : "", ',');
  if (lines.empty() || lines[0] + "\n" != job_header || fields.size() != 3 || fields[0] != id ||
      !is_slurm_number(fields[2]))
    throw Error(ExitCode::bad_data,
                path + ": expected a job recorded by talus ensemble submit; remove the file, and end job " +
                    id + " with scancel if it exists");
  return {id, fields[1], std::stoul(fields[2].substr(0, 9))};
}

/// Returns the committed steps of a run under way; 0 if it has not begun or cannot be read.
std::uint64_t committed_steps(const std::string& run) {
  std::uint64_t steps = 0;
  try {
    for (const io::StoredSegment& segment : io::read_manifest(io::run_folder(run)).segments)
      steps += segment.steps;
  } catch (const Error&) {
    return 0;  // the worker that computes it reports what is wrong
  }
  return steps;
}

}  // namespace

std::string slurm_folder(const std::string& folder) { return path_in(folder, "slurm"); }

void record_job(const std::string& folder, const SlurmJob& job) {
  io::write_text(job_path(folder, job.id),
                 fmt::format("{}{},{},{}\n", job_header, job.id, job.cluster, job.tasks));
}

void forget_job(const std::string& folder, const SlurmJob& job) {
  io::remove_file(job_path(folder, job.id));
  for (std::size_t task = 1; task <= std::min(job.tasks, max_tasks); ++task)
    io::remove_file(memory_path(folder, job.id, std::to_string(task)));
}

std::vector<SlurmJob> recorded_jobs(const std::string& folder) {
  std::vector<SlurmJob> jobs;
  std::error_code error;  // a folder that does not exist has no jobs yet
  for (const std::string& name : names_in(slurm_folder(folder), error))
    if (const std::string id = id_in(name); !id.empty()) jobs.push_back(read_job(folder, id));
  std::ranges::sort(jobs, {}, [](const SlurmJob& job) { return std::stoull(job.id); });
  return jobs;
}

EnsembleMark mark_of(const EnsemblePlan& plan) {
  EnsembleMark mark;
  const std::vector<MemberState> states = scan_members(plan);
  for (std::size_t m = 0; m < states.size(); ++m) {
    const std::string& path = plan.members[m].path;
    if (states[m].stage == MemberStage::done || states[m].stage == MemberStage::failed) {
      ++mark.done;
      continue;
    }
    if (io::run_presence(path) == io::RunPresence::folder) mark.steps += committed_steps(path);
  }
  return mark;
}

TaskMemory after_start(const TaskMemory& before, const EnsembleMark& now) {
  // Members that were added or are retried may set the mark back; such a start also counts as idle.
  return {now, before.mark < now ? 0 : before.idle_starts + 1};
}

TaskMemory read_memory(const std::string& folder, const std::string& job, const std::string& task) {
  TaskMemory memory;
  const std::string path = memory_path(folder, job, task);
  if (!is_there(path)) return memory;
  std::istringstream text = text_stream(io::read_text(path));
  std::string header;
  std::getline(text, header);
  char comma = ',';
  text >> memory.mark.done >> comma >> memory.mark.steps >> comma >> memory.idle_starts;
  return text ? memory : TaskMemory{};
}

void write_memory(const std::string& folder, const std::string& job, const std::string& task,
                  const TaskMemory& memory) {
  io::write_text(memory_path(folder, job, task),
                 fmt::format("done,steps,idle_starts\n{},{},{}\n", memory.mark.done, memory.mark.steps,
                             memory.idle_starts));
}

}  // namespace talus::ensemble
