#pragma once
/// Made-up views with all elements of a picture, for tests that need no map.

#include <cmath>

#include "render/colour.h"
#include "render/frame_view.h"

namespace talus::test {

/// Returns a colour bar with three ticks.
inline render::Bar sample_bar(render::ColourMap map) {
  return {"γ = q/p", render::colour_ramp(map), {{0.0, "0.05"}, {0.46, "Γ_c = 0.34"}, {1.0, "2Γ_c = 0.69"}}};
}

/// Returns discs of 1 cm on a square lattice, in the colours of a map, with legend, title and caption.
inline render::FrameView sample_view(int columns = 40, int rows = 10,
                                     render::ColourMap map = render::ColourMap::gray) {
  render::FrameView view;
  view.x_max = 0.01 * columns;
  view.y_max = 0.01 * rows;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double share = 0.5 + 0.5 * std::sin(0.3 * column) * std::cos(0.5 * row);
      view.discs.push_back({static_cast<float>(0.01 * (column + 0.5)), static_cast<float>(0.01 * (row + 0.5)),
                            0.0048f, render::colour_at(map, share), render::gray(0.6), 0.0f});
    }
  view.tilt = 0.2;
  view.title = "Stress ratio γ of each grain";
  view.caption = "θ = 11.46°, θ_c = 20.05°";
  view.scale_length = 0.01 * std::min(10, columns / 2);
  view.scale_label = "10 D";
  view.legends = {{{sample_bar(map)}, {}}};
  return view;
}

/// Returns a curve that ends at an event.
inline render::Trace sample_trace(const std::string& title) {
  render::Trace trace;
  trace.title = title;
  for (int k = 0; k <= 80; ++k) {
    trace.x.push_back(0.25 * k);
    trace.y.push_back(0.1 + 0.02 * k + 0.05 * std::sin(0.7 * k));
  }
  trace.x_max = 20.0;
  trace.y_max = 2.0;
  trace.x_ticks = {{0.0, "0"}, {5.0, "5"}, {10.0, "10"}, {15.0, "15"}, {20.0, "20"}};
  trace.y_ticks = {{0.0, "0"}, {0.5, "0.5"}, {1.0, "1.0"}, {1.5, "1.5"}, {2.0, "2.0"}};
  trace.x_title = "θ (°)";
  trace.mark = 11.46;
  trace.event = 19.0;
  trace.event_label = "θ_c";
  return trace;
}

/// Returns two layers with their legends, lines, a hatched floor, a wall, and two traces.
inline render::FrameView full_view(int columns = 40, int rows = 10) {
  render::FrameView view = sample_view(columns, rows, render::ColourMap::viridis);
  view.title = "Stress ratio γ of each grain, and its force chains";
  view.legends.push_back(
      {{},
       {{render::Swatch::Kind::line, render::black, render::black, 0.4, "f_n > ⟨f_n⟩"},
        {render::Swatch::Kind::line, render::gray(0.4), render::black, 0.1, "f_n ≤ ⟨f_n⟩"},
        {render::Swatch::Kind::disc, render::white, render::gray(0.45), 0.0, "spans floor to surface"}}});
  for (int k = 0; k + 3 < columns; k += 3) {
    const auto x = static_cast<float>(0.01 * (k + 0.5));
    const auto top = static_cast<float>(view.y_max) - 0.005f;
    view.lines.push_back({x, 0.005f, x + 0.02f, top, 0.0002f * static_cast<float>(k % 7), render::gray(0.9)});
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(columns); ++k) {
    view.discs[k].hatched = 1.0f;
    view.discs[k].fill = render::white;
  }
  view.left_wall = view.right_wall = true;
  view.traces = {sample_trace("p_o, overloaded grains"), sample_trace("ΔV/V, volume strain")};
  return view;
}

}  // namespace talus::test
