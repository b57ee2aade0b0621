#include "render/png.h"

#include <png.h>
#include <zlib.h>

#include <csetjmp>
#include <new>

#include "core/errors.h"
#include "render/output_file.h"

namespace talus {
namespace {

void append(png_structp png, png_bytep data, std::size_t size) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  try {
    bytes->insert(bytes->end(), data, data + size);
  } catch (const std::bad_alloc&) {  // no exception may pass through the C code of libpng
    png_error(png, "out of memory");
  }
}

void no_flush(png_structp) {}

/// Returns false where libpng gives up: on jumping back, nothing here has a destructor.
bool encode(png_structp png, png_infop info, const Image& image, std::vector<std::uint8_t>& bytes) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &bytes, append, no_flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_compression_level(png, 1);
  png_set_compression_strategy(png, Z_RLE);
  png_write_info(png, info);
  for (int row = 0; row < image.height; ++row)
    png_write_row(png,
                  image.gray.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width));
  png_write_end(png, info);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.gray.size() / 2);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool encoded = info && encode(png, info, image, bytes);
  png_destroy_write_struct(&png, &info);
  if (!encoded) throw std::bad_alloc();
  return bytes;
}

void write_png(const std::string& path, const Image& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image);
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace talus
