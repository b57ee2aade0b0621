#pragma once
/// What the members of an ensemble are besides runs and their analyses.

#include <string>
#include <variant>

#include "session/perturbation_table.h"

namespace talus::ensemble {

/// A member is a run and its analysis, no more.
struct PlainTask {
  bool operator==(const PlainTask&) const = default;
};

/// Periodic beds are analysed again for each reading of the paper's definitions (reproduction_values.h).
struct ReadingsTask {
  bool operator==(const ReadingsTask&) const = default;
};

/// A PerturbationPlan: copies of the bed are pushed while the run goes on.
using MemberTask = std::variant<PlainTask, ReadingsTask, session::PerturbationPlan>;

/// "readings", "trials --from 12 ...": what the manifest says of the task. Plain: empty.
std::string task_text(const MemberTask& task);

/// Throws Error(bad_data), naming `path`, where it is no such text.
MemberTask parse_task(const std::string& text, const std::string& path);

}  // namespace talus::ensemble
