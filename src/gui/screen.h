#pragma once
/// The picture of the window: the output of Dear ImGui, drawn with the renderer's OpenGL functions, with or
/// without a window. (The backends of ImGui load libGL, which breaks contexts in memory.) An OffscreenGui is
/// the entire window without a display, for documents and tests, and a GuiWindow that of `talus view`.

struct ImGuiContext;

#include <imgui.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "gui/gui.h"
#include "gui/imgui_versions.h"
#include "render/context.h"
#include "render/gl_loader.h"
#include "render/gl_objects.h"
#include "render/gl_target.h"
#include "render/image.h"
#include "render/renderer.h"

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

class MapTexture {
 public:
  /// Takes over a current context with its functions `gl`.
  MapTexture(std::unique_ptr<render::Context> context, const render::Gl& gl);

  /// Returns the texture with a view, `width` px wide; the height follows from the view. A view without
  /// legends and titles is redrawn only after a change: without a GPU, 8000 grains take about 6 ms.
  GLuint draw(const render::FrameView& view, int width);

  /// Draws a picture in memory, as talus render does.
  render::Image draw_image(const render::FrameView& view, int width);

 private:
  const render::Gl& gl_;
  render::TextureTarget* target_;  ///< owned by the renderer
  render::Renderer renderer_;
  render::FrameView drawn_;  ///< view in the texture; valid if width_ > 0
  int width_ = 0;
};

class GuiScreen {
 public:
  /// Requires a current context. `scale` is that of the display: with 2 everything is twice as large, unless
  /// the model requests another scale.
  GuiScreen(std::unique_ptr<render::Context> context, float scale);
  ~GuiScreen();
  GuiScreen(const GuiScreen&) = delete;
  GuiScreen& operator=(const GuiScreen&) = delete;

  /// Draws one picture of the entire window, `seconds` after the previous one, and adds what the widgets
  /// request. Mouse positions are given in `width` x `height`; the surface may have more pixels.
  void draw(view::ViewModel& model, const Surface& surface, int width, int height, double seconds,
            GuiRequests& requests);

  /// Sets the scale when the window moves to another display.
  void set_display_scale(float scale) { display_scale_ = scale; }

  InputQueue& input() { return input_; }
  ImGuiIO& io();
  /// Returns the places of the widgets in the last picture.
  const std::vector<WidgetPlace>& places() const { return places_; }
  /// Draws a view as talus render does.
  render::Image draw_image(const render::FrameView& view, int width) {
    return maps_[0]->draw_image(view, width);
  }
  const render::Gl& gl() const { return gl_; }

 private:
  /// Parameters of the current fonts and style.
  struct Appearance {
    view::Theme theme = view::Theme::light;
    float scale = 0.0f;     ///< scale of text and widgets
    float fineness = 1.0f;  ///< px of the surface per px of the window
    bool operator==(const Appearance&) const = default;
  };
  void apply_appearance(const Appearance& appearance);

  const render::Context* context_;  ///< owned by the first map
  render::Gl gl_;
  /// Maps of the two views, the second null until it is first shown; the first is destroyed last.
  std::array<std::unique_ptr<MapTexture>, 2> maps_;
  std::unique_ptr<DrawDataPainter> painter_;
  std::unique_ptr<ImGuiContext, void (*)(ImGuiContext*)> imgui_{ImGui::CreateContext(),
                                                                ImGui::DestroyContext};
  GLuint font_texture_ = 0;
  float display_scale_ = 1.0f;
  Appearance appearance_;
  InputQueue input_;
  std::vector<WidgetPlace> places_;
};

class OffscreenGui : public GuiScreen {
 public:
  /// Creates a window of that size (px) in a context without a display, with text and widgets enlarged by
  /// `scale`. Throws Error(unavailable) if there is no context.
  OffscreenGui(view::ViewModel& model, int width, int height, float scale = 1.0f,
               std::optional<render::ContextKind> kind = {});
  ~OffscreenGui();

  /// Advances the model, draws, and returns the content of the window with three channels.
  render::Image frame(double seconds = 0.0);
  /// Draws until all input is delivered and the layout is final. The model does not advance.
  void settle();
  void resize(int width, int height);
  /// Returns all requests of the widgets since the window was created.
  const GuiRequests& requests() const { return requests_; }

 private:
  void advance(double seconds);

  view::ViewModel& model_;
  Surface surface_;
  GLuint texture_ = 0;
  GuiRequests requests_;
};

struct WindowState;

class GuiWindow {
 public:
  /// Creates a hidden window, `width` x `height` times the scale of the display. Throws Error(unavailable)
  /// without a display or OpenGL 3.3.
  GuiWindow(int width, int height);
  ~GuiWindow();
  GuiWindow(const GuiWindow&) = delete;
  GuiWindow& operator=(const GuiWindow&) = delete;

  /// Waits for a change for at most a tenth of a second and shows it, with at most 60 pictures per second.
  /// Draws nothing without a change. Dropping a file on the window requests to open it, and closing it
  /// requests to quit if the run may be discarded.
  GuiRequests next_picture(view::ViewModel& model);
  GuiScreen& screen();

 private:
  std::unique_ptr<WindowState> state_;
};

}  // namespace talus::gui
