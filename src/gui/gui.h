#pragma once
/// The widgets of `talus view`: Dear ImGui draws them, the view model knows what they show. The only home of
/// imgui.h is this folder.

#include <functional>
#include <string>
#include <vector>

#include "view/view_model.h"

namespace talus {

/// Where a widget was in the picture that was drawn last, px of the window: so that tests and scripts can
/// click it.
struct WidgetPlace {
  std::string name;  ///< "play", "map", "tab maps"
  float x0 = 0.0f, y0 = 0.0f, x1 = 0.0f, y1 = 0.0f;
};

/// What the map widget needs from whoever draws pictures: draws the view into a texture of that size and
/// returns its id for ImGui.
using DrawMap = std::function<void*(const FrameView& view, int width, int height)>;

/// What widgets ask of the program around them.
struct GuiRequests {
  bool quit = false;
  std::string open_path;      ///< a run or scenario to open instead
  std::string save_png_path;  ///< write what is shown
};

/// One picture of the whole window, between ImGui::NewFrame and ImGui::Render. `places` is filled with where
/// the widgets are.
GuiRequests draw_gui(ViewModel& model, const DrawMap& draw_map, std::vector<WidgetPlace>& places);

/// Text sizes and colours; to be called once for each ImGui context. `scale` is that of the display (1, 2
/// ...).
void set_style(float scale);

}  // namespace talus
