// The levels of detail of characters, and the image heights at which they are used.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace throng::skinning {

/// A level of detail.
struct DetailLevel {
  std::size_t triangles;  ///< max number, including a carried item, but not what is led
  double above_px;        ///< used for people whose standing height exceeds this
};

/// At each limit the triangles are about as small as a pixel (a person covers about a sixth of the
/// squared height in pixels, and half of the triangles face the camera), so that more triangles
/// would cost time without visible effect. tests/skinning/levels_test.cpp verifies that the change
/// of levels is invisible, for all characters from all sides. Characters of the library have more
/// triangles where they need them to keep their extent (extent_slack_m()). The last level is for
/// people in the distance, of whom thousands fill a stand, and for shadows.
inline constexpr std::array<DetailLevel, 7> kDetailLevels = {{
    {9000, 160},
    {3000, 110},
    {800, 80},
    {400, 56},
    {250, 40},
    {170, 16},
    {64, 0},
}};

/// The first level for the distance. Each of its vertices moves with one bone, and bodies
/// have a frame of their clip instead of a blend of two.
inline constexpr std::size_t kDistantLevel = 6;

/// Levels that are drawn.
inline constexpr std::size_t kDrawnLevels = kDetailLevels.size();

/// How far (m) a body at a drawn level may end, in any pose and direction, beside the finest ones:
/// a pixel at the largest height in the image at which the level is drawn, or 1.5 cm if that is
/// more.
constexpr double extent_slack_m(std::size_t level, double stature_m) {
  constexpr double kMinSlackM = 0.015;
  return level == 0 ? kMinSlackM
                    : std::max(kMinSlackM, stature_m / kDetailLevels[level - 1].above_px);
}

}  // namespace throng::skinning
