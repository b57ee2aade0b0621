#include "render/font.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fmt/core.h>
#include <string>

#include "base/errors.h"
#include "render/embedded.h"

namespace talus::render {
namespace {

/// Code points in addition to the letters of ASCII and Latin-1, which names may contain.
constexpr auto special_code_points =
    std::to_array<char32_t>({U'°', U'±', U'²', U'³', U'·', U'¹', U'Γ', U'Δ', U'Σ', U'α', U'γ', U'η', U'θ',
                             U'μ', U'ν', U'ρ', U'σ', U'τ', U'φ', U'–', U'…', U'⁰', U'⁴', U'⁵', U'⁶', U'⁷',
                             U'⁸', U'⁹', U'⁻', U'ℓ', U'→', U'−', U'√', U'≈', U'≤', U'≥', U'⟨', U'⟩'});
constexpr char32_t first_ascii = 32, last_ascii = 126, first_latin = 0xC0, last_latin = 0xFF;
constexpr std::size_t ascii_count = last_ascii - first_ascii + 1, latin_count = last_latin - first_latin + 1;

constexpr auto code_points = [] {
  std::array<char32_t, ascii_count + latin_count + special_code_points.size()> all{};
  auto* next = all.begin();
  for (char32_t code = first_ascii; code <= last_ascii; ++code) *next++ = code;
  for (char32_t code = first_latin; code <= last_latin; ++code) *next++ = code;
  std::copy(special_code_points.begin(), special_code_points.end(), next);
  std::sort(all.begin(), all.end());
  return all;
}();
static_assert(std::is_sorted(code_points.begin(), code_points.end()));

[[noreturn]] void malformed(std::string_view text) {
  throw Error(ExitCode::internal, "the text '{}' in a picture is not valid UTF-8", text);
}

/// Returns the code point that begins at `position`, and moves `position` past it.
char32_t next_code_point(std::string_view text, std::size_t& position) {
  const auto lead = static_cast<unsigned char>(text[position++]);
  if (lead < 0x80) return lead;
  const int trailing = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
  if (lead < 0xC0 || lead > 0xF7 || position + static_cast<std::size_t>(trailing) > text.size())
    malformed(text);
  char32_t code = lead & (0x3F >> trailing);
  for (int k = 0; k < trailing; ++k) {
    const auto byte = static_cast<unsigned char>(text[position++]);
    if ((byte & 0xC0) != 0x80) malformed(text);
    code = (code << 6) | (byte & 0x3F);
  }
  return code;
}

std::size_t place_of(char32_t code, std::string_view text) {
  const auto found = std::lower_bound(code_points.begin(), code_points.end(), code);
  if (found != code_points.end() && *found == code)
    return static_cast<std::size_t>(found - code_points.begin());
  throw Error(ExitCode::internal,
              "U+{:04X} in the text '{}' in a picture is not among the glyphs listed in render/font.cpp",
              static_cast<unsigned>(code), text);
}

bool pack(GlyphAtlas& atlas) {
  atlas.coverage.assign(static_cast<std::size_t>(atlas.size) * static_cast<std::size_t>(atlas.size), 0);
  std::array<int, code_points.size()> codes{};
  std::copy(code_points.begin(), code_points.end(), codes.begin());
  const auto range = [&](double em, std::vector<stbtt_packedchar>& glyphs) {
    glyphs.resize(codes.size());
    stbtt_pack_range result{};
    result.font_size = STBTT_POINT_SIZE(static_cast<float>(em));
    result.array_of_unicode_codepoints = codes.data();
    result.num_chars = static_cast<int>(codes.size());
    result.chardata_for_range = glyphs.data();
    return result;
  };
  std::array<stbtt_pack_range, 2> ranges = {range(atlas.em, atlas.plain),
                                            range(subscript_size * atlas.em, atlas.subscript)};
  stbtt_pack_context context;
  if (!stbtt_PackBegin(&context, atlas.coverage.data(), atlas.size, atlas.size, 0, 1, nullptr))
    throw std::bad_alloc();
  stbtt_PackSetOversampling(&context, 2, 1);  // glyphs lie at fractional pixels along the line
  const int packed = stbtt_PackFontRanges(&context, embedded::font.data(), 0, ranges.data(), 2);
  stbtt_PackEnd(&context);
  return packed != 0;
}

}  // namespace

Font embedded_font() {
  Font font;
  if (!stbtt_InitFont(&font.info, embedded::font.data(), 0))
    throw Error(ExitCode::internal, "the embedded font cannot be read");
  return font;
}

std::span<const char32_t> font_code_points() { return code_points; }

TextLine set_text(const Font& font, std::string_view text, double em) {
  const double unit = static_cast<double>(stbtt_ScaleForMappingEmToPixels(&font.info, 1.0f));
  TextLine line;
  bool subscript = false;
  for (std::size_t position = 0; position < text.size();) {
    const char32_t code = next_code_point(text, position);
    if (code == U'_' && !subscript) {
      subscript = true;
      continue;
    }
    line.glyphs.push_back({place_of(code, text), subscript, line.width});
    int advance = 0;
    stbtt_GetCodepointHMetrics(&font.info, static_cast<int>(code), &advance, nullptr);
    line.width += advance * unit * em * (subscript ? subscript_size : 1.0);
    subscript = false;
  }
  return line;
}

bool can_be_set(const Font& font, std::string_view text) {
  try {
    set_text(font, text, 1.0);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::vector<TextRun> text_runs(std::string_view text) {
  std::vector<TextRun> runs;
  std::size_t count = 0;
  bool subscript = false;
  for (std::size_t position = 0; position < text.size();) {
    const std::size_t start = position;
    if (next_code_point(text, position) == U'_' && !subscript) {
      subscript = true;
      continue;
    }
    if (runs.empty() || runs.back().subscript != subscript) runs.push_back({{}, subscript, count, 0});
    runs.back().text += text.substr(start, position - start);
    ++runs.back().count;
    ++count;
    subscript = false;
  }
  return runs;
}

std::vector<std::string> breakable_pieces(std::string_view text) {
  static constexpr std::array<std::string_view, 8> between = {"=", "≥", "≤", "<", ">", "×", "−", "/"};
  static constexpr std::array<std::string_view, 5> after = {"D", "D,", "D;", "%", "deg"};
  constexpr std::size_t longest = 14;  // bytes; longer equations may be broken
  const auto is_one_of = [](const auto& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
  };
  std::vector<std::string> pieces;
  bool joined = false;  // the previous word must not be separated from this one
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string_view word = text.substr(start, end - start);
    const bool operation = is_one_of(between, word);
    const bool is_short = !pieces.empty() && pieces.back().size() + word.size() < longest;
    if (is_short && (joined || operation || is_one_of(after, word)))
      pieces.back().append(" ").append(word);
    else
      pieces.emplace_back(word);
    joined = operation;
    start = end + 1;
  }
  return pieces;
}

std::vector<std::string> broken_lines(std::string_view text,
                                      const std::function<bool(const std::string& line)>& fits) {
  std::vector<std::string> lines;
  for (const std::string& piece : breakable_pieces(text))
    if (!lines.empty() && fits(lines.back() + " " + piece))
      lines.back() += " " + piece;
    else
      lines.push_back(piece);
  return lines;
}

GlyphAtlas bake_glyphs(double em) {
  GlyphAtlas atlas;
  atlas.em = em;
  constexpr int largest = 8192;
  for (atlas.size = 256; atlas.size <= largest; atlas.size *= 2)
    if (pack(atlas)) return atlas;
  throw Error(ExitCode::internal, "no glyph atlas holds a font of {:g} px", em);
}

}  // namespace talus::render
