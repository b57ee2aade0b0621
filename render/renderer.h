#pragma once
/// Draws views and sheets into images.

#include <memory>

#include "render/context.h"
#include "render/font.h"
#include "render/image.h"
#include "render/sheet.h"
#include "render/target.h"

namespace talus::render {

/// Draws pictures on a target, which it owns. Use it on the thread that made the context.
class Renderer {
 public:
  explicit Renderer(std::unique_ptr<Context> context);
  explicit Renderer(std::unique_ptr<ImageTarget> target);

  /// Returns the picture of a view, `width` px wide, laid out by lay_out. The same view gives the same bits.
  /// Throws the errors of lay_out and of the target.
  Image draw(const FrameView& view, int width, const LayoutLimits& limits = {});
  Image draw(const Sheet& sheet);

  /// Draws without reading the picture back. The picture remains in the target, with the size of the returned
  /// layout.
  Layout paint(const FrameView& view, int width, const LayoutLimits& limits = {});

  const Font& font() const { return font_; }

 private:
  std::unique_ptr<ImageTarget> target_;
  Font font_;
};

}  // namespace talus::render
