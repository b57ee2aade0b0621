#include "render/renderer.h"

#include <algorithm>

#include "render/furniture.h"
#include "render/gl_target.h"

namespace talus::render {
namespace {

bool is_gray(const Legend& legend) {
  const auto gray_bar = [](const Bar& bar) {
    return std::ranges::all_of(bar.colours, [](const Colour& colour) { return is_gray(colour); });
  };
  return std::ranges::all_of(legend.bars, gray_bar) &&
         std::ranges::all_of(legend.swatches, [](const Swatch& swatch) {
           return is_gray(swatch.fill) && is_gray(swatch.rim);
         });
}

/// Pixels as they are: for furniture, which has y upwards from the top of the picture.
Window whole_picture(const Layout& layout) {
  Window window;
  window.box = {0.0, 0.0, static_cast<double>(layout.width), static_cast<double>(layout.height)};
  window.x_max = layout.width;
  window.y_min = -layout.height;
  return window;
}

}  // namespace

PixelFormat pixel_format(const FrameView& view) {
  if (view.transparent) return PixelFormat::transparent;
  const bool gray = !view.coloured && std::ranges::all_of(view.discs, [](const Disc& disc) {
    return is_gray(disc.fill) && is_gray(disc.rim);
  }) && std::ranges::all_of(view.lines, [](const Line& line) {
    return is_gray(line.colour);
  }) && std::ranges::all_of(view.legends, [](const Legend& legend) { return is_gray(legend); });
  return gray ? PixelFormat::gray : PixelFormat::colour;
}

Renderer::Renderer(std::unique_ptr<Context> context) : Renderer(make_gl_target(std::move(context))) {}

Renderer::Renderer(std::unique_ptr<Target> target) : target_(std::move(target)), font_(embedded_font()) {}

Image Renderer::draw(const FrameView& view, int width, const LayoutLimits& limits) {
  paint(view, width, limits);
  return target_->end();
}

Layout Renderer::paint(const FrameView& view, int width, const LayoutLimits& limits) {
  Layout layout = lay_out(view, width, font_, limits);
  target_->begin(layout.width, layout.height, pixel_format(view));
  target_->draw_discs(view.discs, layout.bed);
  target_->draw_lines(view.lines, layout.bed);
  if (view.furniture) {
    if (atlas_.em != layout.em) atlas_ = bake_glyphs(layout.em);
    const Furniture furniture = furnish(view, layout, font_, atlas_);
    const Window picture = whole_picture(layout);
    target_->draw_triangles(furniture.triangles, atlas_);
    target_->draw_lines(furniture.lines, picture);
    target_->draw_discs(furniture.discs, picture);
  }
  return layout;
}

}  // namespace talus::render
