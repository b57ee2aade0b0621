#pragma once
/// Drawing with OpenGL, identical in all contexts.

#include <memory>

#include "render/context.h"
#include "render/target.h"

namespace talus::render {

/// A target whose picture is a texture of the context, available for drawing there.
class TextureTarget : public ImageTarget {
 public:
  /// Returns the texture with the last picture, row 0 at the top. It changes when size or format change. Gray
  /// pictures store their only channel in red.
  virtual unsigned texture() const = 0;
};

/// Makes a target that owns the context and its objects. Throws Error(unavailable) if a shader does not
/// compile.
std::unique_ptr<TextureTarget> make_gl_target(std::unique_ptr<Context> context);

}  // namespace talus::render
