#pragma once
/// The scenario: every parameter of a run, checked. The reference of all keys is docs/scenario.md; the table
/// of keys, units and ranges is scenario/keys.cpp (the defaults are those of this struct); a test compares
/// both.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/command.h"

namespace talus::scenario {

enum class BedBoundary { periodic, walls };
enum class BedFloor { rough, smooth };
enum class DepositionMethod { pour, geometric, collapse, file };
enum class LengthUnit { mean_diameter, metre, centimetre, millimetre, micrometre };
enum class AfterFailure { stop, lower, hold };
enum class SolverMethod { accelerated, gauss_seidel };
enum class GuardAction { stop, warn };

/// A command that a run gives itself: [[command]] (scenario/scripted_command.h).
struct ScriptedCommand {
  std::optional<double> at;    ///< deg: when the tilt has first reached it; with it no time
  std::optional<double> time;  ///< s since the tilt began
  CommandKind kind = CommandKind::push;
  Index grain = -1;  ///< this and the rest as in Command
  double x = 0.0, y = 0.0;

  bool operator==(const ScriptedCommand&) const = default;
};

struct Scenario {
  std::uint64_t seed = 1;

  struct GrainSizes {
    double mean_diameter = 0.01;  ///< D, m
    double size_ratio = 1.5;      ///< Dmax / Dmin; diameters are uniform in [Dmin, Dmax] with mean D
    double density = 2500.0;      ///< kg/m^3

    bool operator==(const GrainSizes&) const = default;
  } grains;

  struct ContactLaw {
    double friction = 0.5;                ///< between grains, and between grains and floor
    double wall_friction = 0.5;           ///< between grains and side walls
    double rolling_friction = 0.0;        ///< mu_r, between grains, and between grains and floor
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
    double arrival_speed = 6.0;   ///< pour: sqrt(g D), of a grain when it first touches
    double rate = 0.25;           ///< pour: layers of L / D grains that arrive in sqrt(D / g)
    double critical_angle = 0.0;  ///< geometric: deg, up to which a grain stays where it has fallen
    int sites = 1;                ///< geometric: places tried for a grain, of which the lowest is kept
    std::string file;             ///< file: path of a run or of a table; empty for other methods
    LengthUnit file_unit = LengthUnit::mean_diameter;  ///< file: of a table, where it names none itself
    double file_scale = 1.0;                           ///< file: factor on the lengths of a table
    int frame = 0;                                     ///< file: of a run or a dump; -1: the last
    bool relax = false;                                ///< file: overlaps are pushed apart
    double initial_solid_fraction = 0.5;  ///< collapse: of the loose arrangement the grains fall from
    /// Between grains, and with side walls, while the bed is deposited and comes to rest; without a value
    /// ("contact"): as in the tilt.
    std::optional<double> friction;
    std::optional<double> wall_friction;
    double rest_velocity =
        0.005;  ///< the bed is at rest when its rms velocity stays below this, in units of g h
    double max_time =
        60.0;  ///< s of simulated time after the last arrival in which a bed has to come to rest

    bool operator==(const Deposition&) const = default;
  } deposition;

  struct Tilt {
    double rate = 1.0;                ///< deg/s
    double step = 0.001;              ///< deg per time step; h = step / rate
    std::optional<double> end_angle;  ///< deg; without a value ("repose"): until the slope fails
    /// The course of the tilt as phrases (scenario/tilt_program.h); without any ("none"): it grows at `rate`
    std::vector<std::string> program;
    /// "stop": the run ends there; "lower", "hold": the tilt is lowered or kept until the flow has stopped
    AfterFailure after_failure = AfterFailure::stop;
    double lowering_rate = 0.1;  ///< deg/s

    bool operator==(const Tilt&) const = default;
  } tilt;

  struct SolverParameters {
    SolverMethod method = SolverMethod::accelerated;  ///< "accelerated" or "gauss-seidel"
    double tolerance = 3e-7;                          ///< natural-map residual eta asked of each step
    double moving_tolerance = 1e-4;                   ///< the same while the bed moves
    int max_iterations = 5000;                        ///< in one step
    double allowed_overlap = 1e-4;                    ///< D: overlaps up to this are left as they are
    double overlap_correction = 0.05;                 ///< share of the rest removed in each step

    bool operator==(const SolverParameters&) const = default;
  } solver;

  struct Output {
    double frame_every = 0.25;       ///< deg of tilt between frames
    double observable_every = 0.01;  ///< deg of tilt between rows of observables
    double checkpoint_every = 30.0;  ///< s of wall time between checkpoints

    bool operator==(const Output&) const = default;
  } output;

  /// What no sound run does.
  struct Guards {
    GuardAction action = GuardAction::stop;  ///< "stop": the run ends with an error; "warn": it is recorded
    double velocity = 1000.0;                ///< of a grain, sqrt(g D)
    double overlap = 0.5;                    ///< D
    double energy = 100.0;                   ///< kinetic, of a grain in the mean, m g H
    int unconverged = 10000;                 ///< steps in a row that did not reach their tolerance

    bool operator==(const Guards&) const = default;
  } guards;

  std::vector<ScriptedCommand> commands;

  bool operator==(const Scenario&) const = default;
};

/// h, s.
inline double time_step(const Scenario& scenario) { return scenario.tilt.step / scenario.tilt.rate; }

/// Reads and checks a scenario.
/// `text` is the TOML, `name` the name of the file in messages; `overrides` are "section.key=value" settings
/// of
/// `--set`, `varied` those of `--vary`, which go through the same checks and appear in messages as they are.
/// Throws Error(bad_data) with every error of the text at once, one a line: `name:line:column: error: key
/// 'grains.density' = -1: expected a finite number > 0, in kg/m^3`.
Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides = {},
                        const std::vector<std::string>& varied = {});

/// Reads a file, into `text` as well where that is given, and parses it. Throws Error(missing_input) where it
/// cannot be read.
Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides = {},
                       std::string* text = nullptr, const std::vector<std::string>& varied = {});

/// The scenario with every key written out, as TOML with units in comments. parse_scenario gives the same
/// scenario back, bit for bit.
std::string resolved_toml(const Scenario& scenario);

/// The keys in which two scenarios differ, with both values: "contact.friction is 0.5 there, 0.3 here".
std::string differences(const Scenario& there, const Scenario& here);

}  // namespace talus::scenario
