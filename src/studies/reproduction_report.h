#pragma once
/// Report of `talus reproduce`, which compares our values with the paper's.

#include <string>
#include <vector>

#include "studies/report_document.h"
#include "studies/reproduction.h"

namespace talus::studies {

/// Figures of a report, by the section in which each appears.
struct ReproductionPictures {
  std::vector<ReportPicture> agreement, packing, overload, walls, further;
};

/// Composes the whole report: the result with its chart, the sections, and finally how it was made.
ReportDocument reproduction_report(const ReproductionResult& result, const ReproductionPictures& pictures);

/// Summarises how many values agree in each preparation, the wall law, and the nearest reading; one sentence
/// an item.
std::vector<std::string> reproduction_summary(const ReproductionResult& result);

/// Composes the section on the threshold: its tables and conclusions.
std::vector<ReportBlock> threshold_blocks(const ReproductionResult& result);

/// States the nearest reading, and whether it reconciles the paper's chain with ours.
std::vector<std::string> threshold_verdict(const ReproductionPlan& plan,
                                           std::span<const ReadingResult> results);

/// States every conclusion from the scores of all readings and preparations.
std::vector<std::string> threshold_conclusion(const ReproductionPlan& plan,
                                              std::span<const ReadingResult> results);

/// Joins words as "a, b and c".
std::string listed(const std::vector<std::string>& words);

/// Returns the name with its unit, such as "theta_c [deg]".
std::string name_text(const PaperValue& paper);

/// Describes the preparation, as in "poured grains".
std::string preparation_text(const ensemble::Variant& bed);

/// Formats "0.815 ± 0.012"; "<= 0.00" for an upper bound; "-" without a value; "(1 of 2)" is appended if some
/// runs have none.
std::string spread_text(const Spread& spread);

/// Formats a value of ours with the verdict below it.
TextCell judged_cell(const PaperValue& paper, const Spread& ours, double depth);

}  // namespace talus::studies
