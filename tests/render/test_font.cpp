#include <gtest/gtest.h>

#include "base/errors.h"
#include "render/font.h"

namespace talus::render {
namespace {

TEST(Font, HasEveryListedCodePoint) {
  const Font font = embedded_font();
  for (char32_t code : font_code_points())
    EXPECT_NE(stbtt_FindGlyphIndex(&font.info, static_cast<int>(code)), 0)
        << "U+" << std::hex << unsigned(code);
}

TEST(Font, UnlistedCodePointIsNamedInTheError) {
  const Font font = embedded_font();
  try {
    set_text(font, "grain 粒", 12.0);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::internal);
    EXPECT_NE(std::string(error.what()).find("U+7C92"), std::string::npos) << error.what();
  }
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

}  // namespace
}  // namespace talus::render
