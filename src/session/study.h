#pragma once
/// A study: one scenario run again and again, each time with one thing changed, and each variation with the
/// same seeds. It shows what the figures of a run depend on, and what they do not (docs/study.md).

#include <cstdint>
#include <string>
#include <vector>

#include "session/scenario.h"

namespace talus {

struct Variation {
  std::string name;                   ///< "baseline", "tilt.step=0.002", "tilt.rate=2,tilt.step=0.002"
  std::vector<std::string> settings;  ///< "key=value": all that its runs change in the scenario file
};

struct StudyRun {
  std::size_t variation = 0;  ///< index into StudyPlan::variations
  std::uint64_t seed = 0;
  std::string name;  ///< "tilt.step=0.002/seed-1": the path of its file below the folder, without ".h5"
  Scenario scenario;
};

/// One factor at a time: the scenario as it is (variation 0, the baseline), and beside it each value of each
/// axis alone.
struct StudyPlan {
  std::string scenario_file;
  std::vector<std::uint64_t> seeds;  ///< ascending
  std::vector<Variation> variations;
  std::string baseline;        ///< its values of the keys that vary: "solver.tolerance=3e-07,tilt.step=0.001"
  std::vector<StudyRun> runs;  ///< seed by seed, in each the variations in their order
};

/// The seeds of "1-4", "7" or "1-3,8", ascending and each once. Throws Error(usage).
std::vector<std::uint64_t> parse_seeds(const std::string& text);

/// The settings of each value of an axis. "tilt.step=0.002,0.0005" gives {tilt.step=0.002} and
/// {tilt.step=0.0005}. Keys joined by colons change together: "tilt.rate:tilt.step=2:0.002,0.5:0.0005" gives
/// {tilt.rate=2, tilt.step=0.002} and {tilt.rate=0.5, tilt.step=0.0005}. Throws Error(usage) where the text
/// has another form; keys and values are not looked at.
std::vector<std::vector<std::string>> parse_axis(const std::string& text);

/// Reads the scenario with each variation of each axis. `settings` hold for all runs; an axis takes its keys
/// out of them. A variation that is the baseline or an earlier variation again is left out.
/// Throws as read_scenario, parse_axis and parse_seeds do.
StudyPlan plan_study(const std::string& scenario_file, const std::vector<std::string>& settings,
                     const std::vector<std::string>& axes, const std::string& seeds);

}  // namespace talus
