#include "gui/screen.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/core.h>
#include <span>

#include "base/errors.h"
#include "gui/theme.h"

namespace talus::embedded {

extern const std::span<const unsigned char> gui_vert, gui_frag;

}  // namespace talus::embedded

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

/// Current context owned by another object.
class SameContext final : public render::Context {
 public:
  explicit SameContext(const render::Context& context) : context_(context) {}
  Function function(const char* name) const override { return context_.function(name); }

 private:
  const render::Context& context_;
};

/// Time between two pictures of an OffscreenGui for ImGui, s: two clicks are no double click.
constexpr double picture_seconds = 0.1;

GLuint upload_font(const render::Gl& gl, ImFontAtlas& atlas) {
  unsigned char* coverage = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsAlpha8(&coverage, &width, &height);
  const GLuint texture = render::make_texture(gl, width, height, 1, coverage, GL_LINEAR);
  widen(gl, texture, OneChannel::alpha);
  atlas.SetTexID(texture_id(texture));
  atlas.ClearTexData();
  return texture;
}

/// Returns the requested scale, or the largest, in steps, with which a small window has room.
float fitting_scale(float asked, int width, int height) {
  constexpr float needed_width = 640.0f, needed_height = 450.0f, step = 0.25f;  // px at scale 1
  const float room =
      std::min(static_cast<float>(width) / needed_width, static_cast<float>(height) / needed_height);
  return std::min(asked, std::max(1.0f, step * std::floor(room / step)));
}

}  // namespace

DrawDataPainter::DrawDataPainter(const render::Gl& gl) : gl_(gl) {
  using enum render::Attribute;
  static_assert(sizeof(ImDrawVert) == 4 * sizeof(float) + sizeof(ImU32));
  batch_ = render::make_batch(gl_, render::make_program(gl_, "gui", embedded::gui_vert, embedded::gui_frag),
                              {floats2, floats2, colour}, 0);
}

DrawDataPainter::~DrawDataPainter() { render::delete_batch(gl_, batch_); }

/// Resolves the indices here: the renderer then needs no index buffers.
void DrawDataPainter::upload(const ImDrawData& data) {
  corners_.clear();
  corners_.reserve(static_cast<std::size_t>(data.TotalIdxCount));
  for (int k = 0; k < data.CmdListsCount; ++k) {
    const ImDrawList& list = *data.CmdLists[k];
    const std::size_t begin = corners_.size();
    corners_.resize(begin + static_cast<std::size_t>(list.IdxBuffer.Size));
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
      for (unsigned i = command.IdxOffset; i < command.IdxOffset + command.ElemCount; ++i)
        corners_[begin + i] = vertices[list.IdxBuffer.Data[i]];
    }
  }
  render::fill_batch(gl_, batch_, std::span<const ImDrawVert>(corners_));
}

void DrawDataPainter::draw_command(const ImDrawCmd& command, int first, const ImDrawData& data,
                                   const Surface& surface) {
  const auto pixel = [](float position, float origin, float scale) {
    return static_cast<int>(std::lround((position - origin) * scale));
  };
  const ImVec2 origin = data.DisplayPos, scale = data.FramebufferScale;
  const int x0 = std::max(pixel(command.ClipRect.x, origin.x, scale.x), 0);
  const int y0 = std::max(pixel(command.ClipRect.y, origin.y, scale.y), 0);
  const int x1 = std::min(pixel(command.ClipRect.z, origin.x, scale.x), surface.width);
  const int y1 = std::min(pixel(command.ClipRect.w, origin.y, scale.y), surface.height);
  if (x1 <= x0 || y1 <= y0 || command.UserCallback != nullptr) return;
  gl_.Scissor(x0, surface.top_row_first ? y0 : surface.height - y1, x1 - x0, y1 - y0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_number(command.GetTexID()));
  gl_.DrawArrays(GL_TRIANGLES, first, static_cast<GLsizei>(command.ElemCount));
}

void DrawDataPainter::draw(const ImDrawData& data, const Surface& surface) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, surface.framebuffer);
  gl_.Viewport(0, 0, surface.width, surface.height);
  gl_.Disable(GL_SCISSOR_TEST);
  const ImVec4 ground = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
  gl_.ClearColor(ground.x, ground.y, ground.z, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // all shaders multiply by alpha
  gl_.Enable(GL_SCISSOR_TEST);
  upload(data);
  gl_.Uniform4f(gl_.GetUniformLocation(batch_.program, "frame"), data.DisplayPos.x, data.DisplayPos.y,
                data.DisplaySize.x, surface.top_row_first ? data.DisplaySize.y : -data.DisplaySize.y);
  unsigned first = 0;
  for (int k = 0; k < data.CmdListsCount; ++k) {
    const ImDrawList& list = *data.CmdLists[k];
    for (const ImDrawCmd& command : list.CmdBuffer)
      draw_command(command, static_cast<int>(first + command.IdxOffset), data, surface);
    first += static_cast<unsigned>(list.IdxBuffer.Size);
  }
  gl_.Disable(GL_SCISSOR_TEST);
}

void widen(const render::Gl& gl, GLuint texture, OneChannel meaning) {
  const bool gray = meaning == OneChannel::gray;
  gl.BindTexture(GL_TEXTURE_2D, texture);
  for (const GLenum channel : {GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_SWIZZLE_G, GL_TEXTURE_SWIZZLE_B})
    gl.TexParameteri(GL_TEXTURE_2D, channel, gray ? GL_RED : GL_ONE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_A, gray ? GL_ONE : GL_RED);
}

MapTexture::MapTexture(std::unique_ptr<render::Context> context, const render::Gl& gl)
    : gl_(gl),
      target_(render::make_gl_target(std::move(context)).release()),
      renderer_(std::unique_ptr<render::ImageTarget>(target_)) {}

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

GuiScreen::GuiScreen(std::unique_ptr<render::Context> context, float scale)
    : context_(context.get()), gl_(render::load_gl(*context)), display_scale_(scale) {
  maps_[0] = std::make_unique<MapTexture>(std::move(context), gl_);
  painter_ = std::make_unique<DrawDataPainter>(gl_);
  ImGuiIO& own = io();
  own.IniFilename = nullptr;  // the layout follows from the size of the window
  own.LogFilename = nullptr;
  own.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  own.MousePos = {-1.0f, -1.0f};
  prepare_input(own);
  apply_appearance({view::Theme::light, scale, 1.0f});
}

GuiScreen::~GuiScreen() { gl_.DeleteTextures(1, &font_texture_); }

/// Bakes the glyphs at the pixel size of the display, so that they are sharp.
void GuiScreen::apply_appearance(const Appearance& appearance) {
  ImGuiIO& own = io();
  const float fine = appearance.scale * appearance.fineness;
  if (fine != appearance_.scale * appearance_.fineness) {
    own.Fonts->Clear();
    add_embedded_font(*own.Fonts, fine);
    gl_.DeleteTextures(1, &font_texture_);
    font_texture_ = upload_font(gl_, *own.Fonts);
  }
  ImGui::GetStyle() = style_of(appearance.theme, appearance.scale);
  scale_fonts(1.0f / appearance.fineness);
  appearance_ = appearance;
}

ImGuiIO& GuiScreen::io() {
  ImGui::SetCurrentContext(imgui_.get());
  return ImGui::GetIO();
}

void GuiScreen::draw(view::ViewModel& model, const Surface& surface, int width, int height, double seconds,
                     GuiRequests& requests) {
  ImGuiIO& own = io();
  const float pixels = static_cast<float>(surface.width) / static_cast<float>(width);
  own.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  own.DisplayFramebufferScale = {pixels, static_cast<float>(surface.height) / static_cast<float>(height)};
  own.DeltaTime = std::max(static_cast<float>(seconds), 1e-4f);  // ImGui requires a positive value
  const float asked = model.state.scale > 0.0 ? static_cast<float>(model.state.scale) : display_scale_;
  const Appearance appearance{model.state.theme, fitting_scale(asked, width, height), pixels};
  if (!(appearance == appearance_)) apply_appearance(appearance);
  input_.forward_events(own);
  ImGui::NewFrame();
  const DrawMap draw_map = [&](const render::FrameView& view, int map_width, std::size_t texture) {
    std::unique_ptr<MapTexture>& map = maps_.at(texture);
    if (!map) map = std::make_unique<MapTexture>(std::make_unique<SameContext>(*context_), gl_);
    return map->draw(view, static_cast<int>(static_cast<float>(map_width) * pixels));
  };
  places_.clear();
  draw_gui(model, draw_map, places_, requests);
  ImGui::Render();
  painter_->draw(*ImGui::GetDrawData(), surface);
}

OffscreenGui::OffscreenGui(view::ViewModel& model, int width, int height, float scale,
                           std::optional<render::ContextKind> kind)
    : GuiScreen(render::make_context(kind), scale), model_(model) {
  gl().GenFramebuffers(1, &surface_.framebuffer);
  surface_.top_row_first = true;
  resize(width, height);
}

OffscreenGui::~OffscreenGui() {
  gl().DeleteFramebuffers(1, &surface_.framebuffer);
  gl().DeleteTextures(1, &texture_);
}

void OffscreenGui::resize(int width, int height) {
  gl().DeleteTextures(1, &texture_);
  texture_ = render::make_texture(gl(), width, height, 4, nullptr, GL_NEAREST);
  gl().BindFramebuffer(GL_FRAMEBUFFER, surface_.framebuffer);
  gl().FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  if (gl().CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitCode::unavailable,
                fmt::format("the rendering context offers no window of {} x {} px; ask for a smaller one",
                            width, height));
  surface_.width = width;
  surface_.height = height;
  settle();
}

void OffscreenGui::advance(double seconds) {
  model_.update(seconds);
  draw(model_, surface_, surface_.width, surface_.height, picture_seconds, requests_);
}

render::Image OffscreenGui::frame(double seconds) {
  advance(seconds);
  render::Image image{surface_.width, surface_.height, 3, {}};
  image.pixels.resize(image.row_bytes() * static_cast<std::size_t>(image.height));
  gl().PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl().ReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  if (const GLenum error = gl().GetError(); error != GL_NO_ERROR)
    throw Error(ExitCode::internal, fmt::format("OpenGL reports error {} while drawing the window", error));
  return image;
}

void OffscreenGui::settle() {
  while (input().waiting()) advance(0.0);
  for (int k = 0; k < 3; ++k)
    advance(0.0);  // ImGui needs one more picture to know sizes and what is under the mouse
}

}  // namespace talus::gui
