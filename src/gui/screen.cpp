#include "gui/screen.h"

#include <algorithm>
#include <cmath>

#include "gui/font.h"
#include "gui/imgui_versions.h"
#include "gui/map_texture.h"
#include "gui/theme.h"

namespace talus::gui {
namespace {

/// Current context owned by another object.
class SameContext final : public render::Context {
 public:
  explicit SameContext(const render::Context& context) : context_(context) {}
  Function function(const char* name) const override { return context_.function(name); }

 private:
  const render::Context& context_;
};

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

/// Returns the requested scale, or the largest, in steps, at which a small window still has room for its
/// parts.
float fitting_scale(float asked, int width, int height) {
  constexpr float needed_width = 640.0f, needed_height = 450.0f, step = 0.25f;  // px at scale 1
  const float room =
      std::min(static_cast<float>(width) / needed_width, static_cast<float>(height) / needed_height);
  return std::min(asked, std::max(1.0f, step * std::floor(room / step)));
}

}  // namespace

void GuiScreen::ContextDeleter::operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }

GuiScreen::GuiScreen(std::unique_ptr<render::Context> context, float scale)
    : context_(context.get()), gl_(render::load_gl(*context)), display_scale_(scale) {
  map_ = std::make_unique<MapTexture>(std::move(context), gl_);
  painter_ = std::make_unique<DrawDataPainter>(gl_);
  imgui_.reset(ImGui::CreateContext());
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

GuiRequests GuiScreen::draw(view::ViewModel& model, const Surface& surface, int width, int height,
                            double seconds) {
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
    if (texture > 0 && !map_of_second_)
      map_of_second_ = std::make_unique<MapTexture>(std::make_unique<SameContext>(*context_), gl_);
    MapTexture& map = texture > 0 ? *map_of_second_ : *map_;
    return map.draw(view, static_cast<int>(static_cast<float>(map_width) * pixels));
  };
  places_.clear();
  GuiRequests requests = draw_gui(model, draw_map, places_);
  ImGui::Render();
  painter_->draw(*ImGui::GetDrawData(), surface);
  return requests;
}

render::Image GuiScreen::draw_image(const render::FrameView& view, int width) {
  return map_->draw_image(view, width);
}

}  // namespace talus::gui
