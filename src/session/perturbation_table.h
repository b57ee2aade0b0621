#pragma once
/// The trials of one run as a table, and as the CSV file beside it.

#include <optional>
#include <string>
#include <vector>

#include "session/perturbation.h"

namespace talus {

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
  bool complete = false;               ///< the run has come to its end
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

/// CSV with one row for each trial. Its first line says how the run is perturbed and whether the table is
/// complete.
std::string perturbation_csv(const PerturbationTable& table);

/// The table of such a text, bit for bit. `name` is what messages call it. Throws Error(bad_data) where it is
/// none, or that of another plan.
PerturbationTable parse_perturbation_csv(const std::string& text, const std::string& name,
                                         const PerturbationPlan& plan);

}  // namespace talus
