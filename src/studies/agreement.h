#pragma once
/// Whether a value of ours agrees with the paper's: one rule for all.

#include <span>
#include <string>

#include "core/statistics.h"
#include "studies/measured_values.h"
#include "studies/paper_values.h"

namespace talus::studies {

/// Values of several seeds.
struct Spread {
  int runs = 0;  ///< all that were asked
  Statistics values;
  bool at_most = false;  ///< no more than an upper bound is known in at least one of them
};
Spread spread_of(std::span<const Measured> values);

enum class Agreement {
  agrees,
  differs,
  absent,          ///< what the paper saw does not occur
  not_comparable,  ///< the two are not the same thing; the reason says why
};

struct Judgement {
  Agreement agreement = Agreement::not_comparable;
  double difference = 0.0;  ///< ours less the paper's
  double tolerance = 0.0;   ///< up to which it agrees
  std::string reason;       ///< of not_comparable
};

/// - No run: not comparable. No value in any run: absent.
/// - Equals: agrees where |mean - value| is not above the tolerance, which is the accuracy of the paper's
///   number and one standard deviation over the seeds (the accuracy alone for one seed).
/// - Above: agrees where the mean is above the value; the tolerance is zero.
/// - Where only an upper bound is known, it differs if the bound is below the value by more than the
///   tolerance, and is not comparable else.
/// - A length in D of a bed that is not as deep as the paper's is not comparable: it ends at the depth.
Judgement judge(const PaperValue& paper, const Spread& ours, double depth);

/// "agrees"; "differs by +0.62 (tolerance 0.03)"; "does not occur"; "not comparable: ...".
std::string judgement_text(const Judgement& judgement);

}  // namespace talus::studies
