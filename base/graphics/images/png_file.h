// libpng's decoder for a file in memory, shared by the readers of this module.
#pragma once

#include <png.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace throng::images {

/// The bytes that libpng has not read yet, and its error message.
struct PngSource {
  std::string_view bytes;
  std::string message;
};

/// A PNG file being read. libpng's errors jump to setjmp(png_jmpbuf(png)); no object with a
/// destructor may be created between that call and the error.
struct PngFile {
  explicit PngFile(std::string_view bytes);
  ~PngFile() { png_destroy_read_struct(&png, &info, nullptr); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  PngSource source;
  png_structp png;
  png_infop info;
};

/// Width and height in pixels.
struct PngSize {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
};
/// Reads the header. Throws InputError with the name `what` for a damaged header or an image above
/// the max size.
PngSize read_png_header(PngFile& file, const std::string& what);

/// Throws InputError with the name `what` for images above the max size for decoding, because small
/// files may have huge images.
void check_size(const std::string& what, std::int64_t width, std::int64_t height);

/// Whether the first bytes are those of a PNG or JPEG file.
bool is_png(std::string_view bytes);
bool is_jpeg(std::string_view bytes);

}  // namespace throng::images
