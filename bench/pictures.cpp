#include "pictures.h"

#include <cmath>
#include <fstream>

#include "base/errors.h"
#include "core/random.h"
#include "render/colour.h"

namespace talus::bench {

render::FrameView picture(const PictureSize& size, bool coloured) {
  render::FrameView view;
  view.furniture = false;
  view.x_max = size.columns;
  view.y_max = 0.25 * size.columns;
  Random random(1);
  for (int row = 0; row < size.rows; ++row)
    for (int column = 0; column < size.columns; ++column) {
      render::Disc disc;
      disc.x = static_cast<float>(column + (row % 2 ? 0.75 : 0.25));
      disc.y = static_cast<float>(0.5 + row * std::sqrt(0.75));
      disc.radius = static_cast<float>(random.uniform(0.35, 0.5));
      disc.fill = render::colour_at(coloured ? render::ColourMap::viridis : render::ColourMap::gray,
                                    random.uniform());
      disc.rim = render::gray(0.6);
      view.discs.push_back(disc);
    }
  return view;
}

void write_discs(const std::string& path, const render::FrameView& view, int width) {
  const double scale = width / (view.x_max - view.x_min);
  std::ofstream file(path);
  file << "x,y,radius,fill_red,fill_green,fill_blue,rim_red,rim_green,rim_blue\n";
  for (const render::Disc& disc : view.discs) {
    file << scale * static_cast<double>(disc.x) << ',' << scale * static_cast<double>(disc.y) << ','
         << scale * static_cast<double>(disc.radius);
    for (const render::Colour& colour : {disc.fill, disc.rim})
      file << ',' << int{colour.red} << ',' << int{colour.green} << ',' << int{colour.blue};
    file << '\n';
  }
  file.close();
  if (!file) throw Error(ExitCode::cannot_create, path + ": cannot be written");
}

}  // namespace talus::bench
