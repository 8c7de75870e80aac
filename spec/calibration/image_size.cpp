#include "spec/calibration/image_size.h"

#include <fmt/core.h>

#include <charconv>
#include <string_view>

#include "base/error.h"

namespace throng::calibrate {

namespace {

constexpr int kMaxSide = 100000;

}  // namespace

ImageSize parse_image_size(const std::string& text, const std::string& source) {
  const std::size_t by = text.find('x');
  ImageSize size;
  const auto read = [](std::string_view word, int& value) {
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    return result.ec == std::errc() && result.ptr == word.data() + word.size() && value > 0 &&
           value <= kMaxSide;
  };
  if (by == std::string::npos || !read(std::string_view(text).substr(0, by), size.width) ||
      !read(std::string_view(text).substr(by + 1), size.height)) {
    throw InputError(
        Problem{source, "", fmt::format("\"{}\"", text), "WIDTHxHEIGHT in pixels, as 640x480"});
  }
  return size;
}

}  // namespace throng::calibrate
