#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "render/png.h"
#include "render/png_errors.h"

namespace talus::render {
namespace {

/// Reads a picture row by row. Returns false if libpng finds it damaged. The objects that its jump skips have
/// no destructors.
bool read_all(png_structp png, png_infop info, std::FILE* file, std::vector<png_byte>& row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_init_io(png, file);
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_read_info(png, info);
  row.resize(png_get_rowbytes(png, info));
  for (int pass = png_set_interlace_handling(png); pass > 0; --pass)
    for (png_uint_32 k = png_get_image_height(png, info); k > 0; --k) png_read_row(png, row.data(), nullptr);
  png_read_end(png, info);
  return true;
}

std::optional<std::string> first_text(png_structp png, png_infop info, const std::string& keyword) {
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(png, info, &texts, &count);
  for (int k = 0; k < count; ++k)
    if (keyword == texts[k].key) return texts[k].text;
  return std::nullopt;
}

}  // namespace

std::optional<std::string> png_text(const std::string& path, const std::string& keyword) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return std::nullopt;  // reading a pipe would block
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) return std::nullopt;
  std::vector<png_byte> row;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, abort_png, ignore_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  std::optional<std::string> text;
  if (info && read_all(png, info, file.get(), row)) text = first_text(png, info, keyword);
  png_destroy_read_struct(&png, &info, nullptr);
  return text;
}

}  // namespace talus::render
