#pragma once
/// tilt.program: a course of the tilt written as phrases, and the tilt after each of its steps.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace talus::scenario {

/// One phrase of a programme, such as "to 12 at 0.5".
struct ProgramPhrase {
  enum class Verb {
    to,         ///< tilts to `value`, deg
    to_repose,  ///< tilts on until the slope fails
    by,         ///< tilts by `value`, deg
    hold,       ///< keeps the tilt for `value`, s
    times,      ///< does all since the last such phrase, or the beginning, `value` times in all
  };
  Verb verb = Verb::to;
  double value = 0.0;
  std::optional<double> rate;  ///< deg/s; without: tilt.rate

  bool operator==(const ProgramPhrase&) const = default;
};

/// The phrase that a text is, with its numbers in range; nothing where it is none.
std::optional<ProgramPhrase> program_phrase(std::string_view text);

/// What a phrase may be, for messages and documents.
std::string program_phrase_forms();

/// The end of a message about a text that is no phrase: "; did you mean 'to 12'?", or nothing.
std::string meant_program_phrase(const std::string& text);

/// A part of the course in which the tilt changes by the same angle in each step, or is held.
struct TiltSegment {
  double from = 0.0, to = 0.0;  ///< deg
  double step = 0.0;            ///< deg, of one time step, with its sign; 0: held
  std::int64_t begin = 0;       ///< steps of the tilt before it
  std::int64_t steps = 0;       ///< above 0

  std::int64_t end() const { return begin + steps; }
};

/// The course of the tilt. Empty where the scenario has no programme.
class TiltProgram {
 public:
  TiltProgram() = default;
  /// Of a scenario that breaks no rule.
  explicit TiltProgram(const Scenario& scenario);

  bool empty() const { return segments_.empty(); }
  const std::vector<TiltSegment>& segments() const { return segments_; }
  std::int64_t steps() const { return empty() ? 0 : segments_.back().end(); }
  bool ends_at_repose() const { return to_repose_; }

  /// The segment of step number `step` of the tilt, from 1 on; the last one beyond its end.
  const TiltSegment& segment_of(std::int64_t step) const;
  /// The tilt after so many steps, rad. It follows from the number alone: at the end of a segment it is the
  /// angle that the segment goes to, before that so many times the angle of a step from where the segment
  /// began.
  double tilt(std::int64_t steps) const;
  /// Whether a segment ends with this step.
  bool turns_at(std::int64_t step) const { return segment_of(step).end() == step; }

 private:
  std::vector<TiltSegment> segments_;
  bool to_repose_ = false;
};

/// What is wrong with the programme of a scenario as a whole, whose phrases are each in order: what was
/// expected and what was found. Empty where nothing is, and without a programme.
std::string program_fault(const Scenario& scenario);

}  // namespace talus::scenario
