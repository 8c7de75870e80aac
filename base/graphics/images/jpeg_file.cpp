#include "base/graphics/images/jpeg_file.h"

#include <fmt/core.h>

#include <utility>

#include "base/error.h"
#include "base/graphics/images/png_file.h"

namespace throng::images {

namespace {

const unsigned char* unsigned_bytes(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

}  // namespace

JpegFile::JpegFile(std::string_view bytes, std::string what)
    : bytes_(bytes), what_(std::move(what)), handle_(tjInitDecompress(), &tjDestroy) {
  if (!handle_) throw EnvironmentError("cannot start the JPEG decompressor: out of memory");
  int sampling = 0;
  int colors = 0;
  if (tjDecompressHeader3(handle_.get(), unsigned_bytes(bytes_), bytes_.size(), &width_, &height_,
                          &sampling, &colors) != 0) {
    refuse();
  }
  check_size(what_, width_, height_);
}

std::vector<std::uint8_t> JpegFile::decode(int pixel_format, bool strict) const {
  const auto bytes_per_pixel = static_cast<std::size_t>(tjPixelSize[pixel_format]);
  std::vector<std::uint8_t> pixels(bytes_per_pixel * static_cast<std::size_t>(width_) *
                                   static_cast<std::size_t>(height_));
  if (tjDecompress2(handle_.get(), unsigned_bytes(bytes_), bytes_.size(), pixels.data(), width_, 0,
                    height_, pixel_format, TJFLAG_ACCURATEDCT) != 0 &&
      (strict || tjGetErrorCode(handle_.get()) != TJERR_WARNING)) {
    refuse();
  }
  return pixels;
}

void JpegFile::refuse() const {
  throw InputError({what_, "", fmt::format("a damaged JPEG: {}", tjGetErrorStr2(handle_.get())),
                    "a whole JPEG image"});
}

}  // namespace throng::images
