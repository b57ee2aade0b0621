#pragma once
/// Chart of `talus reproduce`: the deviation of each value from that of the paper.

#include <optional>

#include "figures/figure.h"
#include "studies/reproduction.h"

namespace talus::figures {

/// Makes the figure "agreement". Left: the values of the packing, with one symbol for each preparation of the
/// periodic bed, and those of beds between walls. Right: the chain of overloaded grains for the paper's own
/// preparation, with one symbol for each of the three readings of "overloaded". Abscissa: our value minus the
/// paper's, over the tolerance of the comparison (judge), so that values within -1 ... 1 agree. Values for
/// which the paper gives no number and values that cannot be compared are left out. A cross next to the axis
/// marks a value that occurs in no run. Returns no figure if nothing can be compared.
std::optional<Figure> agreement_figure(const studies::ReproductionResult& result);

}  // namespace talus::figures
