#pragma once
/// The widgets of `talus view`: Dear ImGui draws them, and the view model knows what they show. Only this
/// folder includes imgui.h.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/view_model.h"

namespace talus::gui {

/// The place of a widget in the last picture, px of the window, so that tests and scripts can
/// click on it.
struct WidgetPlace {
  std::string name;  ///< "play", "map", "group map"
  float x0 = 0.0f, y0 = 0.0f, x1 = 0.0f, y1 = 0.0f;
};

/// How the map widget gets its picture: draws the view into a texture of that width and returns its id for
/// ImGui. Each of the pictures that are shown at once has its own texture: 0, and 1 for the second view.
using DrawMap = std::function<void*(const render::FrameView& view, int width, std::size_t texture)>;

/// Requests of the widgets to the program around them.
struct GuiRequests {
  bool quit = false;
  std::string open_path;                  ///< a run or scenario to open instead
  std::optional<std::size_t> open_frame;  ///< of that run, to be shown first
  std::string save_png_path;              ///< write what is shown
  std::string behind_path;                ///< a run or an ensemble to draw behind the curves
  std::string plots_folder;               ///< write the plots shown there, as figures with their data
};

/// One picture of the whole window, between ImGui::NewFrame and ImGui::Render. Fills `places` with the places
/// of the widgets.
GuiRequests draw_gui(view::ViewModel& model, const DrawMap& draw_map, std::vector<WidgetPlace>& places);

}  // namespace talus::gui
