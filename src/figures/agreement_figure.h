#pragma once
/// The chart of `talus reproduce`: how far each value of ours is from the paper's.

#include <optional>

#include "figures/figure.h"
#include "studies/reproduction.h"

namespace talus::figures {

/// The figure "agreement". Left: the values of the packing, one symbol for each preparation of the periodic
/// bed, and those of beds between walls; right: the chain of the paper's own preparation, one symbol for each
/// of the three readings of "overloaded". Abscissa: ours less the paper's, over the tolerance of the
/// comparison (judge), so that values within -1 ... 1 agree. Values of which the paper gives no number, and
/// those that cannot be compared, are left out; what does not occur in any run stands beside the axis. No
/// figure where nothing is left.
std::optional<Figure> agreement_figure(const studies::ReproductionResult& result);

}  // namespace talus::figures
