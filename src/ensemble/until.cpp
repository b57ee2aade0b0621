#include "ensemble/until.h"

#include <algorithm>
#include <charconv>
#include <fmt/core.h>
#include <map>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "core/statistics.h"

namespace talus::ensemble {

Precision parse_precision(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  Precision precision;
  if (colon != std::string::npos && colon > 0) {
    precision.quantity = text.substr(0, colon);
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + colon + 1, last, precision.error);
    const bool has_error = error == std::errc() && end == last && precision.error > 0.0;
    if (has_error && is_number_of_run(precision.quantity)) return precision;
    if (has_error)
      throw Error(ExitCode::usage, fmt::format("--until {}: {} is not a result of a run; expected one of {}",
                                               visible_word(text), visible_word(precision.quantity),
                                               joined(numbers_of_run(), ", ")));
  }
  throw Error(ExitCode::usage,
              fmt::format("--until {}: expected a quantity and the standard error of its mean, such as "
                          "theta_c:0.2 (deg)",
                          visible_word(text)));
}

std::vector<MemberNumbers> numbers_of(const EnsemblePlan& plan, const std::vector<MemberState>& states,
                                      KnownMembers& known) {
  std::vector<MemberNumbers> numbers(plan.members.size());
  std::map<std::pair<std::size_t, std::string>, const Member*> ends;
  for (std::size_t m = 0; m < plan.members.size(); ++m) {
    if (states[m].stage != MemberStage::done) continue;
    const Member& member = plan.members[m];
    numbers[m] = read_member(member, known).numbers;
    // A bed from a file has no random element and may be the same for all seeds.
    if (member.scenario.deposition.method == scenario::DepositionMethod::file) continue;
    const auto [first, is_new] = ends.emplace(std::pair(member.variant, numbers[m].state_hash), &member);
    if (!is_new)
      throw Error(
          ExitCode::bad_data,
          fmt::format("{} and {} have the same state_hash, which two seeds never have: one is a copy; "
                      "remove it, and talus ensemble computes that member again",
                      first->second->path, member.path));
  }
  return numbers;
}

bool is_reached(const Precision& precision, const EnsemblePlan& plan,
                const std::vector<MemberNumbers>& numbers) {
  std::vector<std::vector<double>> values(plan.variants.size());
  for (std::size_t m = 0; m < plan.members.size(); ++m) {
    if (numbers[m].numbers.empty()) continue;
    values[plan.members[m].variant].push_back(number_called(numbers[m], precision.quantity));
  }
  return std::ranges::all_of(values, [&](const std::vector<double>& variant_values) {
    const Statistics found = statistics_of(variant_values);
    return found.count >= min_members && found.error <= precision.error;
  });
}

}  // namespace talus::ensemble
