#include "render/people/corner_colors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace throng::render {
namespace {

constexpr int kImageSize = 64;

/// Values by column and row, the same in all channels.
template <typename Value>
skinning::Texture texture_from(Value value) {
  skinning::Texture image;
  for (int y = 0; y < kImageSize; ++y) {
    for (int x = 0; x < kImageSize; ++x) {
      for (int c = 0; c < 4; ++c) image.rgba.push_back(static_cast<std::uint8_t>(value(x, y)));
    }
  }
  return image;
}

/// The image as `cells` x `cells` squares of two triangles each.
struct Grid {
  std::vector<TexturedTriangle> triangles;
  std::size_t corners;
};

Grid make_grid(std::uint32_t cells) {
  Grid grid{{}, (cells + 1) * (cells + 1)};
  const auto add = [&](std::array<std::array<std::uint32_t, 2>, 3> at) {
    TexturedTriangle& triangle = grid.triangles.emplace_back();
    triangle.weight = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corners[k] = at[k][1] * (cells + 1) + at[k][0];
      triangle.uv[k] = {static_cast<float>(at[k][0]) / static_cast<float>(cells),
                        static_cast<float>(at[k][1]) / static_cast<float>(cells)};
    }
  };
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      add({{{x, y}, {x + 1, y}, {x + 1, y + 1}}});
      add({{{x, y}, {x + 1, y + 1}, {x, y + 1}}});
    }
  }
  return grid;
}

TEST(CornerColors, ShowASlopeAsItIs) {
  const skinning::Texture slope = texture_from([](int x, int y) { return 20 + 2 * x + y; });
  const Grid grid = make_grid(4);
  const std::vector<Rgba> colors = corner_colors(slope, kImageSize, grid.triangles, grid.corners);
  ASSERT_EQ(colors.size(), 25U);
  for (int y = 0; y <= 4; ++y) {
    for (int x = 0; x <= 4; ++x) {
      // Texels' middles are half a texel off.
      const double wanted = 20 + 2 * (16 * x - 0.5) + (16 * y - 0.5);
      EXPECT_NEAR(colors[static_cast<std::size_t>(5 * y + x)][0], wanted, 3) << x << ' ' << y;
    }
  }
}

TEST(CornerColors, KeepTheTwoSidesOfAnEdgeApart) {
  // The edge lies in the middle of a cell: corners to its left stay dark, those to its right
  // bright.
  const skinning::Texture edge = texture_from([](int x, int) { return x < 24 ? 60 : 180; });
  const Grid grid = make_grid(4);
  const std::vector<Rgba> colors = corner_colors(edge, kImageSize, grid.triangles, grid.corners);
  double error = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const std::size_t column = i % 5;
    error = std::max(error, std::abs(colors[i][0] - (column < 2 ? 60.0 : 180.0)));
  }
  EXPECT_LT(error, 40);
}

TEST(CornerColors, ASmallSpotDoesNotColorAllAround) {
  // A corner that happens to lie on a spot of one texel has its surroundings' color.
  const skinning::Texture spot =
      texture_from([](int x, int y) { return x == 32 && y == 32 ? 255 : 90; });
  const Grid grid = make_grid(2);
  const std::vector<Rgba> colors = corner_colors(spot, kImageSize, grid.triangles, grid.corners);
  EXPECT_NEAR(colors[4][0], 90, 12);
}

TEST(CornerColors, CornersOfNothingAreBlack) {
  const skinning::Texture white = texture_from([](int, int) { return 255; });
  const Grid grid = make_grid(1);
  const std::vector<Rgba> colors =
      corner_colors(white, kImageSize, grid.triangles, grid.corners + 1);
  EXPECT_GT(colors[0][1], 245);
  EXPECT_EQ(colors[4], (Rgba{0, 0, 0, 0}));
}

}  // namespace
}  // namespace throng::render
