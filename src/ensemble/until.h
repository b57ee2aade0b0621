#pragma once
/// The stopping criterion of an ensemble: the required standard error of a mean.

#include <string>
#include <vector>

#include "ensemble/member_reader.h"
#include "ensemble/member_state.h"
#include "ensemble/plan.h"

namespace talus::ensemble {

/// For example "theta_c:0.2": the required standard error of the mean of theta_c, in the unit of tables
/// (deg).
struct Precision {
  std::string quantity;
  double error = 0.0;
};

/// The standard error is unreliable with fewer values.
inline constexpr int min_members = 5;

/// Parses a criterion. Throws Error(usage), naming --until, if the text has another form or the quantity is
/// not a scalar result.
Precision parse_precision(const std::string& text);

/// Returns the results of the completed members, in the order of the plan, and empty results for the others.
/// Throws the errors of read_member, and Error(bad_data) if two seeds of a variant have the same state hash.
std::vector<MemberNumbers> numbers_of(const EnsemblePlan& plan, const std::vector<MemberState>& states,
                                      KnownMembers& known);

/// Whether the mean of each variant has that precision, with at least `min_members` values. `numbers` comes
/// from numbers_of.
bool is_reached(const Precision& precision, const EnsemblePlan& plan,
                const std::vector<MemberNumbers>& numbers);

}  // namespace talus::ensemble
