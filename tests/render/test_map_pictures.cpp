/// Every map as a picture, compared with one that was inspected by eye.

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "render/golden_picture.h"
#include "render/map_bed.h"
#include "render/renderer.h"

namespace talus::render {
namespace {

/// Lattice of 30 x 8 grains above a row of floor grains, with forces, spins and displacements that vary in
/// space.
struct Scene {
  test::Packing packing = test::triangular_lattice(30, 8, true);
  Frame before;
};

Scene make_scene() {
  Scene scene;
  test::Packing& packing = scene.packing;
  const Index free_count = packing.statics.free_count, columns = 30;
  Random random(7);
  const auto force = [&] { return random.uniform(0.1, 3.0); };
  for (Index i = 0; i < free_count; ++i) {
    const Index row = i / columns, column = i % columns;
    // One draw per statement, because the evaluation order of arguments depends on the compiler.
    if (column + 1 < columns) {
      const double tangential = 0.3 * force();
      test::add_contact(packing, i, i + 1, force(), tangential);
    }
    if (row + 1 < free_count / columns) {
      const double tangential = random.uniform(-0.5, 0.5);
      test::add_contact(packing, i, i + columns, force(), tangential);
    }
  }
  for (Index c = 0; c < packing.frame.contacts.count(); c += 4)
    packing.frame.contacts.status[c] = ContactStatus::sliding;
  for (Index column = 0; column < columns; ++column) test::add_floor_grain(packing, 0.5 + column, -0.5);
  test::complete(packing);
  test::moments_from_contacts(packing);
  test::gamma_from_moments(packing);
  scene.before = packing.frame;
  packing.frame.tilt = 0.2;
  packing.frame.step = scene.before.step + 100;
  for (Index i = 0; i < free_count; ++i) {
    const double x = packing.frame.x[i], y = packing.frame.y[i];
    packing.frame.x[i] += 0.02 * y * y * std::abs(std::sin(0.3 * x));
    packing.frame.angle[i] += 0.1 * y * std::sin(0.4 * x);
    packing.frame.vx[i] = 0.05 * y * y * (1.0 + 0.2 * std::sin(7.0 * x));
  }
  return scene;
}

TEST(MapPictures, LookAsBefore) {
  const Scene scene = make_scene();
  Renderer renderer(make_context(std::nullopt));
  std::vector<std::string> maps = {"gamma+forces", "pressure+overloaded", "clusters+displacement"};
  for (const pictures::MapKind kind : pictures::map_kinds()) maps.emplace_back(pictures::map_name(kind));
  for (const std::string& name : maps) {
    pictures::MapSettings settings = test::settings_of(name);
    settings.length = 5.0;
    settings.l_min = analysis::default_l_min;
    test::Packing packing = scene.packing;
    packing.frame = pictures::mapped_frame(packing.frame, packing.statics, settings.l_min);
    const FrameView view = test::map_of(packing, settings, &scene.before);
    test::expect_golden(renderer.draw(view, 500), "map_" + name);
  }
}

/// The comparison itself: what another version of Mesa may draw passes, what another position of a grain
/// draws does not.
TEST(MapPictures, AreOthersIfOneGrainIsDisplacedByHalfAPixel) {
  const Scene scene = make_scene();
  Renderer renderer(make_context(std::nullopt));
  const FrameView view = test::map_of(scene.packing, test::settings_of("gamma"), nullptr);
  constexpr int width = 500;
  const Image image = renderer.draw(view, width);
  EXPECT_EQ(test::difference_of(image, renderer.draw(view, width)).pixels, 0u);
  const auto half_pixel = static_cast<float>(0.5 * (view.x_max - view.x_min) / width);
  int displaced = 0;
  for (std::size_t k = 0; k < view.discs.size(); k += 7) {
    FrameView other = view;
    other.discs[k].x += half_pixel;
    const test::PictureDifference found = test::difference_of(image, renderer.draw(other, width));
    EXPECT_FALSE(test::is_rounding(found))
        << "grain " << k << ": " << found.pixels << " pixels, at most by " << found.largest;
    ++displaced;
  }
  EXPECT_GT(displaced, 30);
}

}  // namespace
}  // namespace talus::render
