// Images as JPEG files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace throng::images {

/// Encodes RGB rows as JPEG with 4:2:0 subsampling and a quality of 1 to 100. The bytes are the
/// same on machines with and without SIMD. Throws EnvironmentError.
std::string jpeg_bytes(const std::vector<std::uint8_t>& rgb, int width, int height, int quality);

}  // namespace throng::images
