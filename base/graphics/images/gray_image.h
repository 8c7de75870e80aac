// Photographs as gray images: what calibration looks for boards in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace throng::images {

/// Rows from the top, one byte per pixel: luma by Rec. 601 of color images.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Decodes a JPEG or PNG file's bytes, turned upright as a JPEG's EXIF orientation says. 16-bit
/// samples keep their upper byte; transparency is ignored. Throws InputError naming `what`.
GrayImage decode_gray_image(std::string_view bytes, const std::string& what);

/// Pixels that the image in a file unpacks to, by its head; nothing is decoded. Throws InputError
/// for a file of another kind or of more pixels than are decoded, and EnvironmentError.
std::int64_t pixels_of_image(const std::filesystem::path& file);

/// Reads and decodes. Throws InputError, and EnvironmentError when the file cannot be read.
GrayImage read_gray_image(const std::filesystem::path& file);

}  // namespace throng::images
