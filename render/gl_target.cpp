#include "render/gl_target.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>

#include "base/errors.h"
#include "render/embedded.h"
#include "render/gl_objects.h"
#include "render/renderer.h"

namespace talus::render {
namespace {

/// A corner of a triangle: part of a glyph of the atlas, or of a plain area if u < 0.
struct Vertex {
  float x, y;  ///< px from the left and from the top
  float u, v;  ///< position in the atlas
  Colour colour;
};

static_assert(sizeof(Disc) == 6 * sizeof(float) && sizeof(Line) == 6 * sizeof(float) &&
              sizeof(Vertex) == 5 * sizeof(float));

void add_rectangle(std::vector<Vertex>& triangles, const Box& box, const Colour& left, const Colour& right) {
  const auto corner = [](double x, double y, const Colour& colour) {
    return Vertex{static_cast<float>(x), static_cast<float>(y), -1.0f, 0.0f, colour};
  };
  const Vertex a = corner(box.x, box.y, left), b = corner(box.right(), box.y, right);
  const Vertex c = corner(box.x, box.bottom(), left), d = corner(box.right(), box.bottom(), right);
  triangles.insert(triangles.end(), {a, b, c, c, b, d});
}

void add_text(std::vector<Vertex>& triangles, const PlacedText& text, const Font& font,
              const GlyphAtlas& atlas) {
  const double base_line = base_line_of(text, atlas.em);
  for (const Glyph& glyph : set_text(font, text.text, atlas.em).glyphs) {
    const std::vector<stbtt_packedchar>& glyphs = glyph.subscript ? atlas.subscript : atlas.plain;
    auto x = static_cast<float>(text.box.x + glyph.x);
    auto y = static_cast<float>(base_line + (glyph.subscript ? std::round(subscript_drop * atlas.em) : 0.0));
    stbtt_aligned_quad quad;
    stbtt_GetPackedQuad(glyphs.data(), atlas.size, atlas.size, static_cast<int>(glyph.code), &x, &y, &quad,
                        0);
    const Vertex a{quad.x0, quad.y0, quad.s0, quad.t0, black}, b{quad.x1, quad.y0, quad.s1, quad.t0, black};
    const Vertex c{quad.x0, quad.y1, quad.s0, quad.t1, black}, d{quad.x1, quad.y1, quad.s1, quad.t1, black};
    triangles.insert(triangles.end(), {a, b, c, c, b, d});
  }
}

class GlTarget final : public TextureTarget {
 public:
  explicit GlTarget(std::unique_ptr<Context> context)
      : context_(std::move(context)), gl_(load_gl(*context_)) {
    using enum Attribute;
    // The last number of a disc selects the program that draws it.
    discs_ = make_batch(gl_, make_program(gl_, "disc", embedded::disc_vert, embedded::disc_frag),
                        {floats3, colour, colour, floats1}, 1);
    hatched_discs_ =
        make_batch(gl_, make_program(gl_, "hatched_disc", embedded::disc_vert, embedded::hatched_disc_frag),
                   {floats3, colour, colour, floats1}, 1);
    lines_ = make_batch(gl_, make_program(gl_, "line", embedded::line_vert, embedded::line_frag),
                        {floats4, floats1, colour}, 1);
    triangles_ = make_batch(gl_, make_program(gl_, "glyph", embedded::glyph_vert, embedded::glyph_frag),
                            {floats2, floats2, colour}, 0);
    gl_.GenFramebuffers(1, &framebuffer_);
  }

  ~GlTarget() override {
    for (Batch* batch : {&discs_, &hatched_discs_, &lines_, &triangles_}) delete_batch(gl_, *batch);
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteTextures(1, &picture_);
    gl_.DeleteTextures(1, &atlas_);
  }
  GlTarget(const GlTarget&) = delete;
  GlTarget& operator=(const GlTarget&) = delete;

  void begin(int width, int height, PixelFormat format) override {
    prepare_picture(width, height, format);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.Viewport(0, 0, width_, height_);
    const float ground = format == PixelFormat::transparent ? 0.0f : 1.0f;
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.ClearColor(ground, ground, ground, ground);
    gl_.Clear(GL_COLOR_BUFFER_BIT);
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_ONE,
                  GL_ONE_MINUS_SRC_ALPHA);  // colours are premultiplied by alpha, also in the picture
  }

  void draw_discs(std::span<const Disc> discs, const Window& window) override {
    while (!discs.empty()) {  // one run of equally hatched discs at a time
      const bool hatched = discs.front().hatched > 0.5f;
      const auto end = std::ranges::find_if(
          discs, [hatched](const Disc& disc) { return (disc.hatched > 0.5f) != hatched; });
      const auto alike = discs.first(static_cast<std::size_t>(end - discs.begin()));
      const Batch& batch = hatched ? hatched_discs_ : discs_;
      fill_batch(gl_, batch, alike);
      draw_instances(batch, GL_TRIANGLES, 3, alike.size(), window);
      discs = discs.subspan(alike.size());
    }
  }

  void draw_lines(std::span<const Line> lines, const Window& window) override {
    fill_batch(gl_, lines_, lines);
    draw_instances(lines_, GL_TRIANGLE_STRIP, 4, lines.size(), window);
  }

  void draw_areas(std::span<const Area> areas) override {
    std::vector<Vertex> triangles;
    for (const Area& area : areas) {
      const std::size_t pieces = std::max<std::size_t>(1, area.colours.size() - 1);
      const double width = area.box.width / static_cast<double>(pieces);
      for (std::size_t k = 0; k < pieces; ++k)
        add_rectangle(triangles,
                      {area.box.x + static_cast<double>(k) * width, area.box.y, width, area.box.height},
                      area.colours[k], area.colours[std::min(k + 1, area.colours.size() - 1)]);
    }
    draw_triangles(triangles);
  }

  void draw_texts(std::span<const PlacedText> texts, double em) override {
    prepare_atlas(em);
    std::vector<Vertex> triangles;
    for (const PlacedText& text : texts) add_text(triangles, text, font_, glyphs_);
    draw_triangles(triangles);
  }

  unsigned texture() const override { return picture_; }

  Image end() override {
    Image image = read_picture();
    if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR)
      throw Error(ExitCode::internal, "OpenGL reports error {} while drawing", error);
    return image;
  }

 private:
  void draw_triangles(std::span<const Vertex> triangles) {
    gl_.Disable(GL_SCISSOR_TEST);
    fill_batch(gl_, triangles_, triangles);
    set_size(triangles_);
    gl_.BindTexture(GL_TEXTURE_2D, atlas_);
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
  }

  void prepare_picture(int width, int height, PixelFormat format) {
    const bool same = width == width_ && height == height_ && format == format_;
    if (same) return;
    gl_.DeleteTextures(1, &picture_);
    picture_ = make_texture(gl_, width, height, format == PixelFormat::gray ? 1 : 4, nullptr, GL_NEAREST);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture_, 0);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw Error(ExitCode::unavailable,
                  "the rendering context offers no target of {} x {} px; ask for a smaller width", width,
                  height);
    width_ = width;
    height_ = height;
    format_ = format;
  }

  void prepare_atlas(double em) {
    if (em == glyphs_.em) return;
    glyphs_ = bake_glyphs(em);
    gl_.DeleteTextures(1, &atlas_);
    atlas_ = make_texture(gl_, glyphs_.size, glyphs_.size, 1, glyphs_.coverage.data(), GL_LINEAR);
  }

  void set_size(const Batch& batch) {
    gl_.Uniform2f(gl_.GetUniformLocation(batch.program, "size"), static_cast<float>(width_),
                  static_cast<float>(height_));
  }

  /// Draws a filled batch with that number of corners per instance.
  void draw_instances(const Batch& batch, GLenum shape, GLsizei corners, std::size_t count,
                      const Window& window) {
    const Camera& camera = window.camera;
    const bool turned = camera.sine != 0.0;
    set_size(batch);
    gl_.Uniform3f(gl_.GetUniformLocation(batch.program, "camera"), static_cast<float>(camera.scale),
                  static_cast<float>(camera.origin_x), static_cast<float>(camera.origin_y));
    gl_.Uniform2f(gl_.GetUniformLocation(batch.program, "turn"), static_cast<float>(camera.cosine),
                  static_cast<float>(camera.sine));
    gl_.Uniform4f(gl_.GetUniformLocation(batch.program, "clip"), static_cast<float>(window.x_min),
                  static_cast<float>(window.x_max), static_cast<float>(window.y_min),
                  static_cast<float>(window.y_max));
    gl_.Enable(GL_SCISSOR_TEST);  // row 0 of the target is the top of the picture
    gl_.Scissor(static_cast<GLint>(window.box.x), static_cast<GLint>(window.box.y),
                static_cast<GLsizei>(window.box.width), static_cast<GLsizei>(window.box.height));
    for (GLenum plane = GL_CLIP_DISTANCE0; plane < GL_CLIP_DISTANCE0 + 4; ++plane)
      turned ? gl_.Enable(plane) : gl_.Disable(plane);
    gl_.DrawArraysInstanced(shape, 0, corners, static_cast<GLsizei>(count));
    for (GLenum plane = GL_CLIP_DISTANCE0; plane < GL_CLIP_DISTANCE0 + 4; ++plane) gl_.Disable(plane);
  }

  Image read_picture() const {
    const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    Image image{width_, height_, 1, {}};
    if (format_ == PixelFormat::gray) {
      image.pixels.resize(pixels);
      gl_.ReadPixels(0, 0, width_, height_, GL_RED, GL_UNSIGNED_BYTE, image.pixels.data());
      return image;
    }
    std::vector<std::uint8_t> rgba(4 * pixels);
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    return format_ == PixelFormat::colour ? without_alpha(rgba) : straight_alpha(std::move(rgba));
  }

  Image without_alpha(const std::vector<std::uint8_t>& rgba) const {
    Image image{width_, height_, 3, {}};
    image.pixels.resize(rgba.size() / 4 * 3);
    std::uint8_t* out = image.pixels.data();
    for (std::size_t k = 0; k < rgba.size(); k += 4) {
      *out++ = rgba[k];
      *out++ = rgba[k + 1];
      *out++ = rgba[k + 2];
    }
    return image;
  }

  Image straight_alpha(std::vector<std::uint8_t> rgba) const {
    for (std::size_t k = 0; k < rgba.size(); k += 4) {
      const int alpha = rgba[k + 3];
      if (alpha == 0 || alpha == 255) continue;
      for (std::size_t channel = k; channel < k + 3; ++channel)
        rgba[channel] = static_cast<std::uint8_t>(std::min(255, (255 * rgba[channel] + alpha / 2) / alpha));
    }
    return {width_, height_, 4, std::move(rgba)};
  }

  std::unique_ptr<Context> context_;
  Gl gl_;
  Batch discs_, hatched_discs_, lines_, triangles_;
  GLuint framebuffer_ = 0;
  GLuint picture_ = 0;
  int width_ = 0, height_ = 0;
  PixelFormat format_ = PixelFormat::gray;
  Font font_ = embedded_font();
  GlyphAtlas glyphs_;
  GLuint atlas_ = 0;  ///< the glyphs as a texture
};

}  // namespace

std::unique_ptr<TextureTarget> make_gl_target(std::unique_ptr<Context> context) {
  return std::make_unique<GlTarget>(std::move(context));
}

Renderer::Renderer(std::unique_ptr<Context> context) : Renderer(make_gl_target(std::move(context))) {}

Renderer::Renderer(std::unique_ptr<ImageTarget> target)
    : target_(std::move(target)), font_(embedded_font()) {}

Image Renderer::draw(const FrameView& view, int width, const LayoutLimits& limits) {
  paint(view, width, limits);
  return target_->end();
}

Image Renderer::draw(const Sheet& sheet) {
  render::paint(*target_, sheet);
  return target_->end();
}

Layout Renderer::paint(const FrameView& view, int width, const LayoutLimits& limits) {
  Layout layout = lay_out(view, width, font_, limits);
  render::paint(*target_, view, layout);
  return layout;
}

}  // namespace talus::render
