// libjpeg-turbo's decoder for a file in memory, shared by the readers of this module.
#pragma once

#include <turbojpeg.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace throng::images {

/// A JPEG file in memory whose header has been read.
class JpegFile {
 public:
  /// Throws InputError with the name `what` if the header is damaged. The bytes must outlive this
  /// object.
  JpegFile(std::string_view bytes, std::string what);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Decodes all pixels, rows from the top. `pixel_format` is a TJPF_ constant. With `strict`,
  /// warnings of the decoder, e.g. of a truncated file, are InputErrors too.
  std::vector<std::uint8_t> decode(int pixel_format, bool strict) const;

 private:
  using Handle = std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)>;

  [[noreturn]] void refuse() const;

  std::string_view bytes_;
  std::string what_;
  Handle handle_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace throng::images
