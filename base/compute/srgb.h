// Conversion between sRGB bytes (IEC 61966-2-1) and linear light in [0, 1].
#pragma once

#include <cstdint>

namespace throng {

/// Returns the linear light of an encoded value in [0, 1].
double linear_from_encoded(double encoded);

/// Returns the linear light of a byte.
float linear_from_srgb(std::uint8_t byte);

/// Returns the nearest byte; light is clamped to [0, 1], NaN gives 0.
std::uint8_t srgb_from_linear(float light);

}  // namespace throng
