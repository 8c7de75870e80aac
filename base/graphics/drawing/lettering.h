// Words as gray images, for signs.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace throng::drawing {

/// Draws a word as large as fits into the image, in its middle, in the font Bebas Neue (or, where
/// that is missing, the usual one): one byte per pixel, rows from the top; 255 is a letter's
/// inside.
std::vector<std::uint8_t> draw_word(std::string_view word, int width, int height);

}  // namespace throng::drawing
