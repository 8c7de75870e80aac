// Names of colors, as people call those of clothes.
#pragma once

#include <cstdint>
#include <string_view>

namespace throng::annotate {

/// One of black, white, gray, red, orange, yellow, green, blue, purple, pink, brown (the basic
/// color terms of Berlin and Kay 1969) and beige, for an sRGB color: by lightness, chroma and hue
/// angle in CIELAB. The limits, which are ours, are in the function.
std::string_view color_name(const std::uint8_t* rgb);

}  // namespace throng::annotate
