#pragma once
/// Drawing with OpenGL, alike in any context.

#include <memory>

#include "render/context.h"
#include "render/target.h"

namespace talus {

/// Owns its context and what it made there. Throws Error(unavailable) where a shader does not compile.
std::unique_ptr<Target> make_gl_target(std::unique_ptr<Context> context);

}  // namespace talus
