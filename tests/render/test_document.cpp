/// Contents of pictures as PDF and SVG. tests/python/test_vector_pictures.py checks that they look like the
/// PNG.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>

#include "base/errors.h"
#include "render/document.h"
#include "render/sample_view.h"
#include "support/temporary_folder.h"

namespace talus::render {
namespace {

const PictureTexts texts = {{"Software", "talus 0.1.0 (2ace854d)"}, {"Source", "a.h5, gamma"}};

std::string drawn(DocumentTarget& target, const FrameView& view, int width) {
  paint(target, sheet_of(view, width, embedded_font()));
  return target.end();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

FrameView lined_view() {
  FrameView view = test::sample_view();
  view.lines.push_back({0.1f, 0.0f, 0.2f, 0.05f, 0.001f, {200, 0, 0, 255}});
  view.discs.front().hatched = 1.0f;
  return view;
}

TEST(Document, TheSamePictureGivesTheSameBytes) {
  for (auto* make : {make_pdf_target, make_svg_target}) {
    const std::unique_ptr<DocumentTarget> target = make(0.086, texts);
    const std::string first = drawn(*target, lined_view(), 800);
    EXPECT_EQ(drawn(*target, lined_view(), 800), first) << "from the same target";
    EXPECT_EQ(drawn(*make(0.086, texts), lined_view(), 800), first);
    EXPECT_NE(drawn(*make(0.178, texts), lined_view(), 800), first);
  }
  const std::string pdf = drawn(*make_pdf_target(0.086, texts), lined_view(), 800);
  EXPECT_NE(pdf.find("/CreationDate (20000101"), std::string::npos) << "not the current time";
}

TEST(Document, ASvgHasDiscsLinesAndTextsAsWhatTheyAre) {
  const FrameView view = lined_view();
  const std::string svg = drawn(*make_svg_target(0.178, texts), view, 800);
  EXPECT_EQ(count(svg, "<circle"), view.discs.size());
  EXPECT_EQ(count(svg, "#c80000"), 1u) << "the line, in its colour";
  EXPECT_NE(svg.find(">Stress ratio γ of each grain</tspan>"), std::string::npos);
  EXPECT_NE(svg.find("width=\"178.0000mm\""), std::string::npos);
  EXPECT_EQ(count(svg, "<g"), count(svg, "</g>"));
  FrameView odd = view;
  odd.title = "a < b ]]> & c_d";
  const std::string escaped = drawn(*make_svg_target(0.178, {}), odd, 800);
  EXPECT_NE(escaped.find(">a &lt; b ]]&gt; &amp; c</tspan>"), std::string::npos);
  EXPECT_NE(escaped.find(">d</tspan>"), std::string::npos);
}

TEST(Document, ATransparentPictureHasNoGround) {
  FrameView view = test::sample_view();
  const std::string opaque = drawn(*make_svg_target(0.178, texts), view, 800);
  view.transparent = true;
  const std::string clear = drawn(*make_svg_target(0.178, texts), view, 800);
  EXPECT_EQ(count(opaque, "fill=\"#fff\""), 1u);
  EXPECT_EQ(count(clear, "fill=\"#fff\""), 0u);
}

TEST(Document, OfEightThousandGrainsHasLessThanTwoMegabytes) {
  FrameView view = test::sample_view(200, 40);
  for (int k = 0; k < 16000; ++k) {
    const int row = k / 400;
    const float x = 0.01f * static_cast<float>(k % 200), y = 0.01f * static_cast<float>(row);
    view.lines.push_back({x, y, x + 0.01f, y + 0.003f, 1e-6f * static_cast<float>(k), {255, 60, 130, 255}});
  }
  const std::string pdf = drawn(*make_pdf_target(0.178, texts), view, 1600);
  const std::string svg = drawn(*make_svg_target(0.178, texts), view, 1600);
  EXPECT_LT(pdf.size(), 2'000'000u);
  EXPECT_LT(svg.size(), 2'000'000u);
}

TEST(Document, SaysWhatItWasMadeFrom) {
  for (const auto& target : {make_pdf_target(0.178, texts), make_svg_target(0.178, texts)}) {
    const std::string text = drawn(*target, test::sample_view(), 400);
    EXPECT_NE(text.find("Source=a.h5, gamma"), std::string::npos);
  }
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_document(folder.path("none/a.pdf"), sheet_of(test::sample_view(), 400, embedded_font()),
                              0.178, texts),
               Error);
}

TEST(Hatching, LiesInTheDiscAndGoesOnInItsNeighbour) {
  const Point centre{100.3, 57.1};
  const double radius = 12.0, period = 0.8 * radius;
  const Hatching lines = hatching(centre, radius);
  ASSERT_GE(lines.lines.size(), 2u);
  for (const auto& [from, to] : lines.lines) {
    for (const Point& end : {from, to})
      EXPECT_NEAR(std::hypot(end.x - centre.x, end.y - centre.y), radius - rim_width(radius), 1e-9);
    const double place = (from.x + from.y) / std::sqrt(2.0) / period;
    EXPECT_NEAR(place - std::floor(place), 0.5, 1e-9) << "the same lines in all discs of this size";
    EXPECT_NEAR(from.x + from.y, to.x + to.y, 1e-9);
  }
}

}  // namespace
}  // namespace talus::render
