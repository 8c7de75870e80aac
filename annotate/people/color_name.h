// Names of colors in plain English, for the attributes of clothing.
#pragma once

#include <cstdint>
#include <string_view>

namespace throng::annotate {

/// The name of an sRGB color, given as three bytes: one of black, white, gray, red, orange, yellow,
/// green, blue, purple, pink, brown (the basic color terms of Berlin and Kay 1969) and beige, by
/// lightness, chroma and hue angle in CIELAB. The limits were chosen for throng; see the source
/// file.
std::string_view color_name(const std::uint8_t* rgb);

}  // namespace throng::annotate
