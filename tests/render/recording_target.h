#pragma once
/// Target that draws nothing and records the requests, for tests without OpenGL.

#include <vector>

#include "render/target.h"

namespace talus::test {

struct Recording {
  int width = 0, height = 0, begun = 0, ended = 0;
  render::PixelFormat format = render::PixelFormat::gray;
  std::vector<std::vector<render::Disc>> discs;  ///< one entry per draw, in order
  std::vector<std::vector<render::Line>> lines;
  std::vector<render::Window> disc_windows, line_windows;
  std::vector<render::Area> areas;
  std::vector<render::PlacedText> texts;
};

/// Fills the recording of its owner; its pictures are blank.
class RecordingTarget final : public render::ImageTarget {
 public:
  explicit RecordingTarget(Recording& recording) : recording_(recording) {}

  void begin(int width, int height, render::PixelFormat format) override {
    const int begun = recording_.begun + 1, ended = recording_.ended;
    recording_ = {};
    recording_.width = width;
    recording_.height = height;
    recording_.format = format;
    recording_.begun = begun;
    recording_.ended = ended;
  }
  void draw_discs(std::span<const render::Disc> discs, const render::Window& window) override {
    recording_.discs.emplace_back(discs.begin(), discs.end());
    recording_.disc_windows.push_back(window);
  }
  void draw_lines(std::span<const render::Line> lines, const render::Window& window) override {
    recording_.lines.emplace_back(lines.begin(), lines.end());
    recording_.line_windows.push_back(window);
  }
  void draw_areas(std::span<const render::Area> areas) override {
    recording_.areas.insert(recording_.areas.end(), areas.begin(), areas.end());
  }
  void draw_texts(std::span<const render::PlacedText> texts, double) override {
    recording_.texts.insert(recording_.texts.end(), texts.begin(), texts.end());
  }
  render::Image end() override {
    ++recording_.ended;
    const int channels = recording_.format == render::PixelFormat::gray     ? 1
                         : recording_.format == render::PixelFormat::colour ? 3
                                                                            : 4;
    render::Image image{recording_.width, recording_.height, channels, {}};
    image.pixels.assign(image.row_bytes() * static_cast<std::size_t>(image.height), 255);
    return image;
  }

 private:
  Recording& recording_;
};

}  // namespace talus::test
