#pragma once
/// Runs that the window draws behind its curves.

#include <string>
#include <vector>

#include "view/ghost.h"

namespace talus::app {

/// Whether a run without an analysis that is stored and valid is analysed, or refused.
enum class MissingAnalysis { made, refused };

/// Runs, folders of ensembles and ensemble.h5, as `talus figures` takes them, as one ghost. Throws
/// Error(bad_data) for a run whose analysis is missing and refused, and as read_figure_input does.
view::Ghost read_ghost(const std::vector<std::string>& paths, MissingAnalysis missing);

}  // namespace talus::app
