// The levels of detail that people are baked in, and how large somebody has to appear for each.
#pragma once

#include <array>
#include <cstddef>

namespace throng::skinning {

struct DetailLevel {
  std::size_t triangles;  ///< at most, with what is carried
  double above_px;        ///< for who would cover more than this many pixels standing upright
};

/// At each switch the triangles have become smaller than a pixel (somebody covers about a sixth of
/// the square of their height in pixels, and half of the triangles face the camera), so that more
/// of them cost time and show nothing. That nobody sees the switch tests/skinning/levels_test.cpp
/// measures: over 96 people and all around them, half of the masks overlap by 0.977, 0.975, 0.962
/// and 0.952 or more, and nine of ten by 0.966, 0.964, 0.940 and 0.906.
inline constexpr std::array<DetailLevel, 5> kDetailLevels = {{
    {8000, 160},
    {3000, 80},
    {800, 40},
    {400, 20},
    {250, 0},
}};

}  // namespace throng::skinning
