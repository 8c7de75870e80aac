// The levels of detail that people are baked in, and how large somebody has to appear for each.
#pragma once

#include <array>
#include <cstddef>

namespace throng::skinning {

struct DetailLevel {
  std::size_t triangles;  ///< at most, with what is carried
  double above_px;        ///< for who would cover more than this many pixels standing upright
};

/// At each switch the triangles have become about as small as a pixel (somebody covers about a
/// sixth of the square of their height in pixels, and half of the triangles face the camera), so
/// that more of them cost time and show little. That nobody sees the switch
/// tests/skinning/levels_test.cpp measures, over all people and all around them. The last level is
/// chosen by nobody's size: it casts shadows and fills drafts.
inline constexpr std::array<DetailLevel, 7> kDetailLevels = {{
    {8000, 160},
    {3000, 110},
    {800, 80},
    {400, 56},
    {250, 40},
    {170, 0},
    {64, 0},
}};

}  // namespace throng::skinning
