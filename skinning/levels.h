// The levels of detail of characters, and the image heights at which they are used.
#pragma once

#include <array>
#include <cstddef>

namespace throng::skinning {

/// A level of detail.
struct DetailLevel {
  std::size_t triangles;  ///< max number, including the carried item
  double above_px;        ///< used for people whose standing height exceeds this
};

/// At each limit the triangles are about as small as a pixel (a person covers about a sixth of the
/// squared height in pixels, and half of the triangles face the camera), so that more triangles
/// would cost time without visible effect. tests/skinning/levels_test.cpp verifies that the change
/// of levels is invisible, for all characters from all sides. The last level is never chosen by
/// size: it is used for shadows and drafts.
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
