#pragma once
/// When an ensemble knows enough: the standard error that is asked of a mean.

#include <string>
#include <vector>

#include "ensemble/member_reader.h"
#include "ensemble/member_state.h"
#include "ensemble/plan.h"

namespace talus::ensemble {

/// "theta_c:0.2": the standard error of the mean of theta_c, in the unit of tables (deg).
struct Precision {
  std::string quantity;
  double error = 0.0;
};

/// Fewer values than this have no error that means anything.
inline constexpr int least_members = 5;

/// Throws Error(usage), naming --until, where the text has another form, or the quantity is no number of a
/// run.
Precision parse_precision(const std::string& text);

/// The numbers of the members that are done, in the order of the plan; of the others nothing. Throws as
/// read_member does, and Error(bad_data) where two seeds of a variant have the same state hash.
std::vector<MemberNumbers> numbers_of(const EnsemblePlan& plan, const std::vector<MemberState>& states,
                                      KnownMembers& known);

/// Whether the mean of each variant is known that well, each from `least_members` values or more. `numbers`
/// as numbers_of gives them.
bool is_reached(const Precision& precision, const EnsemblePlan& plan,
                const std::vector<MemberNumbers>& numbers);

}  // namespace talus::ensemble
