#include "render/png.h"

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <fmt/core.h>
#include <new>

#include "base/errors.h"
#include "base/output_file.h"

namespace talus::render {
namespace {

// Errors of libpng jump to the setjmp of the caller, and nothing is printed.
[[noreturn]] void abort_png(png_structp png, png_const_charp) { png_longjmp(png, 1); }
void ignore_warning(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, std::size_t size) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  try {
    bytes->insert(bytes->end(), data, data + size);
  } catch (const std::bad_alloc&) {  // exceptions must not propagate through the C code of libpng
    png_error(png, "out of memory");
  }
}

void no_flush(png_structp) {}

int colour_type(int channels) {
  return channels == 1 ? PNG_COLOR_TYPE_GRAY : channels == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA;
}

/// Rows are stored without a filter. Gray maps compress by runs only, and run-length encoding is fastest. In
/// colour, a run is a repeated pixel of several bytes, which only the search for matches finds.
void choose_compression(png_structp png, const Image& image) {
  constexpr int largest_memory_level = 9;
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 1);
  png_set_compression_mem_level(png, largest_memory_level);
  png_set_compression_strategy(png, image.channels == 1 ? Z_RLE : Z_DEFAULT_STRATEGY);
  png_set_compression_buffer_size(png, 1 << 16);
}

/// Returns false if libpng fails. The objects that its jump skips have no destructors.
bool encode(png_structp png, png_infop info, const Image& image, std::vector<png_text>& texts,
            double printed_width, std::vector<std::uint8_t>& bytes) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &bytes, append, no_flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               colour_type(image.channels), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  choose_compression(png, image);
  if (printed_width > 0.0) {
    const auto dots = static_cast<png_uint_32>(std::lround(image.width / printed_width));
    png_set_pHYs(png, info, dots, dots, PNG_RESOLUTION_METER);
  }
  if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(png, info);
  for (std::size_t row = 0; row < static_cast<std::size_t>(image.height); ++row)
    png_write_row(png, image.pixels.data() + row * image.row_bytes());
  png_write_end(png, info);
  return true;
}

void check(const Image& image) {
  if (image.width < 1 || image.height < 1 ||
      (image.channels != 1 && image.channels != 3 && image.channels != 4) ||
      image.pixels.size() != static_cast<std::size_t>(image.height) * image.row_bytes())
    throw Error(ExitCode::internal, "an image of {} x {} px with {} channels cannot be encoded as PNG",
                image.width, image.height, image.channels);
}

void check(const std::string& keyword, const std::string& text) {
  const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
  if (keyword.empty() || keyword.size() > 79 || !std::ranges::all_of(keyword, printable) ||
      !std::ranges::all_of(text, printable))
    throw Error(ExitCode::internal, "a PNG cannot hold the text \"{}\" as \"{}\"", text, keyword);
}

/// Converts texts to libpng's structures; libpng does not change them.
std::vector<png_text> texts_for_libpng(const PictureTexts& texts) {
  std::vector<png_text> result;
  for (const auto& [keyword, text] : texts) {
    check(keyword, text);
    png_text entry{};
    entry.compression = PNG_TEXT_COMPRESSION_NONE;
    entry.key = const_cast<char*>(keyword.c_str());
    entry.text = const_cast<char*>(text.c_str());
    entry.text_length = text.size();
    result.push_back(entry);
  }
  return result;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, const PictureTexts& texts, double printed_width) {
  check(image);
  std::vector<png_text> entries = texts_for_libpng(texts);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() / 2);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, abort_png, ignore_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool encoded = info && encode(png, info, image, entries, printed_width, bytes);
  png_destroy_write_struct(&png, &info);
  if (!encoded) throw std::bad_alloc();
  return bytes;
}

void write_png(const std::string& path, const Image& image, const PictureTexts& texts, double printed_width) {
  const std::vector<std::uint8_t> bytes = encode_png(image, texts, printed_width);
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace talus::render
