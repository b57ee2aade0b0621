#pragma once
/// The contact network of a frame as GraphML, for networkx and the like.

#include <string>

#include "analysis/frame_quantities.h"

namespace talus {

/// An undirected graph: grains, and planes that something touches, are nodes with their ids; contacts are
/// edges, from a to b. Two grains of a short periodic bed may touch twice.
std::string graphml_text(const GrainSource& frame);

}  // namespace talus
