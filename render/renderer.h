#pragma once
/// Draws views into images, in any context.

#include <memory>

#include "render/context.h"
#include "render/font.h"
#include "render/frame_view.h"
#include "render/gl_objects.h"
#include "render/image.h"
#include "render/layout.h"

namespace talus {

/// Owns its context and what it made there. Use it on the thread that made the context.
class Renderer {
 public:
  explicit Renderer(std::unique_ptr<Context> context);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// The picture of a view, `width` px wide, laid out by lay_out. The same view gives the same bits.
  /// Throws Error as lay_out does, and Error(internal) where OpenGL reports an error.
  Image draw(const FrameView& view, int width);

 private:
  void prepare_target(int width, int height);
  void prepare_atlas(double em);
  void draw_discs(const std::vector<Disc>& discs, const Camera& camera);
  void draw_furniture(const FrameView& view, const Layout& layout);
  Image read_target() const;

  std::unique_ptr<Context> context_;
  Gl gl_;
  Font font_;
  GlyphAtlas atlas_;
  Batch discs_, glyphs_, segments_;
  GLuint atlas_texture_ = 0;
  GLuint framebuffer_ = 0;
  GLuint target_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace talus
