#pragma once
/// The trials of one run as a table, and as the rows that are stored with it.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "session/perturbation.h"

namespace talus::session {

/// When a run is perturbed, and where.
struct PerturbationPlan {
  double first = 10.0;  ///< deg, tilt of the first state
  double every = 0.5;   ///< deg, from one state to the next
  SurfacePatch patch;

  static constexpr double highest = 60.0, least_every = 1e-3;  ///< deg, bounds of both

  bool operator==(const PerturbationPlan&) const = default;
};

/// The trials of one state of a run.
struct PerturbedState {
  double tilt = 0.0;  ///< deg
  std::vector<Trial> trials;
};

struct PerturbationTable {
  PerturbationPlan plan;
  std::vector<PerturbedState> states;  ///< ascending in tilt
};

/// A patch as "10x2", width and depth in D.
std::string patch_text(const SurfacePatch& patch);
/// The patch of such a text; no value where it has another form, or a side that is not a number above 0.
std::optional<SurfacePatch> parse_patch(const std::string& text);

/// A plan as the options of `talus perturb`: "--from 12 --every 0.5 --patch 10x2".
std::string plan_text(const PerturbationPlan& plan);
/// The plan of such a text; no value where plan_text writes no such one.
std::optional<PerturbationPlan> parse_plan(const std::string& text);

/// The fact in the provenance of a run that says how it is perturbed: a plan_text.
inline constexpr const char* trials_fact = "trials";

/// A row for each trial of a state, which the run has come to in so many steps.
std::vector<TrialRow> rows_of(const PerturbedState& state, std::int64_t step);

/// The table of the trials that are stored with a run, bit for bit. Throws Error(bad_data), naming `path`,
/// where the run is not perturbed by this plan.
PerturbationTable table_of(const io::RunFile& run, const PerturbationPlan& plan, const std::string& path);

}  // namespace talus::session
