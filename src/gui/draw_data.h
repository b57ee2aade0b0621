#pragma once
/// Draws what Dear ImGui has laid out, with the renderer's own OpenGL functions, in a window and without one.
/// (The backends that come with ImGui load libGL, which breaks contexts in memory.)

#include <imgui.h>

#include <vector>

#include "render/gl_loader.h"
#include "render/gl_objects.h"

namespace talus::gui {

/// The surface that is drawn on.
struct Surface {
  GLuint framebuffer = 0;     ///< 0: the window
  int width = 0, height = 0;  ///< px
  bool top_row_first =
      false;  ///< row 0 is the top of the picture, as images have it; windows have it at the bottom
};

/// Owns its objects in the current context. Coordinates and textures are those of ImGui: the id of a texture
/// is its number, its row 0 is the top, its alpha is straight.
class DrawDataPainter {
 public:
  explicit DrawDataPainter(const render::Gl& gl);
  ~DrawDataPainter();
  DrawDataPainter(const DrawDataPainter&) = delete;
  DrawDataPainter& operator=(const DrawDataPainter&) = delete;

  /// On a ground of the colour of windows, so that those that fill the surface need none of their own:
  /// without a GPU a layer over all of it takes some 5 ms. Callbacks of draw lists are not called.
  void draw(const ImDrawData& data, const Surface& surface);

 private:
  void upload(const ImDrawData& data);
  void draw_command(const ImDrawCmd& command, int first, const ImDrawData& data, const Surface& surface);

  const render::Gl& gl_;
  render::Batch batch_;
  std::vector<ImDrawVert> corners_;  ///< of all triangles; kept to save allocations
};

/// A texture with one channel, shown as gray (pictures) or as white with that alpha (fonts).
enum class OneChannel { gray, alpha };
void widen(const render::Gl& gl, GLuint texture, OneChannel meaning);

}  // namespace talus::gui
