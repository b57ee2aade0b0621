#include "ensemble/member_task.h"

#include <charconv>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text_stream.h"
#include "base/visible_text.h"
#include "scenario/text.h"

namespace talus::ensemble {
namespace {

constexpr const char* readings_word = "readings";
constexpr const char* trials_word = "trials ";

struct TaskText {
  std::string operator()(const PlainTask&) const { return ""; }
  std::string operator()(const ReadingsTask&) const { return readings_word; }
  std::string operator()(const TrialsTask& trials) const { return trials_word + plan_text(trials); }
};

bool read_number(std::string_view text, auto& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// Parses a plan_text; no value for any other text.
std::optional<TrialsTask> parse_plan(const std::string& text) {
  std::istringstream words = text_stream(text);
  std::string option, first, every, patch;
  words >> option >> first >> option >> every >> option >> patch;
  TrialsTask trials;
  const std::optional<SurfacePatch> found = parse_patch(patch);
  if (!found || !read_number(first, trials.first) || !read_number(every, trials.every)) return std::nullopt;
  trials.patch = *found;
  const bool in_range = trials.first >= 0.0 && trials.first <= TrialsTask::highest &&
                        trials.every >= TrialsTask::min_every && trials.every <= TrialsTask::highest;
  return in_range && plan_text(trials) == text ? std::optional(trials) : std::nullopt;
}

}  // namespace

std::string patch_text(const SurfacePatch& patch) {
  return fmt::format("{}x{}", scenario::short_text(patch.width), scenario::short_text(patch.depth));
}

std::optional<SurfacePatch> parse_patch(const std::string& text) {
  const std::size_t cross = text.find('x');
  SurfacePatch patch;
  if (cross == std::string::npos || !read_number(std::string_view(text).substr(0, cross), patch.width) ||
      !read_number(std::string_view(text).substr(cross + 1), patch.depth))
    return std::nullopt;
  const bool usable = patch.width > 0.0 && patch.width < 1e6 && patch.depth > 0.0 && patch.depth < 1e6;
  return usable ? std::optional(patch) : std::nullopt;
}

std::string plan_text(const TrialsTask& trials) {
  return fmt::format("--from {} --every {} --patch {}", scenario::short_text(trials.first),
                     scenario::short_text(trials.every), patch_text(trials.patch));
}

std::string task_text(const MemberTask& task) { return std::visit(TaskText{}, task); }

MemberTask parse_task(const std::string& text, const std::string& path) {
  if (text.empty()) return PlainTask{};
  if (text == readings_word) return ReadingsTask{};
  if (text.starts_with(trials_word))
    if (const auto trials = parse_plan(text.substr(std::char_traits<char>::length(trials_word))))
      return *trials;
  throw Error(ExitCode::bad_data,
              fmt::format("{}: this version of Talus does not know the task '{}' of members", path,
                          visible_word(text)));
}

}  // namespace talus::ensemble
