/// Time to draw a picture of discs, to encode it as PNG, and to do both until the file is on disk. Files
/// are written to the current folder. Mesa draws with LP_NUM_THREADS threads.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <future>

#include "pictures.h"
#include "render/png.h"
#include "render/renderer.h"

namespace talus::bench {
namespace {

constexpr const char* frame_file = "render_bench_frame.png";

void draw(benchmark::State& state, const PictureSize& size, bool coloured) {
  render::Renderer renderer(render::make_context(std::nullopt));
  const render::FrameView view = picture(size, coloured);
  for (auto _ : state) benchmark::DoNotOptimize(renderer.draw(view, size.width));
}

void png(benchmark::State& state, const PictureSize& size, bool coloured) {
  const render::Image image =
      render::Renderer(render::make_context(std::nullopt)).draw(picture(size, coloured), size.width);
  std::size_t bytes = 0;
  for (auto _ : state) bytes = render::encode_png(image).size();
  state.counters["kB"] = static_cast<double>(bytes) / 1000.0;
}

/// Draws and writes frames one after the other.
void frame(benchmark::State& state, const PictureSize& size, bool coloured) {
  render::Renderer renderer(render::make_context(std::nullopt));
  const render::FrameView view = picture(size, coloured);
  for (auto _ : state) render::write_png(frame_file, renderer.draw(view, size.width));
  std::filesystem::remove(frame_file);
}

/// Writes a frame in a second thread while the next one is drawn.
void frame_overlapped(benchmark::State& state, const PictureSize& size, bool coloured) {
  render::Renderer renderer(render::make_context(std::nullopt));
  const render::FrameView view = picture(size, coloured);
  std::future<void> written;
  for (auto _ : state) {
    render::Image image = renderer.draw(view, size.width);
    if (written.valid()) written.get();
    written =
        std::async(std::launch::async, [image = std::move(image)] { render::write_png(frame_file, image); });
  }
  written.get();
  std::filesystem::remove(frame_file);
}

const bool registered = [] {
  struct Stage {
    const char* name;
    void (*run)(benchmark::State&, const PictureSize&, bool);
  };
  for (const Stage& stage : {Stage{"draw", draw}, Stage{"png", png}, Stage{"frame", frame},
                             Stage{"frame_overlapped", frame_overlapped}})
    for (const PictureSize& size : {paper_picture, large_picture})
      for (bool coloured : {false, true}) {
        const std::string name =
            std::string(stage.name) + "/" + std::to_string(size.discs()) + (coloured ? "/colour" : "/gray");
        benchmark::RegisterBenchmark(name.c_str(), stage.run, size, coloured)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
      }
  return true;
}();

}  // namespace
}  // namespace talus::bench
