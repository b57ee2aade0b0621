#include "render/renderer.h"

#include <span>
#include <string>

#include "core/errors.h"
#include "render/embedded.h"
#include "render/furniture.h"

namespace talus {

static_assert(sizeof(Disc) == 5 * sizeof(float) && sizeof(FurnitureVertex) == 5 * sizeof(float) &&
              sizeof(Segment) == 6 * sizeof(float));

Renderer::Renderer(std::unique_ptr<Context> context)
    : context_(std::move(context)), gl_(load_gl(*context_)), font_(embedded_font()) {
  discs_ = make_batch(gl_, make_program(gl_, "disc", embedded::disc_vert, embedded::disc_frag), {3, 2}, 1);
  glyphs_ =
      make_batch(gl_, make_program(gl_, "glyph", embedded::glyph_vert, embedded::glyph_frag), {2, 3}, 0);
  segments_ = make_batch(gl_, make_program(gl_, "segment", embedded::segment_vert, embedded::segment_frag),
                         {4, 2}, 1);
  gl_.GenFramebuffers(1, &framebuffer_);
}

Renderer::~Renderer() {
  for (Batch* batch : {&discs_, &glyphs_, &segments_}) delete_batch(gl_, *batch);
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &target_);
  gl_.DeleteTextures(1, &atlas_texture_);
}

Image Renderer::draw(const FrameView& view, int width) {
  const Layout layout = lay_out(view, width, font_);
  prepare_target(layout.width, layout.height);

  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.ClearColor(1.0f, 1.0f, 1.0f, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.Enable(GL_BLEND);
  // Alpha apart, so that a target with alpha stays opaque.
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);

  gl_.Enable(GL_SCISSOR_TEST);  // row 0 of the target is the top of the picture
  gl_.Scissor(static_cast<GLint>(layout.bed.x), static_cast<GLint>(layout.bed.y),
              static_cast<GLsizei>(layout.bed.width), static_cast<GLsizei>(layout.bed.height));
  draw_discs(view.discs, layout.camera);
  gl_.Disable(GL_SCISSOR_TEST);
  if (view.furniture) draw_furniture(view, layout);
  return read_target();
}

void Renderer::prepare_target(int width, int height) {
  if (width == width_ && height == height_) return;
  gl_.DeleteTextures(1, &target_);
  target_ = make_gray_texture(gl_, width, height, nullptr, GL_NEAREST);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_, 0);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitCode::unavailable, "the rendering context offers no target of " + std::to_string(width) +
                                           " x " + std::to_string(height) + " px; ask for a smaller width");
  width_ = width;
  height_ = height;
}

void Renderer::prepare_atlas(double em) {
  if (em == atlas_.em) return;
  atlas_ = bake_glyphs(em);
  gl_.DeleteTextures(1, &atlas_texture_);
  atlas_texture_ = make_gray_texture(gl_, atlas_.size, atlas_.size, atlas_.coverage.data(), GL_LINEAR);
}

void Renderer::draw_discs(const std::vector<Disc>& discs, const Camera& camera) {
  fill_batch(gl_, discs_, std::span(discs));
  gl_.Uniform2f(gl_.GetUniformLocation(discs_.program, "size"), static_cast<float>(width_),
                static_cast<float>(height_));
  gl_.Uniform3f(gl_.GetUniformLocation(discs_.program, "camera"), static_cast<float>(camera.scale),
                static_cast<float>(camera.origin_x), static_cast<float>(camera.origin_y));
  gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(discs.size()));
}

void Renderer::draw_furniture(const FrameView& view, const Layout& layout) {
  prepare_atlas(layout.em);
  const Furniture furniture = furnish(view, layout, font_, atlas_);
  draw_discs(furniture.swatches, Camera{1.0, 0.0, 0.0});

  const auto set_size = [&](const Batch& batch) {
    gl_.Uniform2f(gl_.GetUniformLocation(batch.program, "size"), static_cast<float>(width_),
                  static_cast<float>(height_));
  };
  fill_batch(gl_, glyphs_, std::span(furniture.triangles));
  set_size(glyphs_);
  gl_.BindTexture(GL_TEXTURE_2D, atlas_texture_);
  gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(furniture.triangles.size()));

  fill_batch(gl_, segments_, std::span(furniture.segments));
  set_size(segments_);
  gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(furniture.segments.size()));
}

Image Renderer::read_target() const {
  Image image{width_, height_, {}};
  image.gray.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width_, height_, GL_RED, GL_UNSIGNED_BYTE, image.gray.data());
  if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR)
    throw Error(ExitCode::internal, "OpenGL reports error " + std::to_string(error) + " while drawing");
  return image;
}

}  // namespace talus
