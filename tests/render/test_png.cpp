/// Images, PNG files and the font. Contents of pictures as PDF and SVG. tests/python/test_vector_pictures.py
/// checks that they look like the PNG.

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/errors.h"
#include "render/document.h"
#include "render/font.h"
#include "render/image.h"
#include "render/movie.h"
#include "render/png.h"
#include "render/read_png.h"
#include "render/sample_view.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/resource_limit.h"
#include "support/temporary_folder.h"
#include "support/variable.h"

namespace talus::render {
namespace {

/// Returns a picture with runs of equal pixels, and pixels that all differ.
Image pattern(int width, int height, int channels = 1) {
  Image image{width, height, channels, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.pixels.push_back(static_cast<std::uint8_t>(y % 3 == 0 ? 40 * c : x * (7 + c) + y * y));
  return image;
}

ExitCode code_of_writing(const std::string& path, const Image& image, const PictureTexts& texts = {}) {
  return test::exit_code_of([&] { write_png(path, image, texts); });
}

class Png : public test::FolderTest {
 protected:
  const std::string path = folder.path("a.png");
};

TEST_F(Png, ReadsBackAsItWas) {
  for (int channels : {1, 3, 4})
    for (auto [width, height] : {std::pair{301, 77}, {1, 1}, {1, 40}, {5000, 3}}) {
      const Image image = pattern(width, height, channels);
      write_png(folder.path("a.png"), image, {{"Key", "a text"}});
      const Image back = test::read_png(folder.path("a.png"));
      EXPECT_EQ(back.width, image.width);
      EXPECT_EQ(back.height, image.height);
      EXPECT_EQ(back.channels, channels);
      EXPECT_EQ(back.pixels, image.pixels) << width << " x " << height << ", " << channels << " channels";
    }
}

TEST_F(Png, KeepsTexts) {
  const std::vector<std::uint8_t> png =
      encode_png(pattern(30, 20), {{"Key", "first"}, {"Keyword", "a=1 b=[2]"}});
  const std::string bytes(png.begin(), png.end());
  EXPECT_TRUE(
      test::has_all(bytes, {std::string("tEXtKey\0first", 13), std::string("tEXtKeyword\0a=1 b=[2]", 21)}));
}

TEST_F(Png, SaysHowWideItIsPrinted) {
  write_png(path, pattern(1016, 20), {{"Key", "text"}}, 0.086);
  EXPECT_EQ(test::read_png(path).pixels, pattern(1016, 20).pixels);
  const std::vector<std::uint8_t> plain = encode_png(pattern(1016, 20)),
                                  printed = encode_png(pattern(1016, 20), {}, 0.086);
  const std::string bytes(printed.begin(), printed.end());
  const std::string wanted = std::string("pHYs\0\0\x2E\x26\0\0\x2E\x26\1", 13);  // 11814 per metre
  EXPECT_TRUE(test::has(bytes, wanted));
  EXPECT_EQ(printed.size(), plain.size() + 21);
}

TEST_F(Png, RefusesWhatItCannotHold) {
  Image two = pattern(4, 4, 2), cut = pattern(4, 4);
  cut.pixels.pop_back();
  for (const Image& image : {two, cut, Image{}}) EXPECT_EQ(code_of_writing(path, image), ExitCode::internal);
  const std::string long_key(80, 'k');
  for (const auto& [key, text] : PictureTexts{{"", "a"}, {long_key, "a"}, {"k\n", "a"}, {"k", "\xCE\xB8"}})
    EXPECT_EQ(code_of_writing(path, pattern(4, 4), {{key, text}}), ExitCode::internal) << key;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(Png, SaysWhereItCannotBeCreated) {
  EXPECT_EQ(code_of_writing(folder.path("missing/a.png"), pattern(9, 9)), ExitCode::cannot_create);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(Png, LeavesNothingWhereWritingFails) {
  std::signal(SIGXFSZ, SIG_IGN);
  {
    const test::ResourceLimit limit(RLIMIT_FSIZE, 1000);
    EXPECT_EQ(code_of_writing(folder.path("a.png"), pattern(300, 300)), ExitCode::io_error);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(Png, KeepsTheOldFileWhereWritingFails) {
  write_png(path, pattern(20, 20));
  std::signal(SIGXFSZ, SIG_IGN);
  {
    const test::ResourceLimit limit(RLIMIT_FSIZE, 1000);
    EXPECT_EQ(code_of_writing(path, pattern(300, 300)), ExitCode::io_error);
  }
  EXPECT_EQ(test::read_png(path).width, 20);
}

TEST(Image, images_stand_beside_each_other_on_white_ground) {
  const Image a{1, 2, 1, {10, 20}}, b{2, 1, 1, {30, 40}};
  const Image row = side_by_side({a, b});
  EXPECT_EQ(row.width, 3);
  EXPECT_EQ(row.height, 2);
  EXPECT_EQ(row.pixels, (std::vector<std::uint8_t>{10, 30, 40, 20, 255, 255}));
}

TEST(Image, ground_is_clear_where_images_are) {
  const Image a{1, 1, 4, {1, 2, 3, 4}};
  const Image higher{1, 2, 4, {1, 2, 3, 4, 0, 0, 0, 0}};
  EXPECT_EQ(side_by_side({a, higher}).pixels,
            (std::vector<std::uint8_t>{1, 2, 3, 4, 1, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Image, channels_must_agree) {
  EXPECT_THROW(side_by_side({{1, 1, 1, {0}}, {1, 1, 3, {0, 0, 0}}}), Error);
}

TEST(Font, HasEveryListedCodePoint) {
  const Font font = embedded_font();
  for (char32_t code : font_code_points())
    EXPECT_NE(stbtt_FindGlyphIndex(&font.info, static_cast<int>(code)), 0)
        << "U+" << std::hex << unsigned(code);
}

TEST(Font, UnlistedCodePointIsNamedInTheError) {
  const Font font = embedded_font();
  EXPECT_TRUE(test::refuses([&] { set_text(font, "grain 粒", 12.0); }, ExitCode::internal, {"U+7C92"}));
}

TEST(Font, MalformedTextIsAnError) {
  const Font font = embedded_font();
  for (const char* text : {"\xCE", "\xB8", "\xCE\x28", "\xFF"})
    EXPECT_THROW(set_text(font, text, 12.0), Error);
}

TEST(Font, UnderscoreSetsOneSubscript) {
  const Font font = embedded_font();
  const TextLine line = set_text(font, "θ_cc", 20.0);
  ASSERT_EQ(line.glyphs.size(), 3u);
  EXPECT_FALSE(line.glyphs[0].subscript);
  EXPECT_TRUE(line.glyphs[1].subscript);
  EXPECT_FALSE(line.glyphs[2].subscript);
  const double plain = set_text(font, "c", 20.0).width;
  EXPECT_NEAR(line.width, set_text(font, "θ", 20.0).width + (1.0 + subscript_size) * plain, 1e-9);
}

TEST(Font, AtlasHoldsAllGlyphsAtAllSizes) {
  for (double em : {6.0, 18.0, 44.0, 180.0}) {
    const GlyphAtlas atlas = bake_glyphs(em);
    EXPECT_EQ(atlas.plain.size(), font_code_points().size());
    EXPECT_EQ(atlas.subscript.size(), font_code_points().size());
  }
}

TEST(Font, NumbersKeepTheirUnitsWhenALineIsBroken) {
  EXPECT_EQ(breakable_pieces("ratio of grains, l = 10 D; 95 % of all"),
            (std::vector<std::string>{"ratio", "of", "grains,", "l = 10 D;", "95 %", "of", "all"}));
  EXPECT_EQ(breakable_pieces("at most 6.7 D"), (std::vector<std::string>{"at", "most", "6.7 D"}));
  EXPECT_TRUE(breakable_pieces("").empty());
}

/// Returns a frame of one colour that becomes lighter with k.
Image frame(int width, int height, int channels, int k) {
  Image image{width, height, channels, {}};
  for (int pixel = 0; pixel < width * height; ++pixel)
    for (int c = 0; c < channels; ++c) image.pixels.push_back(static_cast<std::uint8_t>(40 * c + 10 * k));
  return image;
}

void make_movie(const std::string& path, int frames, int channels = 1) {
  Movie movie(path, 161, 99, channels, 10.0);
  for (int k = 0; k < frames; ++k) movie.add(frame(161, 99, channels, k));
  movie.finish();
}

std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output.push_back(static_cast<char>(c));
  pclose(pipe);
  return output;
}

/// Writes a program called ffmpeg that executes the shell script.
void write_false_ffmpeg(const std::string& path, const std::string& script) {
  std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
}

test::Refusal failure_of_movie(const std::string& path, int frames) {
  return test::refusal_of([&] { make_movie(path, frames); });
}

bool have_ffmpeg() {
  return std::system("ffmpeg -version >/dev/null 2>&1") == 0 &&
         std::system("ffprobe -version >/dev/null 2>&1") == 0;
}

TEST(Movie, HasAllFramesInTheirColours) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg or ffprobe is not installed";
  const test::TemporaryFolder folder;
  for (int channels : {1, 3})
    for (auto [name, size] :
         {std::pair{"a.mp4", "162,100,12"}, {"a.webm", "161,99,12"}, {"a.gif", "161,99,12"}}) {
      const std::string path = folder.path(name);
      make_movie(path, 12, channels);
      EXPECT_EQ(output_of("ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames "
                          "-of csv=p=0 " +
                          path),
                std::string(size) + "\n")
          << name << ", " << channels << " channels";
      const std::string pixel =
          output_of("ffmpeg -v error -i " + path +
                    " -vf 'select=eq(n\\,11),crop=2:2:80:50' -frames:v 1 -f rawvideo -pix_fmt rgb24 -");
      ASSERT_EQ(pixel.size(), 12u) << name;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<std::uint8_t>(pixel[static_cast<std::size_t>(c)]),
                    110 + (channels == 3 ? 40 * c : 0), 4)
            << name << ", " << channels << " channels";
    }
}

TEST(Movie, SaysThatFfmpegIsMissing) {
  const test::TemporaryFolder folder;
  const test::Variable nowhere("PATH", folder.path("bin"));
  const test::Refusal failure = failure_of_movie(folder.path("a.mp4"), 1);
  EXPECT_EQ(failure.code, ExitCode::unavailable);
  EXPECT_TRUE(test::has(failure.message, "apt-get install ffmpeg"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Movie, ReportsWhatFfmpegSaysAndLeavesNothing) {
  const test::TemporaryFolder folder, tools;
  const test::Variable here("PATH", tools.path("") + ":/usr/bin:/bin");
  // One reads everything and fails at its end, and one exits at once while frames are still written.
  for (const char* script :
       {"cat >/dev/null; echo encoder on strike >&2; exit 1", "echo encoder on strike >&2; exit 1"}) {
    write_false_ffmpeg(tools.path("ffmpeg"), script);
    const test::Refusal failure = failure_of_movie(folder.path("a.mp4"), 200);
    EXPECT_EQ(failure.code, ExitCode::io_error);
    EXPECT_TRUE(test::has(failure.message, "encoder on strike"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST(Movie, LeavesNothingWhenGivenUp) {
  const test::TemporaryFolder folder, tools;
  const test::Variable here("PATH", tools.path("") + ":/usr/bin:/bin");
  write_false_ffmpeg(tools.path("ffmpeg"), "exec cat >/dev/null");
  { Movie movie(folder.path("a.mp4"), 161, 99, 1, 10.0); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Movie, RefusesOtherFormatsAndSizes) {
  const test::TemporaryFolder folder, tools;
  const test::Refusal other = failure_of_movie(folder.path("a.avi"), 1);
  EXPECT_EQ(other.code, ExitCode::usage);
  EXPECT_TRUE(test::has_all(other.message, {".mp4", ".webm", ".gif"}));
  EXPECT_EQ(failure_of_movie(folder.path("missing/a.mp4"), 1).code, ExitCode::cannot_create);
  const auto transparent = [&] { const Movie movie(folder.path("a.webm"), 160, 100, 4, 10.0); };
  EXPECT_TRUE(test::refuses(transparent, ExitCode::usage, {"transparent"}));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const test::Variable here("PATH", tools.path("") + ":/usr/bin:/bin");
  write_false_ffmpeg(tools.path("ffmpeg"), "exec cat >/dev/null");
  Movie movie(folder.path("a.mp4"), 161, 99, 1, 10.0);
  EXPECT_THROW(movie.add(frame(161, 98, 1, 0)), Error);
  EXPECT_THROW(movie.add(frame(161, 99, 3, 0)), Error);
}

const PictureTexts texts = {{"Software", "talus 0.1.0 (2ace854d)"}, {"Source", "a.h5, gamma"}};

std::string drawn(DocumentTarget& target, const FrameView& view, int width) {
  paint(target, sheet_of(view, width, embedded_font()));
  return target.end();
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
  EXPECT_TRUE(test::has(drawn(*make_pdf_target(0.086, texts), lined_view(), 800), "/CreationDate (20000101"))
      << "not the current time";
}

TEST(Document, ASvgHasDiscsLinesAndTextsAsWhatTheyAre) {
  const FrameView view = lined_view();
  const std::string svg = drawn(*make_svg_target(0.178, texts), view, 800);
  EXPECT_EQ(test::count_of(svg, "<circle"), view.discs.size());
  EXPECT_EQ(test::count_of(svg, "#c80000"), 1u) << "the line, in its colour";
  EXPECT_TRUE(test::has_all(svg, {">Stress ratio γ of each grain</tspan>", "width=\"178.0000mm\""}));
  EXPECT_EQ(test::count_of(svg, "<g"), test::count_of(svg, "</g>"));
  FrameView odd = view;
  odd.title = "a < b ]]> & c_d";
  EXPECT_TRUE(test::has_all(drawn(*make_svg_target(0.178, {}), odd, 800),
                            {">a &lt; b ]]&gt; &amp; c</tspan>", ">d</tspan>"}));
}

TEST(Document, ATransparentPictureHasNoGround) {
  FrameView view = test::sample_view();
  const std::string opaque = drawn(*make_svg_target(0.178, texts), view, 800);
  view.transparent = true;
  const std::string clear = drawn(*make_svg_target(0.178, texts), view, 800);
  EXPECT_EQ(test::count_of(opaque, "fill=\"#fff\""), 1u);
  EXPECT_EQ(test::count_of(clear, "fill=\"#fff\""), 0u);
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
    EXPECT_TRUE(test::has(drawn(*target, test::sample_view(), 400), "Source=a.h5, gamma"));
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
