#include "reproduction/agreement.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "session/scenario_text.h"

namespace talus {
namespace {

constexpr double rounding = 1e-9;  // of a difference that is as large as the tolerance

std::string digits(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

Spread spread_of(std::span<const Measured> values) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Spread spread{static_cast<int>(values.size()), 0, none, none, false};
  double sum = 0.0;
  for (const Measured& measured : values) {
    if (std::isnan(measured.value)) continue;
    sum += measured.value;
    ++spread.count;
    spread.at_most = spread.at_most || measured.at_most;
  }
  if (spread.count == 0) return spread;
  spread.mean = sum / spread.count;
  if (spread.count == 1) return spread;
  double squares = 0.0;
  for (const Measured& measured : values)
    if (!std::isnan(measured.value)) squares += std::pow(measured.value - spread.mean, 2);
  spread.deviation = std::sqrt(squares / (spread.count - 1));
  return spread;
}

Judgement judge(const PaperValue& paper, const Spread& ours, double depth) {
  Judgement judgement;
  judgement.difference = ours.mean - paper.value;
  if (paper.relation == Relation::equals)
    judgement.tolerance = paper.accuracy + (ours.count > 1 ? ours.deviation : 0.0);
  if (ours.runs == 0) {
    judgement.reason = "no such run is complete";
  } else if (paper.unit == "D" && depth != paper_depth) {
    judgement.reason = std::string("H = ")
                           .append(short_text(depth))
                           .append(" D, not ")
                           .append(short_text(paper_depth))
                           .append(" D");
  } else if (ours.count == 0) {
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
  std::string text = "differs by " + digits("%+.2g", judgement.difference);
  if (judgement.tolerance > 0.0) text += " (tolerance " + digits("%.2g", judgement.tolerance) + ")";
  return text;
}

}  // namespace talus
