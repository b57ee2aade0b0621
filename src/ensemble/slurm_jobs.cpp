#include "ensemble/slurm_jobs.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <sstream>
#include <tuple>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/paths.h"
#include "base/text_stream.h"
#include "ensemble/member_state.h"
#include "io/durable_file.h"
#include "io/manifest.h"
#include "io/run_store.h"

namespace talus::ensemble {
namespace {

namespace fs = std::filesystem;

constexpr const char* job_header = "job,cluster,tasks\n";
constexpr const char* job_beginning = "job-";
constexpr const char* ending = ".csv";

std::string job_path(const std::string& folder, const std::string& id) {
  return (fs::path(slurm_folder(folder)) / (job_beginning + id + ending)).string();
}

std::string memory_path(const std::string& folder, const std::string& job, const std::string& task) {
  return (fs::path(slurm_folder(folder)) / fmt::format("task-{}_{}.csv", job, task)).string();
}

/// Returns the number in "job-12.csv"; empty for another name.
std::string id_in(const std::string& name) {
  const std::string before = job_beginning, after = ending;
  if (!name.starts_with(before) || !name.ends_with(after) || name.size() < before.size() + after.size())
    return "";
  const std::string id = name.substr(before.size(), name.size() - before.size() - after.size());
  return is_slurm_number(id) ? id : "";
}

SlurmJob read_job(const std::string& folder, const std::string& id) {
  const std::string path = job_path(folder, id);
  std::istringstream lines = text_stream(io::read_text(path));
  std::string header, row;
  std::getline(lines, header);
  std::getline(lines, row);
  const std::vector<std::string> fields = split(row, ',');
  if (header + "\n" != job_header || fields.size() != 3 || fields[0] != id || !is_slurm_number(fields[2]))
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

std::string slurm_folder(const std::string& folder) { return (fs::path(folder) / "slurm").string(); }

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

bool is_further(const EnsembleMark& now, const EnsembleMark& before) {
  return std::tie(now.done, now.steps) > std::tie(before.done, before.steps);
}

TaskMemory after_start(const TaskMemory& before, const EnsembleMark& now) {
  // Members that were added or are retried may set the mark back; such a start also counts as idle.
  return {now, is_further(now, before.mark) ? 0 : before.idle_starts + 1};
}

TaskMemory read_memory(const std::string& folder, const std::string& job, const std::string& task) {
  TaskMemory memory;
  const std::string path = memory_path(folder, job, task);
  std::error_code unknown;
  if (!fs::exists(path, unknown)) return memory;
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
