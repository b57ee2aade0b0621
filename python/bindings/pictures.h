#pragma once
/// Bindings of pictures: options of maps, values of a script, panels and movies.

#include <pybind11/numpy.h>

#include "render/image.h"

namespace talus {

/// Returns an array (height, width, 4), sRGB and alpha.
pybind11::array pixels(const render::Image& image);

/// Adds MapOptions, OwnQuantity, Map and functions of several maps to the module. The public interface is
/// python/talus/drawing.py.
void bind_pictures(pybind11::module_& module);

}  // namespace talus
