#include "scenario/tilt_program.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "core/trigonometry.h"
#include "scenario/text.h"

namespace talus::scenario {
namespace {

constexpr double steepest = 60.0;                  // deg
constexpr double longest_hold = 3600.0;            // s
constexpr double slowest = 1e-4, fastest = 100.0;  // deg/s
constexpr double max_times = 10'000.0;
constexpr std::size_t max_segments = 100'000;
constexpr double max_steps = 1e12;
constexpr double steepest_rounding = 1e-9;  // tolerance for sums of angles, deg

/// The remaining words of a phrase.
struct Words {
  std::vector<std::string_view> words;
  std::size_t next = 0;

  explicit Words(std::string_view text) {
    while (true) {
      const auto first = text.find_first_not_of(" \t");
      if (first == std::string_view::npos) return;
      text.remove_prefix(first);
      const auto end = std::min(text.find_first_of(" \t"), text.size());
      words.push_back(text.substr(0, end));
      text.remove_prefix(end);
    }
  }

  bool at_end() const { return next == words.size(); }

  bool take(std::string_view word) {
    if (at_end() || words[next] != word) return false;
    ++next;
    return true;
  }

  /// Reads the next word as a number in [low, high].
  std::optional<double> number(double low, double high) {
    if (at_end()) return std::nullopt;
    const std::string_view word = words[next];
    const auto value = parse_number<double>(word.substr(word.starts_with('+') ? 1 : 0));
    if (!value || !(*value >= low && *value <= high)) return std::nullopt;
    ++next;
    return *value + 0.0;  // avoids -0
  }

  /// Reads a number, optionally followed by its unit.
  std::optional<double> number(double low, double high, std::string_view unit) {
    const std::optional<double> value = number(low, high);
    if (value) take(unit);
    return value;
  }
};

using Verb = ProgramPhrase::Verb;

std::optional<ProgramPhrase> verb_of(Words& words) {
  const auto with = [](Verb verb, std::optional<double> value) {
    return value ? std::optional(ProgramPhrase{verb, *value, {}}) : std::nullopt;
  };
  if (words.take("once")) return with(Verb::times, 1.0);
  if (words.take("hold")) {
    const std::optional<double> seconds = words.number(0.0, longest_hold, "s");
    return seconds == 0.0 ? std::nullopt : with(Verb::hold, seconds);
  }
  if (words.take("to")) {
    if (words.take("repose")) return with(Verb::to_repose, 0.0);
    return with(Verb::to, words.number(-steepest, steepest, "deg"));
  }
  if (words.take("by")) {
    const std::optional<double> angle = words.number(-steepest, steepest, "deg");
    return angle == 0.0 ? std::nullopt : with(Verb::by, angle);
  }
  const std::optional<double> times = words.number(1.0, max_times);
  if (!times || *times != std::floor(*times) || !(words.take("times") || words.take("time")))
    return std::nullopt;
  return with(Verb::times, times);
}

/// A programme while its phrases are executed.
struct Course {
  const Scenario& scenario;
  std::vector<TiltSegment> segments;
  bool to_repose = false;
  std::string fault;

  double tilt() const { return segments.empty() ? 0.0 : segments.back().to; }
  std::int64_t end() const { return segments.empty() ? 0 : segments.back().end(); }

  /// Adds a segment unless it has no steps.
  void add(double to, double step, double steps) {
    if (!(steps + static_cast<double>(end()) <= max_steps)) return complain("takes more than 1e12 steps");
    if (std::abs(to) > steepest + steepest_rounding)
      return complain(fmt::format("tilts to {} deg, beyond {} deg", short_text(to), short_text(steepest)));
    if (segments.size() == max_segments)
      return complain(fmt::format("has more than {} parts, repetitions included", max_segments));
    if (steps >= 1.0) segments.push_back({tilt(), to, step, end(), static_cast<std::int64_t>(steps)});
  }

  void go_to(double angle, const std::optional<double>& rate) {
    // Exact, so that "at tilt.rate" changes no bit.
    const double size = rate ? *rate * time_step(scenario) : scenario.tilt.step;
    const double way = angle - tilt();
    add(angle, way < 0.0 ? -size : size, way == 0.0 ? 0.0 : std::max(1.0, std::round(std::abs(way) / size)));
  }

  void carry_out(const ProgramPhrase& phrase) {
    switch (phrase.verb) {
      case Verb::to:
        return go_to(phrase.value, phrase.rate);
      case Verb::to_repose:
        return go_to(steepest, phrase.rate);
      case Verb::by:
        return go_to(tilt() + phrase.value, phrase.rate);
      case Verb::hold:
        return add(tilt(), 0.0, std::max(1.0, std::round(phrase.value / time_step(scenario))));
      case Verb::times:
        return;
    }
  }

  void complain(std::string what) {
    if (fault.empty()) fault = std::move(what);
  }
};

/// Executes the phrases from `first` to `end`, `times` times.
void repeat(Course& course, const std::vector<ProgramPhrase>& phrases, std::size_t first, std::size_t end,
            double times) {
  for (double done = 0.0; done < times && course.fault.empty(); ++done)
    for (std::size_t k = first; k < end && course.fault.empty(); ++k) course.carry_out(phrases[k]);
}

Course course_of(const Scenario& scenario) {
  Course course{scenario, {}, false, {}};
  std::vector<ProgramPhrase> phrases;
  for (const std::string& text : scenario.tilt.program)
    if (const std::optional<ProgramPhrase> phrase = program_phrase(text)) phrases.push_back(*phrase);
  std::size_t block = 0;
  for (std::size_t k = 0; k < phrases.size(); ++k) {
    if (phrases[k].verb == Verb::to_repose && k + 1 < phrases.size())
      course.complain("continues after \"to repose\", which must be the last phrase");
    if (phrases[k].verb != Verb::times) continue;
    if (k == block)
      course.complain(fmt::format("has nothing to repeat before \"{}\"", scenario.tilt.program[k]));
    repeat(course, phrases, block, k, phrases[k].value);
    block = k + 1;
  }
  repeat(course, phrases, block, phrases.size(), 1.0);
  course.to_repose = !phrases.empty() && phrases.back().verb == Verb::to_repose;
  if (course.segments.empty()) course.complain("neither tilts nor holds the bed for a step");
  return course;
}

}  // namespace

std::optional<ProgramPhrase> program_phrase(std::string_view text) {
  Words words(text);
  std::optional<ProgramPhrase> phrase = verb_of(words);
  if (!phrase) return std::nullopt;
  const bool moves = phrase->verb != Verb::hold && phrase->verb != Verb::times;
  if (moves && words.take("at")) {
    phrase->rate = words.number(slowest, fastest, "deg/s");
    if (!phrase->rate) return std::nullopt;
  }
  return words.at_end() ? phrase : std::nullopt;
}

std::string meant_phrase(const std::string& text) {
  const bool to_no_angle = text.starts_with("to ") && text.find_first_of("0123456789") == std::string::npos;
  return did_you_mean(to_no_angle ? "to repose" : text, {"to repose", "once"});
}

std::string program_phrase_forms() {
  return fmt::format(
      "\"to A\" or \"by A\" (an angle in [-{0}, {0}] deg) or \"to repose\", each also with \"at R\" (a rate "
      "in [{1}, {2}] deg/s), \"hold T\" (a time in (0, {3}] s), \"N times\" (1 ... {4}), or \"once\"",
      short_text(steepest), short_text(slowest), short_text(fastest), short_text(longest_hold),
      short_text(max_times));
}

TiltProgram::TiltProgram(const Scenario& scenario) {
  if (scenario.tilt.program.empty()) return;
  Course course = course_of(scenario);
  segments_ = std::move(course.segments);
  to_repose_ = course.to_repose;
}

const TiltSegment& TiltProgram::segment_of(std::int64_t step) const {
  const auto found = std::ranges::partition_point(
      segments_, [step](const TiltSegment& segment) { return segment.end() < step; });
  return found == segments_.end() ? segments_.back() : *found;
}

double TiltProgram::tilt(std::int64_t steps) const {
  const TiltSegment& segment = segment_of(steps);
  if (steps >= segment.end()) return radians(segment.to);
  return radians(segment.from) + static_cast<double>(steps - segment.begin) * radians(segment.step);
}

std::string program_fault(const Scenario& scenario) {
  if (scenario.tilt.program.empty()) return {};
  if (scenario.tilt.end_angle)
    return fmt::format("no tilt.end_angle, because the programme determines the end of the run; it is {} deg",
                       short_text(*scenario.tilt.end_angle));
  const std::string fault = course_of(scenario).fault;
  return fault.empty() ? "" : "a programme that can be carried out; this one " + fault;
}

}  // namespace talus::scenario
