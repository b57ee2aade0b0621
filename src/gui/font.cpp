#include "gui/font.h"

#include <cmath>
#include <cstddef>

#include "gui/theme.h"
#include "render/embedded.h"

namespace talus::gui {
namespace {

/// First and last code points of each block, terminated by 0. ImGui reads them as long as the atlas exists.
constexpr ImWchar glyph_blocks[] = {0x0020, 0x007E,  // ASCII
                                    0x00A0, 0x00FF,  // Latin-1
                                    0x0391, 0x03C9,  // Greek
                                    0x2010, 0x2027,  // dashes, dots, ellipsis
                                    0x2070, 0x209C,  // superscripts and subscripts
                                    0x2113, 0x2113,  // script l
                                    0x2190, 0x2199,  // arrows
                                    0x2200, 0x2265,  // mathematical operators
                                    0x23CF, 0x23CF,  // eject
                                    0x25A0, 0x25FF,  // squares, triangles, circles
                                    0x2713, 0x2717,  // check marks, crosses
                                    0x27E8, 0x27E9,  // angle brackets
                                    0};

}  // namespace

void add_embedded_font(ImFontAtlas& atlas, float scale) {
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  // The interface takes a non-const pointer, but only reads.
  void* bytes = const_cast<unsigned char*>(embedded::font.data());
  for (const float size : type_scale)
    atlas.AddFontFromMemoryTTF(bytes, static_cast<int>(embedded::font.size()), std::round(size * scale),
                               &config, glyph_blocks);
  atlas.Build();
}

}  // namespace talus::gui
