// sRGB (IEC 61966-2-1) bytes to linear light in [0, 1] and back.
#pragma once

#include <cstdint>

namespace throng {

/// Linear light of an encoded value in [0, 1].
double linear_from_encoded(double encoded);

/// Linear light of a byte.
float linear_from_srgb(std::uint8_t byte);

/// The nearest byte; light is clipped to [0, 1], and no number is none.
std::uint8_t srgb_from_linear(float light);

}  // namespace throng
