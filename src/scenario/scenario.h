#pragma once
/// Scenario turns text into what a run needs, and says what is wrong with it. A Scenario has all parameters
/// of a run, and the defaults; a Key (key.h) is one of them with its unit, range and meaning. toml.cpp reads
/// text by the tables of keys.cpp, which docs/scenario.md repeats (a test compares them). Read next: key.h,
/// scripted_command.h, tilt_program.h.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/command.h"
#include "core/snapshot.h"

namespace talus::scenario {

enum class BedBoundary { periodic, walls };
enum class BedFloor { rough, smooth };
enum class DepositionMethod { pour, geometric, collapse, file };
enum class LengthUnit { mean_diameter, metre, centimetre, millimetre, micrometre };
enum class AfterFailure { stop, lower, hold };
enum class SolverMethod { accelerated, gauss_seidel };
enum class GuardAction { stop, warn };

/// A command that the run executes by itself: [[command]] (scenario/scripted_command.h).
struct ScriptedCommand {
  std::optional<double> at;    ///< deg; executed when the tilt first reaches this angle; excludes a time
  std::optional<double> time;  ///< s since the start of the tilt
  CommandKind kind = CommandKind::push;
  Index grain = -1;  ///< this and the following members as in Command
  double x = 0.0, y = 0.0;

  bool operator==(const ScriptedCommand&) const = default;
};

/// All parameters of a run with their defaults; lengths in D refer to the mean diameter.
struct Scenario {
  std::uint64_t seed = 1;

  struct GrainSizes {
    double mean_diameter = 0.01;  ///< D, m
    double size_ratio = 1.5;      ///< Dmax / Dmin; diameters are uniform in [Dmin, Dmax] with mean D
    double density = 2500.0;      ///< kg/m^3

    bool operator==(const GrainSizes&) const = default;
  } grains;

  struct ContactLaw {
    double friction = 0.5;                ///< coefficient between grains, and between grains and floor
    double wall_friction = 0.5;           ///< coefficient between grains and side walls
    double rolling_friction = 0.0;        ///< coefficient mu_r between grains, and between grains and floor
    double restitution = 0.0;             ///< e_n in [0, 1]
    double tangential_restitution = 0.0;  ///< e_t in [-1, 1]

    bool operator==(const ContactLaw&) const = default;
  } contact;

  struct Bed {
    BedBoundary boundary = BedBoundary::periodic;  ///< "periodic" or "walls"
    double length = 200.0;                         ///< L, in mean diameters
    double depth = 40.0;               ///< H, in mean diameters; the bed has length * depth grains
    BedFloor floor = BedFloor::rough;  ///< "rough" (glued grains of diameter D) or "smooth"

    bool operator==(const Bed&) const = default;
  } bed;

  struct Deposition {
    DepositionMethod method = DepositionMethod::pour;
    double arrival_speed = 6.0;  ///< pour: speed of a grain at its first contact, sqrt(g D)
    double rate = 0.25;          ///< pour: layers of L / D grains that arrive in a time of sqrt(D / g)
    /// Geometric: largest angle at which a grain stays where it has fallen, deg.
    double critical_angle = 0.0;
    int sites = 1;     ///< geometric: number of positions tried for a grain; the lowest is kept
    std::string file;  ///< file: path of a run or of a table; empty for other methods
    LengthUnit file_unit = LengthUnit::mean_diameter;  ///< file: unit of a table that does not name one
    double file_scale = 1.0;                           ///< file: factor on the lengths of a table
    int frame = 0;                        ///< file: number of the frame of a run or dump; -1: the last
    bool relax = false;                   ///< file: overlaps are removed first
    double initial_solid_fraction = 0.5;  ///< collapse: solid fraction of the initial loose arrangement
    /// Coefficients between grains, and with side walls, until the bed is at rest; without a value
    /// ("contact") those of the tilt.
    std::optional<double> friction;
    std::optional<double> wall_friction;
    double rest_velocity = 0.005;  ///< rms velocity below which the bed is at rest, g h
    /// Simulated time after the last arrival within which the bed must come to rest, s.
    double max_time = 60.0;

    bool operator==(const Deposition&) const = default;
  } deposition;

  struct Tilt {
    double rate = 1.0;    ///< deg/s
    double step = 0.001;  ///< tilt in one time step h = step / rate, deg
    std::optional<double>
        end_angle;  ///< last tilt, deg; without a value ("repose"): when the slope has failed
    /// Tilt programme as phrases (scenario/tilt_program.h); without any ("none") the tilt grows at `rate`.
    std::vector<std::string> program;
    /// "stop": the run ends at failure; "lower", "hold": the tilt is lowered or held until the flow has
    /// stopped.
    AfterFailure after_failure = AfterFailure::stop;
    double lowering_rate = 0.1;  ///< deg/s

    bool operator==(const Tilt&) const = default;
  } tilt;

  struct SolverParameters {
    SolverMethod method = SolverMethod::accelerated;  ///< "accelerated" or "gauss-seidel"
    double tolerance = 3e-7;                          ///< required natural-map residual eta of a step
    double moving_tolerance = 1e-4;                   ///< required residual while the bed moves
    int max_iterations = 5000;                        ///< iterations in one step
    double allowed_overlap = 1e-4;                    ///< overlaps up to this are left as they are, D
    double overlap_correction = 0.05;                 ///< share of the remaining overlap removed in each step

    bool operator==(const SolverParameters&) const = default;
  } solver;

  struct Output {
    double frame_every = 0.25;       ///< deg of tilt between frames
    double observable_every = 0.01;  ///< deg of tilt between rows of observables
    double checkpoint_every = 30.0;  ///< s of wall time between checkpoints

    bool operator==(const Output&) const = default;
  } output;

  /// Limits that no valid run exceeds.
  struct Guards {
    /// "stop": the run ends with an error; "warn": a warning is recorded.
    GuardAction action = GuardAction::stop;
    double velocity = 1000.0;  ///< largest velocity of a grain, sqrt(g D)
    double overlap = 0.5;      ///< largest overlap, D
    double energy = 100.0;     ///< largest mean kinetic energy of a grain, m g H
    int unconverged = 10000;   ///< largest number of consecutive steps that miss their tolerance

    bool operator==(const Guards&) const = default;
  } guards;

  std::vector<ScriptedCommand> commands;

  bool operator==(const Scenario&) const = default;
};

/// Return the coefficients of friction after the deposition, and until the bed is at rest.
inline Friction friction(const Scenario& scenario) {
  return {scenario.contact.friction, scenario.contact.wall_friction};
}
inline Friction deposition_friction(const Scenario& scenario) {
  return {scenario.deposition.friction.value_or(scenario.contact.friction),
          scenario.deposition.wall_friction.value_or(scenario.contact.wall_friction)};
}

/// States the friction until the bed was at rest where it would otherwise follow a friction that was changed
/// later; `was` is the scenario with which the bed was deposited.
inline void keep_deposition_friction(const Scenario& was, Scenario& scenario) {
  const Friction used = deposition_friction(was), implied = deposition_friction(scenario);
  if (!scenario.deposition.friction && implied.grains != used.grains)
    scenario.deposition.friction = used.grains;
  if (!scenario.deposition.wall_friction && implied.walls != used.walls)
    scenario.deposition.wall_friction = used.walls;
}

/// Whether the run follows the flow after failure.
inline bool follows_failure(const Scenario& scenario) {
  return scenario.tilt.after_failure != AfterFailure::stop;
}

/// Returns the time step h, s.
inline double time_step(const Scenario& scenario) { return scenario.tilt.step / scenario.tilt.rate; }

/// Reads and checks a scenario. `text` is TOML and `name` the name of the file in messages. `overrides` are
/// the "section.key=value" settings of `--set`, and `varied` those of `--vary`; both are checked in the same
/// way and are quoted in messages. Throws Error(bad_data) with all errors of the text, one per line:
/// `name:line:column: error: key 'grains.density' = -1: expected a finite number > 0, in kg/m^3`.
Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides = {},
                        const std::vector<std::string>& varied = {});

/// Reads and parses a file; its content is also copied to `text` unless this is null. Throws
/// Error(missing_input) if the file cannot be read.
Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides = {},
                       std::string* text = nullptr, const std::vector<std::string>& varied = {});

/// Returns the scenario as TOML with all keys written out and units in comments. parse_scenario restores the
/// same scenario, bit for bit.
std::string resolved_toml(const Scenario& scenario);

/// Returns the keys in which two scenarios differ, with both values: "contact.friction is 0.5 there, 0.3
/// here".
std::string differences(const Scenario& there, const Scenario& here);

}  // namespace talus::scenario
