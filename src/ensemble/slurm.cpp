#include "ensemble/slurm.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "ensemble/plan.h"

namespace talus::ensemble {
namespace {

/// Final states of tasks; every other state, also an unknown one, counts as unfinished.
constexpr std::array<const char*, 10> ended_states = {"BOOT_FAIL", "CANCELLED", "COMPLETED", "DEADLINE",
                                                      "FAILED",    "NODE_FAIL", "PREEMPTED", "OUT_OF_MEMORY",
                                                      "TIMEOUT",   "REVOKED"};

std::vector<std::string> cluster_words(const std::vector<SlurmJob>& jobs) {
  if (jobs.empty() || jobs.front().cluster.empty()) return {};
  return {"--clusters=" + jobs.front().cluster};
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
                fmt::format("{}: a command line cannot contain a path with a line break; give the folder "
                            "another name",
                            array.folder));
  return fmt::format("{} ensemble work {} {}", shell_quoted(array.program), shell_quoted(array.folder),
                     joined(worker_words(array), " "));
}

std::string job_script(const SlurmArray& array) {
  return fmt::format(R"(#!/bin/bash
# One task of a job array: a worker of the ensemble in this folder. Written by talus ensemble submit. Slurm uses its
# own copy, so changes here have no effect.
talus={}
cd -- {} || exit 66
exec >>"workers/slurm-${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID.log" 2>&1

# USR1 signals that the time is nearly over. TERM signals that the job is cancelled, preempted or requeued; this script
# must then not requeue it. The worker may have received TERM itself: it takes repetitions within a second for one.
signalled=''
cancelled=''
trap 'signalled=yes; kill -TERM "$worker"' USR1
trap 'signalled=yes; cancelled=yes; kill -TERM "$worker"' TERM INT
"$talus" ensemble work . {} &
worker=$!
while :; do
  signalled=''
  wait "$worker"
  code=$?
  [[ $signalled ]] || break # a signal interrupts the wait, not the worker
done

# 75: stopped with its member at a checkpoint; above 128: killed. Any other code is final.
if [[ $cancelled ]] || ((code != 75 && code <= 128)); then
  exit "$code"
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
  const std::vector<std::string> cluster = cluster_words(jobs);
  words.insert(words.end(), cluster.begin(), cluster.end());
  return words;
}

std::vector<std::string> scancel_words(const std::vector<SlurmJob>& jobs) {
  std::vector<std::string> words = {"scancel"};
  const std::vector<std::string> cluster = cluster_words(jobs);
  words.insert(words.end(), cluster.begin(), cluster.end());
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

}  // namespace talus::ensemble
