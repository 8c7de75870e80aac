// Small RGBA images: PNG in and out, resizing, and filling what is not covered.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace throng::skinning {

/// 8-bit sRGB color with alpha, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * h * 4) {}
  std::uint8_t* pixel(int x, int y) {
    return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
  }
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
  }
};

/// Mask of the pixels in use; row-major, one entry per pixel.
using Mask = std::vector<std::uint8_t>;

/// Throws InputError naming `what` when the bytes are not a PNG.
Image decode_png(std::string_view bytes, const std::string& what);
std::string encode_png(const Image& image);

/// Reads and decodes. Throws InputError naming the file.
Image read_png(const std::filesystem::path& path);

/// As decode_png and read_png, but JPEG is understood too.
Image decode_image(std::string_view bytes, const std::string& what);
Image read_image(const std::filesystem::path& path);

/// Square copy by averaging the area under each new pixel; colors are weighted by alpha.
Image resized(const Image& image, int size);

/// Gives every pixel outside `covered` the color of a nearest covered one, so that filtering near
/// a border does not pick up what lies behind it. Only the first `channels` are filled: alpha is
/// left alone unless asked. Does nothing when no pixel is covered.
void fill_from_nearest(Image& image, Mask covered, int channels = 3);

}  // namespace throng::skinning
