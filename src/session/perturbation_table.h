#pragma once
/// Trials of one run as a table, and as the rows that are stored with it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "session/perturbation.h"

namespace talus::session {

/// Tilts and place at which a run is perturbed.
struct PerturbationPlan {
  double first = 10.0;  ///< deg, tilt of the first state
  double every = 0.5;   ///< deg, interval between states
  SurfacePatch patch;

  /// deg: largest value of both, and smallest interval.
  static constexpr double highest = 60.0, min_every = 1e-3;

  bool operator==(const PerturbationPlan&) const = default;
};

/// Trials of one state of a run.
struct PerturbedState {
  double tilt = 0.0;  ///< deg
  std::vector<Trial> trials;
};

struct PerturbationTable {
  PerturbationPlan plan;
  std::vector<PerturbedState> states;  ///< ascending in tilt
};

/// Returns a patch as "10x2", width and depth in D.
std::string patch_text(const SurfacePatch& patch);
/// Parses such a text; no value if it has another form, or a side that is not a number above 0.
std::optional<SurfacePatch> parse_patch(const std::string& text);

/// Returns a plan as the options of `talus perturb`: "--from 12 --every 0.5 --patch 10x2".
std::string plan_text(const PerturbationPlan& plan);
/// Parses such a text; no value if plan_text does not write it.
std::optional<PerturbationPlan> parse_plan(const std::string& text);

/// Fact in the provenance of a run that states its perturbation plan: a plan_text.
inline constexpr const char* trials_fact = "trials";

/// Returns a row for each trial of a state that the run has reached at `step`.
std::vector<TrialRow> rows_of(const PerturbedState& state, std::int64_t step);

/// Returns the table of the trials stored with a run, bit for bit. Throws Error(bad_data), naming `path`, if
/// the run is not perturbed by this plan.
PerturbationTable table_of(const io::RunFile& run, const PerturbationPlan& plan, const std::string& path);

}  // namespace talus::session
