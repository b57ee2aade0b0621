#include "gui/map_texture.h"

#include <algorithm>
#include <cstring>

namespace talus::gui {
namespace {

template <typename Shape>
bool same_bytes(const std::vector<Shape>& a, const std::vector<Shape>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Shape)) == 0;
}

/// Returns whether two views certainly give the same picture; legends and titles are not compared.
bool same_picture(const render::FrameView& a, const render::FrameView& b) {
  return !a.furniture && !b.furniture && a.x_min == b.x_min && a.x_max == b.x_max && a.y_min == b.y_min &&
         a.y_max == b.y_max && a.turn == b.turn && a.turn_max == b.turn_max && a.coloured == b.coloured &&
         a.transparent == b.transparent && same_bytes(a.discs, b.discs) && same_bytes(a.lines, b.lines);
}

/// Returns a renderer for the target that is kept for its texture.
std::unique_ptr<render::TextureTarget> keep(std::unique_ptr<render::TextureTarget> target,
                                            render::TextureTarget*& kept) {
  kept = target.get();
  return target;
}

}  // namespace

MapTexture::MapTexture(std::unique_ptr<render::Context> context, const render::Gl& gl)
    : gl_(gl), target_(nullptr), renderer_(keep(render::make_gl_target(std::move(context)), target_)) {}

GLuint MapTexture::draw(const render::FrameView& view, int width) {
  width = std::clamp(width, render::smallest_width, render::largest_side);
  if (width != width_ || !same_picture(view, drawn_)) {
    width_ = 0;
    renderer_.paint(view, width);
    if (render::pixel_format(view) == render::PixelFormat::gray)
      widen(gl_, target_->texture(), OneChannel::gray);
    drawn_ = view;
    width_ = width;
  }
  return target_->texture();
}

render::Image MapTexture::draw_image(const render::FrameView& view, int width) {
  width_ = 0;  // the target is shared
  return renderer_.draw(view, width);
}

}  // namespace talus::gui
