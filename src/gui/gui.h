#pragma once
/// Gui is the widgets of `talus view`, drawn by Dear ImGui, with the view model as their data. draw_gui draws
/// one picture of the whole window: its panels (panels.h) of named widgets (widgets.cpp), in a GuiWindow or,
/// for tests and screenshots, an OffscreenGui. Only this folder includes imgui.h.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/view_model.h"

namespace talus::gui {

/// Place of a widget in the last picture, px of the window. Tests and scripts use it to click on widgets.
struct WidgetPlace {
  std::string name;  ///< "play", "map", "group map"
  float x0 = 0.0f, y0 = 0.0f, x1 = 0.0f, y1 = 0.0f;
};

/// Function that renders a picture for the map widget: draws the view into a texture of that width and
/// returns its number in OpenGL. Each view has its own texture, 0 or 1.
using DrawMap = std::function<unsigned(const render::FrameView& view, int width, std::size_t texture)>;

/// Requests from the widgets to the surrounding program.
struct GuiRequests {
  bool quit = false;
  std::string open_path;                  ///< run or scenario to open instead
  std::optional<std::size_t> open_frame;  ///< frame of that run to show first
  std::string save_png_path;              ///< file for the picture shown
  std::string plots_folder;               ///< folder for the plots shown, as figures with their data
};

/// Draws one picture of the entire window; call between ImGui::NewFrame and ImGui::Render. Adds the places of
/// the widgets to `places`, and their requests to `requests`.
void draw_gui(view::ViewModel& model, const DrawMap& draw_map, std::vector<WidgetPlace>& places,
              GuiRequests& requests);

}  // namespace talus::gui
