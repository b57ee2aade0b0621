#pragma once
/// Draws the output of Dear ImGui with the renderer's OpenGL functions, with or without a window. (The
/// backends of ImGui load libGL, which breaks contexts in memory.)

#include <imgui.h>

#include <vector>

#include "render/gl_loader.h"
#include "render/gl_objects.h"

namespace talus::gui {

/// Surface to draw on.
struct Surface {
  GLuint framebuffer = 0;      ///< 0: the window
  int width = 0, height = 0;   ///< px
  bool top_row_first = false;  ///< whether row 0 is the top, as in images; in windows it is the bottom
};

/// Owns its OpenGL objects in the current context. Coordinates and textures follow ImGui: a texture's id is
/// its number, its row 0 is the top, and alpha is not premultiplied.
class DrawDataPainter {
 public:
  explicit DrawDataPainter(const render::Gl& gl);
  ~DrawDataPainter();
  DrawDataPainter(const DrawDataPainter&) = delete;
  DrawDataPainter& operator=(const DrawDataPainter&) = delete;

  /// Draws on a background in the colour of windows, so that windows that fill the surface need none: without
  /// a GPU a full-size layer takes about 5 ms. Callbacks of draw lists are not called.
  void draw(const ImDrawData& data, const Surface& surface);

 private:
  void upload(const ImDrawData& data);
  void draw_command(const ImDrawCmd& command, int first, const ImDrawData& data, const Surface& surface);

  const render::Gl& gl_;
  render::Batch batch_;
  std::vector<ImDrawVert> corners_;  ///< vertices of all triangles; kept between calls to save allocations
};

/// Interpretation of a texture with one channel: gray (pictures), or white with that alpha (fonts).
enum class OneChannel { gray, alpha };
void widen(const render::Gl& gl, GLuint texture, OneChannel meaning);

}  // namespace talus::gui
