// Color images with alpha: PNG in and out, JPEG in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace throng::images {

/// 8-bit sRGB color with alpha, rows from the top.
struct RgbaImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;

  RgbaImage() = default;
  RgbaImage(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * h * 4) {}
  std::uint8_t* pixel(int x, int y) {
    return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
  }
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
  }
};

/// Throws InputError naming `what` when the bytes are not a PNG.
RgbaImage decode_png(std::string_view bytes, const std::string& what);
std::string encode_png(const RgbaImage& image);

/// Reads and decodes. Throws InputError naming the file.
RgbaImage read_png(const std::filesystem::path& path);

/// As decode_png and read_png, but JPEG is understood too.
RgbaImage decode_image(std::string_view bytes, const std::string& what);
RgbaImage read_image(const std::filesystem::path& path);

}  // namespace throng::images
