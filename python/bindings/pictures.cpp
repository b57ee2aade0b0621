#include "pictures.h"

#include <pybind11/stl.h>

#include <algorithm>

#include "analysis/frame_quantities.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "interpreter.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "pictures/map_kind.h"
#include "pictures/map_options.h"
#include "pictures/maps.h"
#include "pictures/panel.h"
#include "pictures/run_movie.h"
#include "render/png.h"
#include "render/renderer.h"

namespace py = pybind11;

namespace talus {

py::array pixels(const render::Image& image) {
  py::array_t<std::uint8_t> array({image.height, image.width, 4});
  std::uint8_t* to = array.mutable_data();
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t k = 0; k < image.pixels.size(); k += channels, to += 4) {
    for (std::size_t c = 0; c < 3; ++c) to[c] = image.pixels[k + (channels == 1 ? 0 : c)];
    to[3] = channels == 4 ? image.pixels[k + 3] : 255;
  }
  return array;
}

namespace {

using Maps = std::vector<std::vector<render::FrameView>>;

py::bytes png_of(const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>& array) {
  if (array.ndim() != 3 || array.shape(2) != 4)
    throw Error(ExitCode::usage, "a picture: expected an array (h, w, 4)");
  render::Image image{static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)), 4, {}};
  image.pixels.assign(array.data(), array.data() + array.size());
  const std::vector<std::uint8_t> bytes = render::encode_png(image);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

render::Image panel(const Maps& rows, const std::string& title, int width) {
  render::Renderer renderer(render::make_context());
  return renderer.draw(pictures::panel_sheet(rows, title, width, render::largest_side, renderer.font()));
}

/// Shows the same part of the plane in all pictures, with room for the turns of all.
void level(Maps& pictures) {
  double y_min = 0.0, y_max = 0.0, turn_max = 0.0;
  for (const std::vector<render::FrameView>& maps : pictures)
    for (const render::FrameView& map : maps) {
      y_min = std::min(y_min, map.y_min);
      y_max = std::max(y_max, map.y_max);
      turn_max = std::max(turn_max, map.turn_max);
    }
  for (std::vector<render::FrameView>& maps : pictures)
    for (render::FrameView& map : maps) {
      map.y_min = y_min;
      map.y_max = y_max;
      map.turn_max = turn_max;
    }
}

void animate(const std::string& path, Maps pictures, int width, int height, double fps) {
  level(pictures);
  std::ranges::for_each(pictures, pictures::share_row);
  std::vector<pictures::MovieFrame> frames(pictures.size());
  for (std::size_t k = 0; k < frames.size(); ++k) frames[k].frame = k;
  Watch watch;
  watch.stopped = [] {
    const py::gil_scoped_acquire hold;
    raise_if_interrupted();
    return false;
  };
  render::Renderer renderer(render::make_context());
  pictures::write_movie(
      renderer, path, frames, [&](std::size_t k) { return pictures[k]; }, width, height, fps, watch);
}

/// Binds the options of maps.
void bind_options(py::module_& module) {
  py::class_<pictures::MapOptions>(module, "MapOptions")
      .def(py::init())
      .def_readwrite("width", &pictures::MapOptions::width)
      .def_readwrite("theta_c", &pictures::MapOptions::theta_c)
      .def_readwrite("colours", &pictures::MapOptions::colours)
      .def_readwrite("l_min", &pictures::MapOptions::l_min)
      .def_readwrite("length", &pictures::MapOptions::length)
      .def_readwrite("threshold", &pictures::MapOptions::threshold)
      .def_readwrite("range", &pictures::MapOptions::range)
      .def_readwrite("turned", &pictures::MapOptions::turned)
      .def_readwrite("bare", &pictures::MapOptions::bare);
}

/// Returns the names of the maps and the columns of Talus, which values of a script cannot have.
std::vector<std::string> names_of_talus() {
  std::vector<std::string> names = {"frame"};
  for (const pictures::MapKind kind : pictures::map_kinds()) names.emplace_back(pictures::map_name(kind));
  for (const auto table : {analysis::grain_quantities(), analysis::contact_quantities()})
    for (const analysis::FrameQuantity& quantity : table) {
      names.emplace_back(quantity.name);
      const std::vector<std::string> columns = analysis::component_names(quantity);
      names.insert(names.end(), columns.begin(), columns.end());
    }
  return names;
}

/// Stores a quantity with a run.
void store(const std::string& path, const OwnQuantity& own) {
  pictures::check_text("label", own.label);
  pictures::check_text("unit", own.unit);
  if (const std::string reason = protection_of(path); !reason.empty())
    throw Error(ExitCode::cannot_create, "{}: {}", path, reason);
  const io::RunFile run = io::RunFile::open(path);
  io::store_own(path, own, hash_text(state_hash(run.checkpoint().world)));
}

}  // namespace

void bind_pictures(py::module_& module) {
  bind_options(module);
  py::class_<OwnQuantity>(module, "OwnQuantity")
      .def(py::init([](const std::vector<double>& values, const std::string& kind, const std::string& label,
                       const std::string& unit, const std::string& name, bool of_grains) {
        using Kind = OwnQuantity::Kind;
        const Kind of = kind == "flag" ? Kind::flag : kind == "cluster" ? Kind::cluster : Kind::number;
        return OwnQuantity{values, of, label, unit, name, of_grains};
      }));
  py::class_<render::FrameView>(module, "Map");
  module.def("_names_of_talus", &names_of_talus);
  module.def("_store", [](const std::string& path, const OwnQuantity& own) {
    require_files();
    without_interpreter([&] { store(path, own); });
  });
  module.def("_png", &png_of);
  module.def("_panel", [](const Maps& rows, const std::string& title, int width) {
    pictures::check_text("title", title);
    return pixels(
        while_drawing([&] { return without_interpreter([&] { return panel(rows, title, width); }); }));
  });
  module.def(
      "_animate", [](const std::string& path, const Maps& pictures, int width, int height, double fps) {
        const AttentiveCall call;
        while_drawing([&] { without_interpreter([&] { animate(path, pictures, width, height, fps); }); });
      });
}

}  // namespace talus
