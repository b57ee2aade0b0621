#pragma once
/// Tilt programmes (tilt.program): the history of the tilt as phrases, and the tilt after each step.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace talus::scenario {

/// A phrase of a programme, such as "to 12 at 0.5".
struct ProgramPhrase {
  enum class Verb {
    to,         ///< tilts to `value`, deg
    to_repose,  ///< tilts further until the slope fails
    by,         ///< tilts by `value`, deg
    hold,       ///< holds the tilt for `value`, s
    times,      ///< repeats all phrases since the last such phrase, or the beginning, `value` times in total
  };
  Verb verb = Verb::to;
  double value = 0.0;
  std::optional<double> rate;  ///< deg/s; default: tilt.rate

  bool operator==(const ProgramPhrase&) const = default;
};

/// Parses a phrase with its numbers in range; empty if the text is not a phrase.
std::optional<ProgramPhrase> program_phrase(std::string_view text);

/// Returns the end of a message about a text that is no phrase, such as "; did you mean 'to repose'?".
std::string meant_phrase(const std::string& text);

/// Describes the accepted phrases, for messages and documentation.
std::string program_phrase_forms();

/// A part of the programme in which the tilt changes by the same angle in each step, or is held.
struct TiltSegment {
  double from = 0.0, to = 0.0;  ///< deg
  double step = 0.0;            ///< signed change of the tilt in one time step, deg; 0: held
  std::int64_t begin = 0;       ///< number of steps of the tilt before it
  std::int64_t steps = 0;       ///< number of its steps, above 0

  std::int64_t end() const { return begin + steps; }
};

/// The history of the tilt. Empty if the scenario has no programme.
class TiltProgram {
 public:
  TiltProgram() = default;
  /// Creates the programme of a scenario that breaks no rule.
  explicit TiltProgram(const Scenario& scenario);

  bool empty() const { return segments_.empty(); }
  const std::vector<TiltSegment>& segments() const { return segments_; }
  /// Returns the total number of steps of the tilt.
  std::int64_t steps() const { return empty() ? 0 : segments_.back().end(); }
  /// Whether the programme ends with "to repose": the tilt grows until the slope fails.
  bool ends_at_repose() const { return to_repose_; }

  /// Returns the segment that contains step number `step` of the tilt, counted from 1; the last segment
  /// beyond its end.
  const TiltSegment& segment_of(std::int64_t step) const;
  /// Returns the tilt after this number of steps, rad. It depends on the number alone: at the end of a
  /// segment it is the final angle of the segment, and before that the initial angle plus a multiple of the
  /// angle of a step.
  double tilt(std::int64_t steps) const;
  /// Whether a segment ends with this step.
  bool turns_at(std::int64_t step) const { return segment_of(step).end() == step; }

 private:
  std::vector<TiltSegment> segments_;
  bool to_repose_ = false;
};

/// Describes the error in the programme of a scenario whose phrases are individually valid: what was expected
/// and what was found. Empty without an error and without a programme.
std::string program_fault(const Scenario& scenario);

}  // namespace talus::scenario
