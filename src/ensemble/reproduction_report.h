#pragma once
/// The report of `talus reproduce`: the paper's values beside ours.

#include <string>
#include <vector>

#include "ensemble/report_document.h"
#include "ensemble/reproduction.h"

namespace talus {

/// The whole report; `pictures` are the figures, in their order.
ReportDocument reproduction_report(const ReproductionResult& result,
                                   const std::vector<ReportPicture>& pictures);

/// What is said first: how many values agree in each preparation, and what the study of the threshold ends
/// with. One sentence an item.
std::vector<std::string> reproduction_summary(const ReproductionResult& result);

/// The part on the threshold: tables, and what follows from them.
std::vector<ReportBlock> threshold_blocks(const ReproductionResult& result);

/// The sentences that follow from the scores of all readings and preparations.
std::vector<std::string> threshold_conclusion(const ReproductionPlan& plan,
                                              std::span<const ReadingResult> results);

/// "a, b and c".
std::string listed(const std::vector<std::string>& words);

/// "theta_c [deg]".
std::string name_text(const PaperValue& paper);

/// "poured grains".
std::string preparation_text(const Variant& bed);

/// "0.815 ± 0.012"; "<= 0.00" where no more is known; "-" where there is none; " (1 of 2)" where runs have
/// none.
std::string spread_text(const Spread& spread);

/// A value of ours with its verdict below it.
ReportCell judged_cell(const PaperValue& paper, const Spread& ours, double depth);

}  // namespace talus
