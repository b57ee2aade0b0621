#include "render/renderer.h"

#include "render/gl_target.h"

namespace talus::render {

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
