#include "gui/draw_data.h"

#include <cmath>
#include <span>

#include "gui/embedded_shaders.h"
#include "gui/imgui_versions.h"

namespace talus::gui {

static_assert(sizeof(ImDrawVert) == 4 * sizeof(float) + sizeof(ImU32));

DrawDataPainter::DrawDataPainter(const render::Gl& gl) : gl_(gl) {
  using enum render::Attribute;
  batch_ = render::make_batch(gl_, render::make_program(gl_, "gui", embedded::gui_vert, embedded::gui_frag),
                              {floats2, floats2, colour}, 0);
}

DrawDataPainter::~DrawDataPainter() { render::delete_batch(gl_, batch_); }

/// Resolves the indices here: widgets have tens of thousands of vertices, and the renderer then needs no
/// index buffers.
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
  gl_.BlendFunc(GL_ONE,
                GL_ONE_MINUS_SRC_ALPHA);  // the shader multiplies by alpha, like all shaders of the renderer
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

}  // namespace talus::gui
