#include "ensemble/member_task.h"

#include <fmt/core.h>

#include "core/errors.h"
#include "core/visible_text.h"

namespace talus {
namespace {

constexpr const char* readings = "readings";

}  // namespace

std::string task_text(const MemberTask& task) {
  return std::holds_alternative<ReadingsTask>(task) ? readings : "";
}

MemberTask parse_task(const std::string& text, const std::string& path) {
  if (text.empty()) return PlainTask{};
  if (text == readings) return ReadingsTask{};
  throw Error(ExitCode::bad_data,
              fmt::format("{}: members with the task '{}' are not known to this version of Talus", path,
                          visible_word(text)));
}

}  // namespace talus
