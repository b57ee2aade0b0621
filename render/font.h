#pragma once
/// Text in pictures: the font, its metrics, and an atlas of its glyphs.

#include <stb/stb_truetype.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus::render {

/// The embedded font. It is a value type; the binary owns its bytes.
struct Font {
  stbtt_fontinfo info;
};
Font embedded_font();

/// Returns every code point that texts of pictures may use, in ascending order.
std::span<const char32_t> font_code_points();

/// Size of a subscript, and its offset below the base line, in units of the font size.
inline constexpr double subscript_size = 0.72;
inline constexpr double subscript_drop = 0.18;

/// Extent of a line above and below its base line, in units of the font size.
inline constexpr double text_ascent = 0.93;
inline constexpr double text_descent = 0.31;

/// A glyph of a line: its index in font_code_points(), and the distance of its origin from the start of the
/// line, px.
struct Glyph {
  std::size_t code = 0;
  bool subscript = false;
  double x = 0.0;
};

struct TextLine {
  std::vector<Glyph> glyphs;
  double width = 0.0;  ///< px
};

/// Sets a UTF-8 text in a font size of `em` px. "_c" sets c as a subscript. Throws Error(internal) at a code
/// point that is not in font_code_points(), and at malformed UTF-8.
TextLine set_text(const Font& font, std::string_view text, double em);

/// Whether set_text knows all letters of a text.
bool can_be_set(const Font& font, std::string_view text);

/// A part of a line in one font size, as documents write it.
struct TextRun {
  std::string text;  ///< UTF-8, without the subscript marks
  bool subscript = false;
  std::size_t first = 0, count = 0;  ///< its glyphs in the line
};
std::vector<TextRun> text_runs(std::string_view text);

/// Splits a text into the pieces between which a line may end. Pieces are words, but "l = 10 D" is one piece,
/// and "95 % of" is two.
std::vector<std::string> breakable_pieces(std::string_view text);

/// Breaks a text into lines, each with as many pieces as fit. A single piece may be wider.
std::vector<std::string> broken_lines(std::string_view text,
                                      const std::function<bool(const std::string& line)>& fits);

/// All listed glyphs, plain and as subscripts, drawn in one font size.
struct GlyphAtlas {
  double em = 0.0;  ///< px
  int size = 0;     ///< width and height, px
  std::vector<unsigned char> coverage;
  std::vector<stbtt_packedchar> plain, subscript;  ///< indexed as font_code_points()
};
GlyphAtlas bake_glyphs(double em);

}  // namespace talus::render
