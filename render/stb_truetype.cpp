/// The only translation unit with the implementation of stb. Dear ImGui also uses it, together with
/// stb_rect_pack; without that, stb_truetype would define an incompatible packer.
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
