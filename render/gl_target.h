#pragma once
/// Drawing with OpenGL, the same in any context.

#include <memory>

#include "render/context.h"
#include "render/target.h"

namespace talus::render {

/// A target whose picture is a texture of the context, which can be drawn there.
class TextureTarget : public ImageTarget {
 public:
  /// The texture with the picture drawn last, row 0 at the top; it changes with its size and format. Gray
  /// pictures have their one channel in red.
  virtual unsigned texture() const = 0;
};

/// Owns its context and what it made there. Throws Error(unavailable) if a shader does not compile.
std::unique_ptr<TextureTarget> make_gl_target(std::unique_ptr<Context> context);

}  // namespace talus::render
