#pragma once
/// Bindings of what the figures of runs need: analyses, and measures that belong to figures alone.

#include <pybind11/pybind11.h>

namespace talus {

/// Adds AnalysedRun and functions of figures to the module. The public interface is python/talus/figures.
void bind_figures(pybind11::module_& module);

}  // namespace talus
