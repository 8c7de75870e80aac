// Color images with alpha: reads PNG and JPEG, writes PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace throng::images {

/// An image of 8-bit sRGB colors with alpha, rows from the top.
struct RgbaImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;

  RgbaImage() = default;
  RgbaImage(int w, int h) : width(w), height(h), rgba(static_cast<std::size_t>(w) * h * 4) {}
  /// The four bytes of a pixel.
  std::uint8_t* pixel(int x, int y) {
    return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
  }
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() + (static_cast<std::size_t>(y) * width + x) * 4;
  }
};

/// Decodes a PNG file. Throws InputError with the name `what` for other bytes.
RgbaImage decode_png(std::string_view bytes, const std::string& what);
/// Returns a PNG file.
std::string encode_png(const RgbaImage& image);

/// Reads and decodes a PNG file. Throws InputError with the name of the file.
RgbaImage read_png(const std::filesystem::path& path);

/// Like decode_png() and read_png(), for PNG and JPEG files.
RgbaImage decode_image(std::string_view bytes, const std::string& what);
RgbaImage read_image(const std::filesystem::path& path);

}  // namespace throng::images
