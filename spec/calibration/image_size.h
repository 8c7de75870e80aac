// Width and height of images in pixels.
#pragma once

#include <string>

namespace throng::calibrate {

struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// Parses a size such as "640x480". Throws InputError naming `source`.
ImageSize parse_image_size(const std::string& text, const std::string& source);

}  // namespace throng::calibrate
