#pragma once
/// Judges whether a value of ours agrees with the paper's, by one rule for all quantities.

#include <span>
#include <string>

#include "core/statistics.h"
#include "studies/measured_values.h"
#include "studies/paper_values.h"

namespace talus::studies {

/// Statistics of a value over several seeds.
struct Spread {
  int runs = 0;  ///< number of runs, with or without a value
  Statistics values;
  bool at_most = false;  ///< true if a run gives only an upper bound
};
/// Computes the statistics; NaN values are left out of the statistics but counted as runs.
Spread spread_of(std::span<const MeasuredValue> values);

/// Result of a comparison.
enum class Agreement {
  agrees,
  differs,
  absent,          ///< no run shows what the paper reports
  not_comparable,  ///< the two quantities differ in kind; see the reason
};

/// A comparison of our value with the paper's.
struct Judgement {
  Agreement agreement = Agreement::not_comparable;
  double difference = 0.0;  ///< our value minus the paper's
  double tolerance = 0.0;   ///< largest difference that still agrees
  std::string reason;       ///< explanation of not_comparable; else empty
};

/// Compares the mean over the seeds with the paper's value:
/// - No run: not comparable. No value in any run: absent.
/// - Equals: agrees if |mean - value| does not exceed the tolerance, which is the accuracy of the paper's
///   number plus one standard deviation over the seeds (the accuracy alone for one seed).
/// - Above: agrees if the mean exceeds the value; the tolerance is zero.
/// - An upper bound differs if it lies below the value by more than the tolerance; otherwise it is not
///   comparable.
/// - A length in D is not comparable if the bed is not as deep as the paper's, because lengths end at the
///   depth. `depth` is in D.
Judgement judge(const PaperValue& paper, const Spread& ours, double depth);

/// Returns "agrees"; "differs by +0.62 (tolerance 0.03)"; "does not occur"; "not comparable: ...".
std::string judgement_text(const Judgement& judgement);

}  // namespace talus::studies
