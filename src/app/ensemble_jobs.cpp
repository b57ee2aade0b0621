#include "app/ensemble_jobs.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>

#include "app/program_output.h"
#include "base/errors.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "ensemble/slurm_jobs.h"

namespace talus::app {
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

std::size_t count_queued(const EnsembleJobs& jobs) {
  std::size_t count = 0;
  for (const auto& [id, tasks] : jobs.queue) count += ensemble::total(tasks);
  return count;
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
