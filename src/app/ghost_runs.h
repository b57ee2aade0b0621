#pragma once
/// Comparison runs that the window draws behind its curves.

#include <string>
#include <vector>

#include "view/ghost.h"

namespace talus::app {

/// Treatment of a run without a valid stored analysis: analysed, or refused.
enum class MissingAnalysis { made, refused };

/// Reads runs, folders of ensembles and ensemble.h5, as `talus figures` accepts them, into one ghost. Throws
/// Error(bad_data) for a run whose analysis is missing and refused, and as read_figure_input does.
view::Ghost read_ghost(const std::vector<std::string>& paths, MissingAnalysis missing);

}  // namespace talus::app
