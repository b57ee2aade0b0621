#pragma once
/// The tasks of the members of an ensemble in addition to runs and their analyses.

#include <string>
#include <variant>

#include "session/perturbation_table.h"

namespace talus::ensemble {

/// No additional task: a member is a run and its analysis.
struct PlainTask {
  bool operator==(const PlainTask&) const = default;
};

/// Analyses periodic beds again for each reading of the paper's definitions (reproduction_values.h).
struct ReadingsTask {
  bool operator==(const ReadingsTask&) const = default;
};

/// The task of each member. A PerturbationPlan perturbs copies of the bed during the run.
using MemberTask = std::variant<PlainTask, ReadingsTask, session::PerturbationPlan>;

/// Returns the manifest's text of a task: "readings", "trials --from 12 ..."; empty for PlainTask.
std::string task_text(const MemberTask& task);

/// Parses such a text. Throws Error(bad_data), naming `path`, for any other text.
MemberTask parse_task(const std::string& text, const std::string& path);

}  // namespace talus::ensemble
