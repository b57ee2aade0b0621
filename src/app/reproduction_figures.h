#pragma once
/// The figures of `talus reproduce`.

#include <vector>

#include "app/report_document.h"
#include "app/reproduction_values.h"

namespace talus {

/// Draws all figures of the catalogue that can be made of the complete, analysed runs into FOLDER/figures and
/// returns them as pictures of a report in FOLDER. A figure whose provenance and script are those that would
/// be written is kept. Throws Error(stopped), and as write_figure does.
std::vector<ReportPicture> draw_figures(const ReproductionPlan& plan, const WorkOptions& options);

}  // namespace talus
