#include "base/graphics/images/png_file.h"

#include <fmt/core.h>

#include <csetjmp>
#include <cstring>

#include "base/error.h"

namespace throng::images {

namespace {

void take_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source->bytes.size()) png_error(png, "cut off");
  std::memcpy(to, source->bytes.data(), count);
  source->bytes.remove_prefix(count);
}

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  static_cast<PngSource*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

// The largest image that is read, in pixels. Backs of medium format have 151 million.
constexpr std::int64_t kMaxPixels = 160'000'000;

// Nothing with a destructor may be made between setjmp and longjmp.
bool read_header(png_structp png, png_infop info, PngSize& size) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: how libpng fails
  png_read_info(png, info);
  size.width = png_get_image_width(png, info);
  size.height = png_get_image_height(png, info);
  return true;
}

}  // namespace

PngFile::PngFile(std::string_view bytes)
    : source{bytes, ""},
      png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, fail, ignore_warning)),
      info(png_create_info_struct(png)) {
  png_set_read_fn(png, &source, take_bytes);
}

PngSize read_png_header(PngFile& file, const std::string& what) {
  PngSize size;
  if (!read_header(file.png, file.info, size)) {
    throw InputError({what, "", "a damaged PNG: " + file.source.message, "a whole PNG"});
  }
  check_size(what, size.width, size.height);
  return size;
}

void check_size(const std::string& what, std::int64_t width, std::int64_t height) {
  if (width * height <= kMaxPixels) return;
  throw InputError({what, "", fmt::format("{} x {} pixels", width, height),
                    fmt::format("at most {} pixels", kMaxPixels)});
}

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG"); }

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }

}  // namespace throng::images
