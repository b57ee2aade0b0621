#include "ensemble/member_task.h"

#include <fmt/core.h>

#include "base/errors.h"
#include "base/visible_text.h"

namespace talus::ensemble {
namespace {

constexpr const char* readings_word = "readings";
constexpr const char* trials_word = "trials ";

struct TaskText {
  std::string operator()(const PlainTask&) const { return ""; }
  std::string operator()(const ReadingsTask&) const { return readings_word; }
  std::string operator()(const session::PerturbationPlan& plan) const {
    return trials_word + session::plan_text(plan);
  }
};

}  // namespace

std::string task_text(const MemberTask& task) { return std::visit(TaskText{}, task); }

MemberTask parse_task(const std::string& text, const std::string& path) {
  if (text.empty()) return PlainTask{};
  if (text == readings_word) return ReadingsTask{};
  if (text.starts_with(trials_word))
    if (const auto plan = session::parse_plan(text.substr(std::char_traits<char>::length(trials_word))))
      return *plan;
  throw Error(ExitCode::bad_data,
              fmt::format("{}: this version of Talus does not know the task '{}' of members", path,
                          visible_word(text)));
}

}  // namespace talus::ensemble
