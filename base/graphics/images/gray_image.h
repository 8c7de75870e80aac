// Gray images of photographs, as the calibration of cameras reads them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace throng::images {

/// A gray image: one byte per pixel, rows from the top. Color images are converted to Rec. 601
/// luma.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Decodes a JPEG or PNG file; applies the EXIF orientation of a JPEG. 16-bit samples keep their
/// upper byte; transparency is ignored. Throws InputError with the name `what`.
GrayImage decode_gray_image(std::string_view bytes, const std::string& what);

/// Returns the number of pixels of an image file from its header. Throws InputError for other
/// formats and for more pixels than the limit for decoding, EnvironmentError if the file cannot be
/// read.
std::int64_t pixels_of_image(const std::filesystem::path& file);

/// Reads and decodes a file. Throws InputError, and EnvironmentError if the file cannot be read.
GrayImage read_gray_image(const std::filesystem::path& file);

}  // namespace throng::images
