#pragma once
/// Error handlers for libpng: errors jump to the setjmp of the caller, and nothing is printed.

#include <png.h>

namespace talus::render {

[[noreturn]] inline void abort_png(png_structp png, png_const_charp) { png_longjmp(png, 1); }
inline void ignore_warning(png_structp, png_const_charp) {}

}  // namespace talus::render
