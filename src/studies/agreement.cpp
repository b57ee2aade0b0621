#include "studies/agreement.h"

#include <cmath>
#include <fmt/core.h>
#include <vector>

#include "scenario/text.h"

namespace talus::studies {
namespace {

constexpr double rounding = 1e-9;  // allowance for a difference equal to the tolerance

}  // namespace

Spread spread_of(std::span<const MeasuredValue> values) {
  Spread spread{static_cast<int>(values.size()), {}, false};
  std::vector<double> numbers;
  for (const auto& [value, at_most] : values) {
    numbers.push_back(value);
    spread.at_most = spread.at_most || (at_most && !std::isnan(value));
  }
  spread.values = statistics_of(numbers);
  return spread;
}

Judgement judge(const PaperValue& paper, const Spread& ours, double depth) {
  Judgement judgement;
  judgement.difference = ours.values.mean - paper.value;
  if (paper.relation == Relation::equals)
    judgement.tolerance = paper.accuracy + (ours.values.count > 1 ? ours.values.deviation : 0.0);
  if (ours.runs == 0) {
    judgement.reason = "no such run is complete";
  } else if (paper.unit == "D" && depth != paper_depth) {
    judgement.reason =
        fmt::format("H = {} D, not {} D", scenario::short_text(depth), scenario::short_text(paper_depth));
  } else if (ours.values.count == 0) {
    judgement.agreement = Agreement::absent;
  } else if (paper.relation == Relation::above) {
    judgement.agreement = judgement.difference > 0.0 ? Agreement::agrees : Agreement::differs;
  } else if (ours.at_most && judgement.difference >= -judgement.tolerance) {
    judgement.reason = "only a bound";
  } else {
    const bool near = std::abs(judgement.difference) <= judgement.tolerance + rounding;
    judgement.agreement = near ? Agreement::agrees : Agreement::differs;
  }
  return judgement;
}

std::string judgement_text(const Judgement& judgement) {
  switch (judgement.agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::absent:
      return "does not occur";
    case Agreement::not_comparable:
      return "not comparable: " + judgement.reason;
    case Agreement::differs:
      break;
  }
  std::string text = fmt::format("differs by {:+.2g}", judgement.difference);
  if (judgement.tolerance > 0.0) text += fmt::format(" (tolerance {:.2g})", judgement.tolerance);
  return text;
}

}  // namespace talus::studies
