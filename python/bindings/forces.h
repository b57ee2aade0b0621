#pragma once
/// Bindings of what the search for other admissible forces needs.

#include <pybind11/pybind11.h>

namespace talus {

/// Adds HeldFrame to the module. The public interface is python/talus/forces.py.
void bind_forces(pybind11::module_& module);

}  // namespace talus
