#pragma once
/// How libpng's errors reach us: it jumps back to setjmp, and prints nothing.

#include <png.h>

namespace talus::render {

[[noreturn]] inline void give_up(png_structp png, png_const_charp) { png_longjmp(png, 1); }
inline void say_nothing(png_structp, png_const_charp) {}

}  // namespace talus::render
