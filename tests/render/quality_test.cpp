// Permitted differences between rendering qualities.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/geometry/angle.h"
#include "render/passes/smooth_edges.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

Frame drawn(Quality quality) {
  Stage stage(open_ground({block(2, 4, -4, -2, 3)}), {}, {.quality = quality});
  return stage.draw(camera_at({-6, 0, 5}, 0, -35),
                    {stage.standing(1, -2, 0), stage.standing(2, 0, 1)});
}

TEST(Quality, SamplesAndEdgesLeaveIdsAndDepthAlone) {
  const Frame standard = drawn(Quality::standard);
  const Frame high = drawn(Quality::high);
  EXPECT_NE(standard.rgb, high.rgb);
  std::size_t different = 0;
  for (std::size_t i = 0; i < standard.id.size(); ++i) {
    different += standard.id[i] != high.id[i] ? 1 : 0;
  }
  // People's levels of detail have slightly different outlines.
  EXPECT_LT(different, standard.id.size() / 500);
}

TEST(Quality, DraftsShowTheSamePeopleInTheSamePlacesAndTheirColors) {
  const Frame standard = drawn(Quality::standard);
  const Frame draft = drawn(Quality::draft);
  for (const std::uint32_t agent : {1U, 2U}) {
    const Mask fine = instance_mask(standard, id_of_agent(agent));
    const Mask coarse = instance_mask(draft, id_of_agent(agent));
    EXPECT_NEAR(static_cast<double>(coarse.pixels), static_cast<double>(fine.pixels),
                0.25 * static_cast<double>(fine.pixels));
    EXPECT_LT((coarse.box.center() - fine.box.center()).norm(), 4);
  }
  const auto mean = [](const Frame& frame) {
    double sum = 0;
    for (const std::uint8_t value : frame.rgb) sum += value;
    return sum / static_cast<double>(frame.rgb.size());
  };
  EXPECT_NEAR(mean(draft), mean(standard), 25);
}

TEST(Quality, SeveralSamplesChangeEdgesAlone) {
  const auto image = [](bool multisample) {
    Stage stage(open_ground({block(3, 5, -2, 2, 4)}), {}, {.multisample = multisample});
    return stage.draw(camera_at({-6, 0, 3}, 0, -12), {stage.standing(1, 0, 0)});
  };
  const Frame sampled = image(true);
  const Frame smoothed = image(false);
  EXPECT_EQ(sampled.id, smoothed.id);
  EXPECT_EQ(sampled.depth_m, smoothed.depth_m);
  int inner = 0;
  int inner_changed = 0;
  int edge = 0;
  int mixed = 0;
  for (int y = 2; y < sampled.height() - 2; ++y) {
    for (int x = 2; x < sampled.width() - 2; ++x) {
      const std::uint32_t id = sampled.id[pixel_index(sampled, x, y)];
      bool is_inner = true;
      for (const auto& [i, j] :
           {std::pair(-2, 0), {2, 0}, {0, -2}, {0, 2}, {-1, -1}, {1, 1}, {-1, 1}, {1, -1}}) {
        is_inner = is_inner && sampled.id[pixel_index(sampled, x + i, y + j)] == id;
      }
      const int change = std::abs(brightness(sampled, x, y) - brightness(smoothed, x, y));
      // The ground's own pattern has no edges of ids, but is the same in both.
      (is_inner ? inner : edge) += 1;
      if (is_inner && change > 24) ++inner_changed;
      if (!is_inner && change > 24) ++mixed;
    }
  }
  EXPECT_LT(inner_changed, inner / 50);
  EXPECT_GT(mixed, edge / 50);
}

/// Width, m, over which the shadow of a wall of this height fades on the ground, in the sun's
/// direction: from a fifth to four fifths of the difference.
double penumbra_m(double height_m, Quality quality) {
  Environment lighting;
  lighting.sun_azimuth_rad = 0;
  lighting.sun_elevation_rad = 45 * kDegree;
  Stage stage(open_ground({block(0, 6, -8, 8, height_m)}), lighting, {.quality = quality});
  Stage bare(open_ground(), lighting, {.quality = quality});
  // The shadow's edge is in the middle of the image, its direction is up.
  const camera::Camera camera = camera_at({-height_m, 0, 9}, 0, -90, 200, 400, 8);
  const Frame frame = stage.draw(camera);
  const Frame lit = bare.draw(camera);
  const double meter_px = camera.intrinsics.fy_px / 9;
  // Farther away from the edge walls take light from the ground.
  const int around = static_cast<int>(0.35 * meter_px);
  std::vector<double> share;
  for (int y = 200 - around; y < 200 + around; ++y) {
    double sum = 0;
    double all = 0;
    for (int x = 0; x < 200; ++x) {
      sum += brightness(frame, x, y);
      all += brightness(lit, x, y);
    }
    share.push_back(sum / all);
  }
  const auto [dark, bright] = std::minmax_element(share.begin(), share.end());
  const double low = *dark + 0.2 * (*bright - *dark);
  const double high = *dark + 0.8 * (*bright - *dark);
  const auto between =
      std::count_if(share.begin(), share.end(), [&](double s) { return s > low && s < high; });
  return static_cast<double>(between) / meter_px;
}

TEST(Quality, HighSoftensShadowsWithTheHeightOfTheirCaster) {
  // The sun's disc is 0.53 degrees wide: 9.3 mm for each meter of a ray, which is 1.41 m for each
  // meter of height at 45 degrees, and 1.41 times as much along the ground. Between a fifth
  // and four fifths of a disc's area lies 0.49 of its width.
  const double expected = 0.0093 * 1.41 * 1.41 * 0.49;
  EXPECT_NEAR(penumbra_m(12, Quality::high), 12 * expected, 0.03);
  EXPECT_NEAR(penumbra_m(3, Quality::high), 3 * expected, 0.02);
  EXPECT_LT(penumbra_m(12, Quality::standard), 0.03) << "sharp, but for the map's texels";
}

/// White above and black below a line of this slope through the middle.
Frame halves(double slope) {
  Frame frame;
  frame.camera.intrinsics = camera::intrinsics_from_hfov(64, 48, 1);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool above = y + 0.5 < 24 + slope * (x + 0.5 - 32);
      frame.id.push_back(above ? 1 : kIdGround);
      frame.rgb.insert(frame.rgb.end(), 3, above ? 255 : 0);
    }
  }
  return frame;
}

TEST(Quality, SmoothEdgesAreNearTheShareOfAPixelThatALineCovers) {
  for (const double slope : {0.07, -0.2, 0.4, -0.9, 3.0, -8.0}) {
    Frame frame = halves(slope);
    const auto error = [&] {
      double sum = 0;
      for (int y = 4; y < 44; ++y) {
        for (int x = 4; x < 60; ++x) {
          int inside = 0;
          for (int j = 0; j < 8; ++j) {
            for (int i = 0; i < 8; ++i) {
              inside += y + (j + 0.5) / 8 < 24 + slope * (x + (i + 0.5) / 8 - 32) ? 1 : 0;
            }
          }
          sum += std::abs(frame.rgb[pixel_index(frame, x, y) * 3] / 255.0 - inside / 64.0);
        }
      }
      return sum;
    };
    const double before = error();
    smooth_edges(frame);
    // Steps of a pixel or two do not determine the line between them.
    const double flatness = std::max(std::abs(slope), 1 / std::abs(slope));
    EXPECT_LT(error(), (flatness > 4   ? 0.45
                        : flatness > 2 ? 0.6
                                       : 0.85) *
                           before)
        << "slope " << slope;
  }
}

TEST(Quality, SmoothEdgesLeaveStraightBordersAlone) {
  Frame frame = halves(0);
  const std::vector<std::uint8_t> before = frame.rgb;
  smooth_edges(frame);
  EXPECT_EQ(frame.rgb, before);
}

}  // namespace
}  // namespace throng::render
