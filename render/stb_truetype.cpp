/// The one place where the code of stb is compiled. Dear ImGui takes it from here as well, and packs with
/// stb_rect_pack: without it stb_truetype would bring a packer of its own that is not compatible.
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
