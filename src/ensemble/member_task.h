#pragma once
/// The tasks of the members of an ensemble in addition to runs and their analyses: trials of pushes, and the
/// readings of the paper's definitions (docs/reproduce.md).

#include <optional>
#include <string>
#include <variant>

#include "ensemble/plan.h"
#include "io/run_file.h"
#include "io/run_store.h"
#include "runs/analysis_run.h"

namespace talus::ensemble {

/// No additional task: a member is a run and its analysis.
using PlainTask = std::monostate;

/// Analyses periodic beds again for each reading of the paper's definitions (make_readings).
struct ReadingsTask {
  bool operator==(const ReadingsTask&) const = default;
};

/// Part of the free surface, in mean diameters D.
struct SurfacePatch {
  double width = 10.0;  ///< along the bed
  double depth = 2.0;   ///< below the mean free surface over the patch

  bool operator==(const SurfacePatch&) const = default;
};

/// Pushes the patch in the middle of copies of the bed during the run (talus perturb).
struct TrialsTask {
  double first = 10.0;  ///< deg, tilt of the first state
  double every = 0.5;   ///< deg, interval between states
  SurfacePatch patch;

  /// deg: largest value of both, and smallest interval.
  static constexpr double highest = 60.0, min_every = 1e-3;

  bool operator==(const TrialsTask&) const = default;
};

using MemberTask = std::variant<PlainTask, ReadingsTask, TrialsTask>;

/// Returns a patch as "10x2", width and depth in D.
std::string patch_text(const SurfacePatch& patch);
/// Parses such a text; no value if it has another form, or a side that is not a number above 0.
std::optional<SurfacePatch> parse_patch(const std::string& text);

/// Returns trials as the options of `talus perturb`: "--from 12 --every 0.5 --patch 10x2".
std::string plan_text(const TrialsTask& trials);

/// Returns the manifest's text of a task: "readings", "trials --from 12 ..."; empty for PlainTask.
std::string task_text(const MemberTask& task);

/// Parses such a text. Throws Error(bad_data), naming `path`, for any other text.
MemberTask parse_task(const std::string& text, const std::string& path);

/// Analyses the run of a periodic bed for each reading and returns the values; valid stored readings are
/// reused. A bed between walls has none. Throws as analyse_run does.
std::vector<io::StoredReading> make_readings(const Member& member, const io::RunFile& run,
                                             const runs::AnalysisProgress& progress);

/// Computes and stores the readings that the complete, analysed run of a member lacks. Throws as
/// store_readings does.
void complete_readings(const Member& member);

}  // namespace talus::ensemble
