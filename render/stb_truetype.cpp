/// The one place where the code of stb is compiled. Dear ImGui uses it from here as well, with
/// stb_rect_pack; without that, stb_truetype would bring an incompatible packer of its own.
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
