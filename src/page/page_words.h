#pragma once
/// What a page says in words: its title, what it is in a sentence, and where the run comes from.

#include <string>

#include "page/page_run.h"

namespace talus {

/// "A granular slope, tilted until it fails".
std::string page_title(const PageRun& run);
/// What was simulated, and what is on the page: rich text.
std::string page_sentence(const PageRun& run);
/// Names and values: seed, version, hash of the state; nothing of the machine.
Facts page_provenance(const PageRun& run);

}  // namespace talus
