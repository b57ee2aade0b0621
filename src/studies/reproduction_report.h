#pragma once
/// The report of `talus reproduce`: the paper's values beside ours.

#include <string>
#include <vector>

#include "studies/report_document.h"
#include "studies/reproduction.h"

namespace talus::studies {

/// The figures of a report by the part that each stands in.
struct ReproductionPictures {
  std::vector<ReportPicture> agreement, packing, overload, walls, further;
};

/// The whole report: the result first, with its chart, then the parts, and last how it was made.
ReportDocument reproduction_report(const ReproductionResult& result, const ReproductionPictures& pictures);

/// What is said first: how many values agree in each preparation, the law of walls, and the reading that
/// comes nearest. One sentence an item.
std::vector<std::string> reproduction_summary(const ReproductionResult& result);

/// The part on the threshold: tables, and what follows from them.
std::vector<ReportBlock> threshold_blocks(const ReproductionResult& result);

/// The reading that comes nearest, and whether it brings the paper's chain and ours together.
std::vector<std::string> threshold_verdict(const ReproductionPlan& plan,
                                           std::span<const ReadingResult> results);

/// All sentences that follow from the scores of all readings and preparations.
std::vector<std::string> threshold_conclusion(const ReproductionPlan& plan,
                                              std::span<const ReadingResult> results);

/// "a, b and c".
std::string listed(const std::vector<std::string>& words);

/// "theta_c [deg]".
std::string name_text(const PaperValue& paper);

/// "poured grains".
std::string preparation_text(const ensemble::Variant& bed);

/// "0.815 ± 0.012"; "<= 0.00" where no more is known; "-" where there is none; " (1 of 2)" where runs have
/// none.
std::string spread_text(const Spread& spread);

/// A value of ours with its verdict below it.
TextCell judged_cell(const PaperValue& paper, const Spread& ours, double depth);

}  // namespace talus::studies
