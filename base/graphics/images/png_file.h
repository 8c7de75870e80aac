// libpng's objects for one file in memory, shared by the readers of this module.
#pragma once

#include <png.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace throng::images {

/// Bytes that are still to be read, and the message when libpng fails.
struct PngSource {
  std::string_view bytes;
  std::string message;
};

/// A file that is being read. Errors jump to where setjmp(png_jmpbuf(png)) was called; nothing with
/// a destructor may be made in between.
struct PngFile {
  explicit PngFile(std::string_view bytes);
  ~PngFile() { png_destroy_read_struct(&png, &info, nullptr); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  PngSource source;
  png_structp png;
  png_infop info;
};

/// The width and height in pixels, without decoding. Throws InputError naming `what` for a damaged
/// header and for more pixels than are decoded.
struct PngSize {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
};
PngSize read_png_header(PngFile& file, const std::string& what);

/// Refuses images above the largest size that is decoded: limits what a small file unpacks to.
void check_size(const std::string& what, std::int64_t width, std::int64_t height);

/// Whether the first bytes are those of a PNG or a JPEG file.
bool is_png(std::string_view bytes);
bool is_jpeg(std::string_view bytes);

}  // namespace throng::images
